#include "model/path_march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/newton/branch_search.hpp>

#include "model/loads_beyond_friction.hpp"
#include "model/near_facets.hpp"
#include "model/path_phase.hpp"
#include "model/wear_start.hpp"

namespace gnomon {

template <int dim>
const FieldValues<dim>& PathMarch<dim>::cycle() {
  values_.vector(whole_.fields().memory) = place_;
  for (std::size_t p = 0; p < whole_.phases().size(); ++p) follow(p);
  is_expected_ = true;
  return values_;
}

/// After alone.values have the solution.
template <int dim>
void PathMarch<dim>::keep(const Alone& alone, std::size_t phase) {
  copy_phase(alone.values, alone.fields(), values_, whole_.fields(phase));
  place_ = alone.places(alone.values);
  last_ = phase;
  come_near(whole_.phases()[phase], values_.vector(whole_.fields(phase).u), early_);
}

/// Bodies that loads move slide away from the facets that they may meet. Where they have left this
/// part of the margin, facets are found anew where the bodies are now, in all phases by as much.
template <int dim>
bool PathMarch<dim>::come_near(const Phase<dim>& at, const NodalField<dim>& u, double part) {
  if (near_->pairs.empty()) return false;
  std::vector<Vector<dim>> x = deformed(near_->mesh, values_.vector(whole_.fields().d), u);
  if (!have_strayed(*near_, at, x, part)) return false;
  const std::vector<Vector<dim>>& before = near_->near[nearest_instant(*near_, at.position)];
  AssemblyParts<dim> parts = *near_;
  for (std::size_t node = 0; node < x.size(); ++node) x[node] -= before[node];
  for (std::vector<Vector<dim>>& near : parts.near)
    for (std::size_t node = 0; node < x.size(); ++node) near[node] += x[node];
  near_ = std::make_shared<const Assembly<dim>>(std::move(parts));
  return true;
}

template <int dim>
void PathMarch<dim>::refuse(const Phase<dim>& phase, const std::string& reason) const {
  const std::string excess = loads_beyond_friction<dim>(*near_, phase, t_),
                    what = fmt::format("no equilibrium on the path of the cycle, at tau = {:.4g}: ",
                                       phase.position);
  if (!excess.empty() && t_ == 0) throw InputError(what + excess);
  if (!excess.empty()) throw SolutionError(what + excess);
  throw SolutionError(
      what + reason +
      "; a tangential force that friction does not balance has none, and where friction only just "
      "balances one it may not be found");
}

/// To the last of the phases on the way, of which values_ may have a guess.
template <int dim>
void PathMarch<dim>::advance(std::size_t to, const OnTheWay& on_the_way, bool is_expected) {
  const Phase<dim> phase = on_the_way(1);
  Alone alone(*this, phase);
  std::string reason;
  if (is_expected) {
    start_from(to, alone);
    if (solve(alone, reason)) return keep_near(std::move(alone), to);
  }
  const auto from = [&](Carried carried) {
    guess(alone, phase, carried);
    return solve(alone, reason);
  };
  const bool far = is_far(alone, phase);
  if (!from(far ? Carried::by_shear : Carried::wholly) &&
      !from(far ? Carried::wholly : Carried::by_shear) && !by_halves(alone, on_the_way, reason))
    refuse(phase, reason);
  keep_near(std::move(alone), to);
}

/// Solved again where it has left the facets that could meet: they have missed a part of each
/// other.
template <int dim>
void PathMarch<dim>::keep_near(Alone alone, std::size_t to) {
  const Phase<dim>& phase = alone.equations.phases().front();
  if (!come_near(phase, alone.values.vector(alone.fields().u), 1)) return keep(alone, to);
  Alone again(*this, phase);
  again.values = alone.values;
  again.remember(place_);
  if (std::string reason; !solve(again, reason)) refuse(phase, reason);
  keep(again, to);
}

template <int dim>
void PathMarch<dim>::follow(std::size_t p) {
  const Phase<dim>& phase = whole_.phases()[p];
  const Assembly<dim>& assembly = whole_.assembly();
  advance(
      p,
      [&](double part) {
        if (part == 1) return phase;
        return phase_at({phase.position - phase.interval * (1 - part), phase.weight},
                        assembly.cycle->motion, assembly.interface.partner,
                        assembly.interface.force);
      },
      is_expected_);
}

/// What friction shears the contact by [length].
template <int dim>
double PathMarch<dim>::shear() const {
  return whole_.assembly().interface.friction * whole_.assembly().scales.displacement;
}

/// How far the partner of every contact node goes on to a phase, where the bodies stay as they are.
template <int dim>
NodalField<dim> PathMarch<dim>::way_to(Alone& alone, const Phase<dim>& phase) const {
  if (whole_.assembly().pairs.empty())
    return whole_.carried(phase) - whole_.carried(whole_.phases()[last_]);
  start_from_last(alone);
  return place_ - alone.places(alone.values);
}

/// Whether most of the way to a phase is slip.
template <int dim>
bool PathMarch<dim>::is_far(Alone& alone, const Phase<dim>& phase) const {
  constexpr double many = 30;
  return way_to(alone, phase).rowwise().norm().maxCoeff() > many * shear();
}

template <int dim>
void PathMarch<dim>::start_from(std::size_t phase, Alone& alone) const {
  copy_phase(values_, whole_.fields(phase), alone.values, alone.fields());
  alone.remember(place_);
}

template <int dim>
void PathMarch<dim>::start_from_last(Alone& alone) const {
  const FieldId place = alone.fields().place;
  start_from(last_, alone);
  alone.values.vector(alone.fields().traction) *= Alone::inside;
  if (place != FieldId::none) alone.values.vector(place) = place_;
}

/// The state of the last phase, carried by the partner: wholly, so that all closed nodes begin as
/// stuck, or by no more than friction shears the contact, where they slip by far. Of pairs the
/// place on the partner alone says so.
template <int dim>
void PathMarch<dim>::guess(Alone& alone, const Phase<dim>& phase, Carried by) const {
  const WornBodyFields& fields = alone.fields();
  const Assembly<dim>& assembly = whole_.assembly();
  start_from_last(alone);
  if (!assembly.pairs.empty()) {
    if (by == Carried::by_shear) alone.values.vector(fields.place) = alone.places(alone.values);
    return;
  }
  NodalField<dim>& u = alone.values.vector(fields.u);
  NodalField<dim> carried = way_to(alone, phase);
  const double most = carried.rowwise().norm().maxCoeff();
  if (by == Carried::by_shear && most > shear()) carried *= shear() / most;
  for (std::size_t c = 0; c < assembly.contact_nodes.size(); ++c)
    for (int i = 0; i < dim; ++i)
      if (const int node = assembly.contact_nodes[c].node; !assembly.supports.held(node, i))
        u(node, i) += carried(static_cast<Eigen::Index>(c), i);
}

/// From the values at hand, which become the solution.
template <int dim>
bool PathMarch<dim>::solve(Alone& alone, std::string& reason, bool by_branches) {
  NewtonSolver newton(alone.system.structure(), counters_, newton_);
  std::vector<double> y(static_cast<std::size_t>(alone.system.structure().size));
  alone.system.numbering().gather(alone.values, y);
  const std::vector<double> guess = y;
  NewtonReport report = newton.solve(algebraic_function(alone.system), y);
  reason = report.reason;
  if (!report.converged && by_branches) {
    y = guess;
    report = solve_by_branches(newton, alone.system, y);
  }
  if (!report.converged) return false;
  const FieldValues<dim> found = alone.system.values(t_, y);
  if (!near_->pairs.empty() && flies_away(alone.equations, found)) {
    reason = "a body is carried away from what it touched";
    return false;
  }
  alone.values = found;
  return true;
}

/// Guesses from phases on the way, all after the last one.
template <int dim>
bool PathMarch<dim>::by_halves(Alone& target, const OnTheWay& on_the_way, std::string& reason) {
  constexpr int most_halvings = 6;
  for (int halvings = 1; halvings <= most_halvings; ++halvings) {
    const int parts = 1 << halvings;
    FieldValues<dim> known = target.values;
    bool found = true;
    for (int k = 1; found && k <= parts; ++k) {
      const Phase<dim> phase = on_the_way(double(k) / parts);
      Alone step(*this, phase);
      if (k == 1)
        guess(step, phase, Carried::wholly);
      else
        step.values = known;
      step.remember(place_);
      found = solve(step, reason);
      known = step.values;
    }
    if (!found) continue;
    target.values = known;
    return true;
  }
  return false;
}

template const FieldValues<2>& PathMarch<2>::cycle();
template void PathMarch<2>::keep(const Alone&, std::size_t);
template bool PathMarch<2>::come_near(const Phase<2>&, const NodalField<2>&, double);
template bool PathMarch<2>::solve(Alone&, std::string&, bool);
template void PathMarch<2>::advance(std::size_t, const OnTheWay&, bool);
template const FieldValues<3>& PathMarch<3>::cycle();
template void PathMarch<3>::keep(const Alone&, std::size_t);
template bool PathMarch<3>::come_near(const Phase<3>&, const NodalField<3>&, double);
template bool PathMarch<3>::solve(Alone&, std::string&, bool);
template void PathMarch<3>::advance(std::size_t, const OnTheWay&, bool);

}  // namespace gnomon
