#include "part/friction_limit.hpp"

#include <fmt/format.h>

#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "model/resultants.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

namespace {

/// What presses the free counter-body at a time, on the straight lines of histories that are valid
/// after `within`: across the surface, and along it [force].
template <int dim>
std::pair<double, double> forces_at(const AssemblyParts<dim>& parts, const Phase<dim>& phase,
                                    double t, double within) {
  const Vector<dim> sum = pressing_force(phase, parts.interface.history, t, within);
  const Vector<dim>& approach = parts.interface.partner.approach;
  return {sum.dot(approach), (sum - sum.dot(approach) * approach).norm()};
}

/// When they are first more than friction holds between two times with straight histories.
template <int dim>
std::optional<double> first_excess(const AssemblyParts<dim>& parts, const Phase<dim>& phase,
                                   double from, double to) {
  constexpr int halvings = 30;
  const auto is_more = [&](double t) {
    const auto [across, along] = forces_at(parts, phase, t, from);
    return along > 0 && along > parts.interface.friction * across;
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

/// What presses the counter-body along the surface more than friction holds, first in a run.
struct Excess {
  double t, tau;  ///< [time], position in the cycle
  double force;
};

template <int dim>
std::optional<Excess> excess_of_friction(const AssemblyParts<dim>& parts, double duration) {
  const std::vector<Phase<dim>> phases = parts.instants();
  if (!parts.pairs.empty() || parts.interface.friction_factor.varies() || !phases.front().force)
    return {};
  std::set<double> times = {0, duration};
  const auto add = [&](const LoadHistory& history) {
    for (const double t : history.times())
      if (t > 0 && t < duration) times.insert(t);
  };
  add(parts.interface.history);
  for (const Guide<dim>& guide : parts.interface.partner.guides) add(guide.factors);
  for (auto from = times.begin(), to = std::next(from); to != times.end(); ++from, ++to) {
    std::optional<double> first;
    const Phase<dim>* where = nullptr;
    for (const Phase<dim>& phase : phases)
      if (const auto t = first_excess(parts, phase, *from, *to); t && !(first && *first <= *t))
        first = t, where = &phase;
    if (first)
      return Excess{*first, where->position, forces_at(parts, *where, *first, *from).second};
  }
  return {};
}

}  // namespace

template <int dim>
std::string remark_on_friction(const AssemblyParts<dim>& parts, double duration) {
  const auto first = excess_of_friction(parts, duration);
  if (!first) return "";
  return fmt::format(
      "at t = {:.4g} s and tau = {:.4g} the force along the surface, {:.4g}, becomes more than "
      "friction holds: the counter-body has no place there, unless its shape holds it",
      first->t, first->tau, first->force);
}

template <int dim>
void require_balanced_rolling(const Scene& scene, const AssemblyParts<dim>& parts) {
  if (dim == 3 || scene.given("time.until")) return;  // the run may end before
  if (const auto first = excess_of_friction(parts, scene.real("time.end")))
    refuse(scene, "friction.coefficient",
           fmt::format("a larger coefficient: from t = {:.4g} s on the force along the surface, "
                       "{:.4g}, is more than friction holds",
                       first->t, first->force));
}

template std::string remark_on_friction(const AssemblyParts<2>&, double);
template std::string remark_on_friction(const AssemblyParts<3>&, double);
template void require_balanced_rolling(const Scene&, const AssemblyParts<2>&);
template void require_balanced_rolling(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
