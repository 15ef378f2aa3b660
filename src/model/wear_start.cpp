// Consistent start of a worn body: equilibrium at the initial shape by a load ramp.

#include "model/wear_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <optional>

#include "model/connected_parts.hpp"
#include "model/find_creepage.hpp"
#include "model/initial_gap.hpp"
#include "model/path_march.hpp"
#include "model/phase_start.hpp"
#include "model/rigid_balance.hpp"

namespace gnomon {

namespace {

/// A successful attempt needs 3 to 9 iterations.
constexpr int max_iterations = 15;
/// Tolerance of equilibria on the way to the whole load, relative to the first load that is tried.
constexpr double rough_tolerance = 1e-3;

}  // namespace

template <int dim>
bool flies_away(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                const FieldValues<dim>* from) {
  const double size = Box<dim>::around(equations.assembly().mesh.nodes).diagonal(),
               far = from ? 3 * size : 10 * size;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    const FieldId u = equations.fields(p).u;
    NodalField<dim> moved = values.vector(u);
    if (from) moved -= from->vector(u);
    if (moved.cwiseAbs().maxCoeff() > far) return true;
  }
  return false;
}

template <int dim>
RampOptions ramp_options(const Assembly<dim>& body) {
  RampOptions options;
  for (const Body& each : body.bodies) {
    if (each.element.kinematics == Kinematics::small) continue;  // no load inverts an element
    const ElasticModuli& law = each.material.moduli;
    const double whole_strain = body.scales.stress / law.young_modulus();
    const double strain = 3 * law.mu / (law.lambda + law.mu);
    if (strain < whole_strain) options.first = std::min(options.first, strain / whole_strain);
  }
  options.smallest *= options.first;
  return options;
}

template <int dim>
RampReport find_equilibrium(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& contact,
                            const RampOptions& options, FieldValues<dim>& values,
                            Counters& counters,
                            const std::function<void(std::span<double> y)>& passed) {
  // One solver at a time, because each holds factors. Most ramps reach the whole load at once and
  // need only the exact solver.
  std::optional<NewtonSolver> solver;
  bool exact = false;
  const NonlinearFunction function = algebraic_function(contact);
  std::vector<double> y(contact.structure().size);
  const bool pairs = !equations.assembly().pairs.empty();
  const auto touching = [&] {
    if (!passed) return;
    contact.numbering().gather(values, y);
    passed(y);
    contact.numbering().scatter(y, values);
  };
  std::vector<Approach> approaches;
  bool loaded = options.begin > 0;
  if (!loaded) approaches = close_initial_gaps(equations, contact, values, touching);
  const FieldValues<dim> from = values;
  const LoadSolve solve = [&](double fraction, std::span<double> y) {
    contact.set_load_fraction(fraction);
    if (!loaded && passed && !pairs) {
      for (const Approach& at : approaches) y[at.number] = at.touching;
      passed(y);
    }
    if (!loaded)
      for (const Approach& at : approaches)
        y[at.number] = at.touching + at.share * indentation(equations.assembly(), fraction);
    if (const bool whole = fraction == 1 || passed; !solver || exact != whole) {
      exact = whole;
      NewtonOptions newton{.max_iterations = max_iterations};
      if (exact) {  // where contact no longer changes, the last decades need no new factors
        newton.keep_factors = true;
        newton.max_iterations *= 2;  // as in modified_newton
      } else {
        newton.tolerance = rough_tolerance * options.first;
      }
      solver.reset();
      solver.emplace(contact.structure(), counters, newton);
    }
    NewtonReport report = solver->solve(function, y);
    if (pairs && report.converged && flies_away(equations, contact.values(0, y), &from)) {
      report.converged = false;  // a rough residual of rounding errors
      report.reason = "an iterate has opened the contact that holds a body";
    }
    if (report.converged && options.strays && options.strays(y, 1)) {
      report.converged = false;
      report.reason = "bodies of a pair slide too far on each other";
    }
    loaded = loaded || report.converged;
    if (report.converged && passed) passed(y);
    return report;
  };
  contact.numbering().gather(values, y);
  // Without load the bodies only touch: from deeper, small loads would seem to part them.
  for (const Approach& at : approaches) y[at.number] = at.touching;
  RampReport report = ramp_load(solve, options, y);
  contact.numbering().scatter(y, values);
  return report;
}

namespace {

/// Of bodies of pairs that supports let turn.
template <int dim>
std::string hint_of_rotations(const Assembly<dim>& assembly) {
  std::vector<std::string> free;
  for (const RigidPart<dim>& part : rigid_parts(assembly, assembly.mesh.nodes))
    if (const std::string rotation = free_rotation_of(part, assembly.section()); !rotation.empty())
      free.push_back(fmt::format("\"{}\" can {}", body_of_part(assembly, part).name, rotation));
  if (free.empty()) return "";
  return fmt::format("; {}, which contact alone resists: expected a [[support]] that holds it",
                     fmt::join(free, ", "));
}

/// Of a contact node that supports hold across the surface, where a given place of the counter-body
/// may contradict them.
template <int dim>
std::string hint_of_held_nodes(const Assembly<dim>& assembly) {
  constexpr double across = 0.1;
  if (assembly.interface.force) return "";
  for (const ContactPatch<dim>& patch : assembly.contact_nodes) {
    const Vector<dim> normal = patch.initial_normal.normalized();
    bool gives_way = false;
    for (int i = 0; i < dim; ++i)
      gives_way =
          gives_way || (std::abs(normal[i]) > across && !assembly.supports.held(patch.node, i));
    if (!gives_way)
      return fmt::format(
          "; the contact node at ({:.4g}) is held across the surface, and cannot give "
          "way to the counter-body: its [[support]] should leave it out",
          fmt::join(assembly.mesh.nodes[static_cast<std::size_t>(patch.node)], ", "));
  }
  return "";
}

/// Of supports that hold too much, or too little: contact with a counter-body may hold a body in
/// the direction of the load alone.
template <int dim>
std::string hint_of_start(const Assembly<dim>& assembly) {
  if (!assembly.pairs.empty()) return hint_of_rotations(assembly);
  std::string hint = hint_of_held_nodes(assembly);
  for (const RigidPart<dim>& part : rigid_parts(assembly, assembly.mesh.nodes))
    if (part.loose.cols() > 1)
      hint += fmt::format(
          "; supports leave the body free to {}, and contact with a counter-body may not hold it: "
          "hold it in [[support]], or make the counter-body one of a [[pair]], whose rest is found",
          free_motions_of(part, assembly.section()));
  return hint;
}

}  // namespace

/// A part of the load has an equilibrium, so that the body is sound and the load too large for it;
/// or none has.
template <int dim>
std::string failure_of(const RampReport& ramp, const Assembly<dim>& assembly,
                       const Phase<dim>& phase) {
  const Element& element = assembly.bodies.front().element;
  const std::string when =
      assembly.cycle ? fmt::format("at the start, at tau = {:.4g} of the cycle,", phase.position)
                     : "at the start";
  const char* technology = technology_names[static_cast<std::size_t>(element.technology)];
  if (ramp.reached == 0)
    return fmt::format(
        "no equilibrium was found {}{} not even of a small part of the load (element {}): {}{}",
        when, assembly.cycle ? "" : ",", technology, ramp.reason, hint_of_start(assembly));
  return fmt::format(
      "the load or approach {} is more than {}: the load ramp found equilibria up to load fraction "
      "{:.4g}, and none beyond (element {}): {}",
      when, assembly.pairs.empty() ? "this body carries" : "these bodies carry", ramp.reached,
      technology, ramp.reason);
}

namespace {

/// Where no load acts and nothing moves, bodies without contact are where they were at first.
template <int dim>
void require_unmoved(const Assembly<dim>& assembly, const NodalField<dim>& u,
                     const Phase<dim>& phase) {
  if (!assembly.loads.empty() || !assembly.swinging_loads.empty() || supports_press(assembly))
    return;
  Eigen::Index node = 0;
  if (u.rowwise().norm().maxCoeff(&node) <= assembly.scales.displacement) return;
  const std::vector<int> body_of = body_of_nodes(assembly.mesh, assembly.body_of);
  throw SolutionError(fmt::format(
      "no equilibrium was found at the start{}: contact has pushed \"{}\" by {:.3g} mm out of what "
      "it touches, and nothing holds it there; stiffer springs in [[support]] may hold it",
      assembly.cycle ? fmt::format(", at tau = {:.4g} of the cycle", phase.position) : "",
      assembly.bodies[static_cast<std::size_t>(body_of[static_cast<std::size_t>(node)])].name,
      u.row(node).norm()));
}

/// Without contact a body that supports leave free has no place: Newton's method has pushed it past
/// what holds it.
template <int dim>
void require_touch(const Assembly<dim>& assembly, const FieldValues<dim>& values,
                   const WornBodyFields& fields, const Phase<dim>& phase) {
  if (assembly.pairs.empty() || !values.scalar(fields.lambda).isZero(0)) return;
  for (const RigidPart<dim>& part : rigid_parts(assembly, assembly.mesh.nodes))
    if (part.loose.cols() > 0)
      throw SolutionError(fmt::format(
          "the bodies do not touch at the start, and contact alone holds \"{0}\": its loads have "
          "pushed \"{0}\" past what it touches; are moduli given in MPa, and loads in N?",
          body_of_part(assembly, part).name));
  require_unmoved(assembly, values.vector(fields.u), phase);
}

}  // namespace

template <int dim>
FieldValues<dim> WearModel<dim>::equilibrium(const FieldValues<dim>& shape, double t,
                                             Counters& counters) const {
  FieldValues<dim> values = shape;
  const bool only = equations_.phases().size() == 1;
  for (std::size_t p = 0; p < equations_.phases().size(); ++p) {
    const Phase<dim>& phase = equations_.phases()[p];
    const WornBodyEquations<dim> alone =
        only ? equations_ : WornBodyEquations<dim>(equations_.shared_assembly(), {phase});
    PhaseStart<dim> start(alone, shape.vector(equations_.fields().d), t, counters);
    if (const RampReport ramp = start.find(); ramp.reached < 1)
      throw SolutionError(t == 0 ? failure_of(ramp, assembly(), phase)
                          : only ? ramp.reason
                                 : fmt::format("at tau = {:.4g} {}", phase.position, ramp.reason));
    if (alone.without_creepage() != alone.deformation())
      find_creepage(alone, start.values(), counters);
    if (t == 0) require_touch<dim>(assembly(), start.values(), alone.fields(), phase);
    copy_phase(start.values(), alone.fields(), values, equations_.fields(p));
  }
  return values;
}

template <int dim>
State WearModel<dim>::start(Counters& counters) const {
  const FieldValues<dim> unworn(*equations_.composition()->fields);
  return at_rest(0, assembly().interface.sticks ? start_of_path(equations_, counters)
                                                : equilibrium(unworn, 0, counters));
}

template <int dim>
State WearModel<dim>::at_rest(double t, const FieldValues<dim>& values) const {
  State state{t, std::vector<double>(system().structure().size), {}};
  system().numbering().gather(values, state.y);
  if (!assembly().pairs.empty()) {
    // Loads may have moved bodies beyond the facets that they were expected to meet.
    if (std::vector<std::vector<Vector<dim>>> x = positions(state); have_moved(x, 1)) {
      AssemblyParts<dim> parts = assembly();
      parts.near = std::move(x);
      const WornBodyEquations<dim> moved(std::make_shared<const Assembly<dim>>(std::move(parts)));
      set_rates(ComposedSystem<dim>(moved.composition()), nullptr, state);
      return state;
    }
  }
  set_rates(system(), nullptr, state);
  return state;
}

template bool flies_away(const WornBodyEquations<2>&, const FieldValues<2>&, const FieldValues<2>*);
template bool flies_away(const WornBodyEquations<3>&, const FieldValues<3>&, const FieldValues<3>*);
template RampOptions ramp_options(const Assembly<2>&);
template RampOptions ramp_options(const Assembly<3>&);
template RampReport find_equilibrium(const WornBodyEquations<2>&, ComposedSystem<2>&,
                                     const RampOptions&, FieldValues<2>&, Counters&,
                                     const std::function<void(std::span<double>)>&);
template std::string failure_of(const RampReport&, const Assembly<2>&, const Phase<2>&);
template RampReport find_equilibrium(const WornBodyEquations<3>&, ComposedSystem<3>&,
                                     const RampOptions&, FieldValues<3>&, Counters&,
                                     const std::function<void(std::span<double>)>&);
template std::string failure_of(const RampReport&, const Assembly<3>&, const Phase<3>&);
template State WearModel<2>::start(Counters&) const;
template State WearModel<2>::at_rest(double, const FieldValues<2>&) const;
template FieldValues<2> WearModel<2>::equilibrium(const FieldValues<2>&, double, Counters&) const;
template State WearModel<3>::at_rest(double, const FieldValues<3>&) const;
template FieldValues<3> WearModel<3>::equilibrium(const FieldValues<3>&, double, Counters&) const;
template State WearModel<3>::start(Counters&) const;

}  // namespace gnomon
