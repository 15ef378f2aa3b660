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

/// Solves the mesh motion for the worn surface in y, in parts of it where it inverts elements at
/// once. Returns the reason where this fails.
std::string move_mesh(const System& system, double t, std::vector<double>& y) {
  constexpr double smallest = 1.0 / 64;
  std::vector<AlgebraicStage> stages = system.algebraic_stages();
  if (stages.size() < 2) return {};  // no mesh off the worn surface
  const AlgebraicStage& motion = stages.front();
  const std::vector<double> worn = y;
  const std::vector<char>& differential = system.structure().differential;
  Counters counters;
  NewtonSolver newton(motion.system->structure(), counters, {});
  std::vector<double> d(motion.unknowns.size());
  double done = 0, step = 1;
  while (done < 1) {
    const double next = std::min(1.0, done + step);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (differential[i]) y[i] = next * worn[i];
    motion.freeze(t, y);
    std::vector<double> trial = d;
    const NewtonReport report = newton.solve(algebraic_function(*motion.system), trial);
    if (report.converged) {
      d = trial;
      done = next;
    } else if ((step /= 2) < smallest) {
      return report.reason;
    }
  }
  for (std::size_t k = 0; k < d.size(); ++k) y[motion.unknowns[k]] = d[k];
  return {};
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
  Counters counters;
  GapError error;
  error.failure = move_mesh(moving.system(), state.t, y);
  if (error.failure.empty())
    error.failure = AlgebraicSolver(moving.system(), counters).solve(state.t, y);
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
