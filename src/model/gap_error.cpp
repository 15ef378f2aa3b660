// What wear as a gap leaves out: the pressures of the same contact if the mesh had followed the
// wear.

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/newton/newton.hpp>

namespace gnomon {

namespace {

template <int dim>
AssemblyParts<dim> following(AssemblyParts<dim> parts) {
  parts.shape = *parts.following;
  parts.following.reset();
  parts.condensed = false;
  parts.condensation.reset();
  return parts;
}

/// Whether a contact node and its neighbours are closed in both: pressures at edges depend on where
/// the nodes are.
template <int dim>
std::vector<char> inner_nodes(const Assembly<dim>& body, const std::vector<ContactNode<dim>>& a,
                              const std::vector<ContactNode<dim>>& b) {
  std::vector<char> closed(body.mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < a.size(); ++c)
    closed[static_cast<std::size_t>(body.contact_nodes[c].node)] =
        a[c].traction < 0 && b[c].traction < 0;
  std::vector<char> inner;
  for (const ContactPatch<dim>& patch : body.contact_nodes)
    inner.push_back(std::ranges::all_of(patch.nodes, [&](int node) { return closed[node]; }));
  return inner;
}

/// Where the nodes off the surface are does not matter, as long as their elements are sound.
constexpr double rough = 1e-3;

/// Solves one stage for y to a residual, from its unknowns there. Returns the reason where this
/// fails; then y is as before.
std::string solve_stage(const AlgebraicStage& stage, double t, std::vector<double>& y,
                        double tolerance) {
  NewtonOptions options = modified_newton;
  options.tolerance = tolerance;
  Counters counters;
  NewtonSolver newton(stage.system->structure(), counters, options);
  std::vector<double> unknowns(stage.unknowns.size());
  for (std::size_t k = 0; k < unknowns.size(); ++k) unknowns[k] = y[stage.unknowns[k]];
  stage.freeze(t, y);
  const NewtonReport report = newton.solve(algebraic_function(*stage.system), unknowns);
  if (!report.converged) return report.reason;
  for (std::size_t k = 0; k < unknowns.size(); ++k) y[stage.unknowns[k]] = unknowns[k];
  return {};
}

/// y with a part of its worn surface.
std::vector<double> worn_by(double part, const std::vector<char>& differential,
                            std::vector<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i)
    if (differential[i]) y[i] *= part;
  return y;
}

/// Moves the mesh of y in proportion to the worn surface, as a thousandth of the wear does. Whether
/// all elements are sound then.
bool move_linearly(const AlgebraicStage& motion, const std::vector<char>& differential, double t,
                   std::vector<double>& y) {
  constexpr double little = 1e-3;
  std::vector<double> first = worn_by(little, differential, y);
  if (!solve_stage(motion, t, first, rough * little).empty()) return false;
  std::vector<double> unknowns, residual(motion.unknowns.size());
  for (const int k : motion.unknowns) unknowns.push_back(y[k] = first[k] / little);
  motion.freeze(t, y);
  try {
    motion.system->residual({.y = unknowns}, residual);
  } catch (const RecoverableError&) {
    return false;
  }
  return true;
}

/// Solves the mesh motion for the worn surface in y, in parts of it where it inverts elements at
/// once. Returns the reason where this fails.
std::string move_mesh(const AlgebraicStage& motion, const std::vector<char>& differential, double t,
                      std::vector<double>& y) {
  constexpr double smallest = 1.0 / 64;
  const std::vector<double> worn = y;
  if (move_linearly(motion, differential, t, y)) return {};
  y = worn_by(0, differential, worn);
  double done = 0, step = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + step);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (differential[i]) y[i] = next * worn[i];
    const std::string failure = solve_stage(motion, t, y, rough);
    if (failure.empty())
      done = next;
    else if ((step /= 2) < smallest)
      return failure;
  }
  return {};
}

/// Makes y consistent with its worn surface.
std::string solve_stages(const System& system, double t, std::vector<double>& y) {
  const std::vector<AlgebraicStage> stages = system.algebraic_stages();
  if (stages.size() > 1)  // else there is no mesh off the worn surface
    if (const std::string failure =
            move_mesh(stages.front(), system.structure().differential, t, y);
        !failure.empty())
      return failure;
  return solve_stage(stages.back(), t, y, NewtonOptions().tolerance);
}

}  // namespace

template <int dim>
std::optional<GapError> WearModel<dim>::gap_error(
    const State& state, const FieldValues<dim>& values,
    const std::vector<PhaseContact<dim>>& contacts) const {
  if (!assembly().following) return {};
  const WearModel moving(following<dim>(assembly()));
  std::vector<double> y(static_cast<std::size_t>(moving.system().structure().size));
  moving.system().numbering().gather(values, y);
  GapError error;
  error.failure = solve_stages(moving.system(), state.t, y);
  if (!error.failure.empty()) return error;
  const Point at{.t = state.t, .y = y};
  const auto moved = moving.contacts(moving.system().values(state.t, y), at);
  double change = 0, pressure = 0;
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    const auto &mine = contacts[p].nodes, &others = moved[p].nodes;
    const std::vector<char> inner = inner_nodes(assembly(), mine, others);
    for (std::size_t c = 0; c < mine.size(); ++c) {
      if (!inner[c]) continue;
      const double weight = contacts[p].weight * mine[c].area;
      change += weight * std::pow(others[c].traction - mine[c].traction, 2);
      pressure += weight * std::pow(mine[c].traction, 2);
    }
  }
  change = sum_over_processes(change), pressure = sum_over_processes(pressure);
  if (pressure == 0) return {};
  error.pressure = std::sqrt(change / pressure);
  return error;
}

template std::optional<GapError> WearModel<2>::gap_error(const State&, const FieldValues<2>&,
                                                         const std::vector<PhaseContact<2>>&) const;
template std::optional<GapError> WearModel<3>::gap_error(const State&, const FieldValues<3>&,
                                                         const std::vector<PhaseContact<3>>&) const;

}  // namespace gnomon
