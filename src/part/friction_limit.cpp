#include "part/friction_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "model/connected_parts.hpp"
#include "model/resultants.hpp"
#include "part/changing_friction.hpp"
#include "part/histories.hpp"
#include "part/pair_keys.hpp"

namespace gnomon::part {

namespace {

/// Whether supports or springs hold some nodes along a direction.
template <int dim>
bool are_held(const AssemblyParts<dim>& parts, const std::vector<char>& own,
              const Vector<dim>& direction) {
  constexpr double rounding = 1e-9;
  for (std::size_t node = 0; node < own.size(); ++node)
    for (int i = 0; own[node] && i < dim; ++i)
      if (parts.supports.held(static_cast<Eigen::Index>(node), i) &&
          std::abs(direction[i]) > rounding)
        return true;
  return std::ranges::any_of(parts.supports.springs, [&](const SpringSupport<dim>& springs) {
    return springs.stiffness.dot(direction.cwiseAbs()) > 0 &&
           std::ranges::any_of(springs.facets, [&](const auto& facet) {
             return std::ranges::any_of(
                 facet, [&](int node) { return own[static_cast<std::size_t>(node)] != 0; });
           });
  });
}

/// By load: with what it presses two bodies on each other at factor one, where nothing else holds
/// one of them along the approach; else nothing [force].
template <int dim>
std::optional<std::vector<double>> pressing_loads(const AssemblyParts<dim>& parts) {
  const MortarPair<dim>& pair = parts.pairs.front();
  const std::vector<int> part = connected_parts(parts.mesh, parts.bodies),
                         body_of = body_of_nodes(
                             parts.mesh, body_of_cells(parts.bodies, parts.mesh.cells.size()));
  const auto part_of = [&](int body) { return part[static_cast<std::size_t>(body)]; };
  if (parts.pairs.size() > 1 || part_of(pair.numbers[0]) == part_of(pair.numbers[1])) return {};
  for (const std::size_t side : {0, 1}) {
    std::vector<char> own;
    for (const int body : body_of) own.push_back(part_of(body) == part_of(pair.numbers[side]));
    if (are_held(parts, own, pair.approach)) continue;
    std::vector<double> presses;
    for (const Load<dim>& load : parts.loads) {
      const NodalField<dim> forces = forces_of(load, parts);
      Vector<dim> sum = Vector<dim>::Zero();
      for (Eigen::Index node = 0; node < forces.rows(); ++node)
        if (own[static_cast<std::size_t>(node)]) sum += forces.row(node).transpose();
      presses.push_back((side == 0 ? -1 : 1) * sum.dot(pair.approach));
    }
    return presses;
  }
  return {};
}

/// From the counter-body into the surface: across it where one of both is a plane and free forces
/// alone act across it, else the approach. Round bodies hold forces beside this by their shape.
template <int dim>
Vector<dim> into_surface(const AssemblyParts<dim>& parts) {
  constexpr double flat = 1 - 1e-8, rounding = 1e-9;
  const CounterBody<dim>& other = parts.interface.partner;
  Vector<dim> own = Vector<dim>::Zero(), others = Vector<dim>::Zero();
  double area = 0;
  for (const auto& patch : contact_nodes_of(parts)) {
    const Vector<dim> out =
        other.unchecked_distance(patch.initial_position, other.given(0, 0), 0).normal;
    area += patch.initial_area;
    own += patch.initial_area * patch.initial_normal;
    others += patch.initial_area * out;
  }
  for (const Vector<dim>& normal : {Vector<dim>(-own), others}) {
    if (!(normal.norm() > flat * area)) continue;
    CounterBody<dim> free = other;
    free.come_along(normal);
    if ((free.approach - normal.normalized()).norm() < rounding) return free.approach;
  }
  return other.approach;
}

/// The pressures of inclined surfaces by what presses them, at most.
template <int dim>
double most_spread(const AssemblyParts<dim>& parts, const Vector<dim>& into) {
  const auto patches =
      parts.pairs.empty()
          ? contact_nodes_of(parts)
          : contact_patches<dim>(parts.mesh, parts.pairs.front().slave, {}, parts.section());
  double least = 1;
  for (const ContactPatch<dim>& patch : patches)
    least = std::min(least, std::abs(patch.initial_normal.dot(into)) / patch.initial_normal.norm());
  return 1 / least;
}

/// The forces between bodies over a run, as far as a scene tells them.
template <int dim>
class KnownForces {
public:
  explicit KnownForces(const AssemblyParts<dim>& parts) : parts_(parts) {
    if (parts.pairs.empty()) {
      into_ = into_surface(parts);
    } else if (parts.interface.rolling) {
      into_ = parts.pairs.front().approach;
      presses_ = pressing_loads(parts);
    }
    if (dim == 3 && parts.interface.rolling) spread_ = most_spread(parts, into_);
  }

  bool are_known(const Phase<dim>& phase) const {
    return parts_.pairs.empty() ? phase.force.has_value() : presses_.has_value();
  }

  /// Across the surface, and along it, on the straight lines of histories that are valid after
  /// `within`. Rolling in space: along the velocity, since inclined surfaces hold forces across it.
  std::pair<double, double> at(const Phase<dim>& phase, double t, double within) const {
    if (presses_) {
      double across = 0;
      for (std::size_t k = 0; k < presses_->size(); ++k)
        across += (*presses_)[k] * parts_.loads[k].history.factor(t, within);
      Vector<dim> along = Vector<dim>::Zero();
      for (int i = 0; i < dim; ++i) along[i] = parts_.interface.rolling->force[i].value_or(0);
      return {across, size_along(along)};
    }
    const Vector<dim> sum = pressing_force(phase, parts_.interface.history, t, within);
    return {sum.dot(into_), size_along(sum - sum.dot(into_) * into_)};
  }

  /// Of rolling in space: most_spread().
  double spread() const { return spread_; }

  /// The coefficient; a factor is one of time alone.
  double friction(double t, double within) const {
    const Interface<dim>& interface = parts_.interface;
    const WearMoment moment{.time = t, .slid = 0, .within = within};
    return interface.friction * interface.friction_factor.at(0, moment, {}).value;
  }

  /// Between which friction and forces have no kinks.
  std::set<double> times(double duration) const {
    std::set<double> all = {0, duration};
    const auto add = [&](const std::vector<double>& times) {
      for (const double t : times)
        if (t > 0 && t < duration) all.insert(t);
    };
    add(parts_.interface.history.times());
    for (const Guide<dim>& guide : parts_.interface.partner.guides) add(guide.factors.times());
    for (const Load<dim>& load : parts_.loads) add(load.history.times());
    add(parts_.interface.friction_factor.breakpoints());
    constexpr int parts = 64;  // of a factor that is no straight line
    for (int k = 1; parts_.interface.friction_factor.varies() && k < parts; ++k)
      all.insert(duration * k / parts);
    return all;
  }

private:
  double size_along(const Vector<dim>& force) const {
    if (dim == 2 || !parts_.interface.rolling) return force.norm();
    return std::abs(force.dot(parts_.interface.rolling->velocity.normalized()));
  }

  const AssemblyParts<dim>& parts_;
  Vector<dim> into_ = Vector<dim>::Zero();
  double spread_ = 1;
  std::optional<std::vector<double>> presses_;
};

/// When forces along the surface are first more than friction holds between two times().
template <int dim>
std::optional<double> first_excess(const KnownForces<dim>& forces, const Phase<dim>& phase,
                                   double from, double to) {
  constexpr int halvings = 30;
  const auto is_more = [&](double t) {
    const auto [across, along] = forces.at(phase, t, from);
    return along > 0 && along > forces.friction(t, from) * forces.spread() * across;
  };
  if (is_more(from)) return from;
  if (!is_more(to)) return {};
  double before = from, first = to;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (before + first) / 2;
    (is_more(middle) ? first : before) = middle;
  }
  return first;
}

/// A force along the surface that is more than friction holds, first in a run.
struct Excess {
  double t, tau;  ///< [time], position in the cycle
  double force, holds;
};

/// Of friction that changes with time alone, if at all.
template <int dim>
std::optional<Excess> excess_of_friction(const AssemblyParts<dim>& parts, double duration) {
  const std::vector<Phase<dim>> phases = parts.instants();
  const KnownForces<dim> forces(parts);
  if (!forces.are_known(phases.front())) return {};
  const std::set<double> times = forces.times(duration);
  for (auto from = times.begin(), to = std::next(from); to != times.end(); ++from, ++to) {
    std::optional<double> first;
    const Phase<dim>* where = nullptr;
    for (const Phase<dim>& phase : phases)
      if (const auto t = first_excess(forces, phase, *from, *to); t && !(first && *first <= *t))
        first = t, where = &phase;
    if (!first) continue;
    const auto [across, along] = forces.at(*where, *first, *from);
    return Excess{*first, where->position, along, forces.friction(*first, *from) * across};
  }
  return {};
}

std::string key_of_friction(const Scene& scene) {
  for (const std::string& table : pair_tables(scene))
    if (std::string key = table + ".friction"; scene.given(key)) return key;
  return "friction.coefficient";
}

/// Else friction is known in the run alone.
bool friction_is_of_time(const Scene& scene) {
  const std::vector<const char*> others = {"h", "s", "x0", "y0", "z0"};
  return std::ranges::none_of(others,
                              [&](const char* name) { return reads_in_friction(scene, name); });
}

}  // namespace

template <int dim>
std::string remark_on_friction(const Scene& scene, const AssemblyParts<dim>& parts) {
  if (!friction_is_of_time(scene)) return "";
  const auto first = excess_of_friction(parts, scene.real("time.end"));
  if (!first) return "";
  return fmt::format(
      "at t = {:.4g} s and tau = {:.4g} the force along the surface, {:.4g}, becomes more than "
      "friction holds: the counter-body has no place there, unless its shape holds it",
      first->t, first->tau, first->force);
}

template <int dim>
std::optional<double> used_friction(const Scene& scene, const AssemblyParts<dim>& parts) {
  if (!friction_is_of_time(scene)) return {};
  const KnownForces<dim> forces(parts);
  const std::set<double> times = forces.times(scene.real("time.end"));
  double most = 0;
  for (const Phase<dim>& phase : parts.phases) {
    if (!forces.are_known(phase)) return {};
    for (const double t : times) {
      const auto [across, along] = forces.at(phase, t, t);
      const double held = forces.friction(t, t) * across;
      if (held > 0) most = std::max(most, std::min(along / held, 1.0));
    }
  }
  if (most == 0) return {};
  return most;
}

template <int dim>
void require_pressing(const Scene& scene, const AssemblyParts<dim>& parts) {
  constexpr double least = 1e-6;
  const std::vector<Guide<dim>>& guides = parts.interface.partner.guides;
  if (guides.size() < 2 || !parts.interface.force) return;
  const auto patches = contact_nodes_of(parts);
  for (const Phase<dim>& phase : parts.phases) {
    const std::vector<std::optional<double>> forces = phase.forces();  // at factor one
    Vector<dim> force = Vector<dim>::Zero();
    for (std::size_t i = 0; i < forces.size(); ++i)
      force += forces[i].value_or(0) * guides[i].along;
    double presses = 0;
    for (const ContactPatch<dim>& patch : patches)
      presses = std::max(presses, -patch.initial_normal.normalized().dot(force));
    if (!(presses >= least * std::abs(*parts.interface.force)))
      throw InputError(fmt::format(
          "{}: expected forces that press the counter-body on the surface in every phase, got none "
          "at tau = {:g}: without them its place is not determined",
          scene.where(guides.front().key + ".cycle"), phase.position));
  }
}

template <int dim>
void require_balanced_rolling(const Scene& scene, const AssemblyParts<dim>& parts) {
  const bool may_end_before = scene.given("time.until") && !scene.text("time.until").empty();
  if (may_end_before) return;
  if (!friction_is_of_time(scene)) return;
  if (const auto first = excess_of_friction(parts, scene.real("time.end")))
    refuse(scene, key_of_friction(scene),
           fmt::format("a larger coefficient: from t = {:.4g} s on the force along the surface, "
                       "{:.4g}, is more than friction holds, f P = {:.4g}",
                       first->t, first->force, first->holds));
}

template std::string remark_on_friction(const Scene&, const AssemblyParts<2>&);
template std::string remark_on_friction(const Scene&, const AssemblyParts<3>&);
template std::optional<double> used_friction(const Scene&, const AssemblyParts<2>&);
template std::optional<double> used_friction(const Scene&, const AssemblyParts<3>&);
template void require_pressing(const Scene&, const AssemblyParts<2>&);
template void require_pressing(const Scene&, const AssemblyParts<3>&);
template void require_balanced_rolling(const Scene&, const AssemblyParts<2>&);
template void require_balanced_rolling(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
