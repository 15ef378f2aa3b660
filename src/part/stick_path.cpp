#include "part/stick_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <optional>
#include <utility>

#include "part/changing_friction.hpp"
#include "part/friction_limit.hpp"
#include "part/histories.hpp"
#include "part/loads.hpp"

namespace gnomon::part {

namespace {

std::vector<const CycleFunction*> functions_of(const Cycle& cycle) {
  std::vector<const CycleFunction*> result;
  for (const auto& function : {&cycle.displacement[0], &cycle.displacement[1],
                               &cycle.displacement[2], &cycle.rotation, &cycle.force, &cycle.load})
    if (*function) result.push_back(&**function);
  return result;
}

/// Of the counter-body, or of all bodies.
template <int dim>
std::vector<const Cycle*> cycles_of(const CyclicMotion<dim>& motion) {
  std::vector<const Cycle*> result = {&motion.cycle};
  for (const BodyCycle<dim>& body : motion.bodies) result.push_back(&body.cycle);
  return result;
}

/// Factors of loads, motions, and forces of guides.
template <int dim>
std::vector<const CycleFunction*> functions_of(const CyclicMotion<dim>& motion,
                                               const std::vector<CycleFunction>& loads) {
  std::vector<const CycleFunction*> functions;
  for (const CycleFunction& factor : loads) functions.push_back(&factor);
  for (const Cycle* cycle : cycles_of(motion))
    for (const CycleFunction* function : functions_of(*cycle)) functions.push_back(function);
  for (const auto& force : motion.forces)
    if (force) functions.push_back(&*force);
  return functions;
}

/// Positions in [0, 1) at which a function of the cycle turns, jumps or has a corner.
std::vector<double> extremes_of(const std::vector<const CycleFunction*>& functions) {
  std::vector<double> found;
  for (const CycleFunction* function : functions)
    found = merged_kinks(std::move(found), function->kinks());
  return merged_kinks(std::move(found), sign_changes_in_cycle(
                                            [&](double tau, std::span<double> slopes) {
                                              for (std::size_t k = 0; k < functions.size(); ++k)
                                                slopes[k] = functions[k]->slope(tau);
                                            },
                                            functions.size()));
}

/// What jumps is one increment of the path, however many phases there are.
std::string remark_on_jumps(const std::vector<const CycleFunction*>& functions) {
  constexpr double aside = 1e-9, little = 1e-3;
  for (const CycleFunction* function : functions)
    for (const double tau : function->kinks())
      if (const double before = tau > aside ? tau - aside : 1 - aside;
          std::abs(function->value(tau + aside) - function->value(before)) >
          little * function->range())
        return fmt::format(
            "the cycle jumps at tau = {:.4g}, which slip follows in one increment, however many "
            "phases there are: where the bodies are unlike, some 10 % too much friction work; a "
            "ramp has more increments",
            tau);
  return {};
}

[[noreturn]] void refuse_path(const Scene& scene, const std::string& expected) {
  refuse(scene, "friction.stick", expected);
}

/// Of the counter-body or of a body of pairs.
template <int dim>
void require_closed_path(const Scene& scene, const Cycle& cycle, const CycleAxis<dim>& axis) {
  if (axis.meridian)
    refuse_path(scene, "no cycle.rotation in an axisymmetric scene: a path stays in the plane");
  constexpr double rounding = 1e-6;
  if (const auto& rotation = cycle.rotation; rotation && std::abs(rotation->gap()) > rounding)
    refuse_path(scene, "a rotation that ends where it begins, not whole turns");
  if (dim == 2 && cycle.displacement[2])
    refuse_path(scene, "no cycle.z beside it: in plane strain a path stays in the plane");
  if (const std::vector<std::string> open = cycle.remarks(); !open.empty())
    refuse_path(scene, "a motion that ends where it begins; " + open.front());
}

/// Slip by the arc of a turn is found from its chord.
template <int dim>
void require_short_turns(const Scene& scene, const std::vector<Phase<dim>>& phases) {
  constexpr double most = 3;  // less than half a turn
  for (const Phase<dim>& phase : phases)
    if (const double turn = std::abs(phase.angle - phase.angle_before); turn > most)
      refuse(scene, "cycle.phases",
             fmt::format("more phases: cycle.rotation turns by {:.3g} rad between two of them, and "
                         "friction.stick needs less than {:g}",
                         turn, most));
}

/// The number of phases, or given positions as extremes.
std::vector<CyclePoint> points_of(const Scene& scene, std::vector<double> extremes) {
  const std::vector<double>& phases = scene.reals("cycle.phases");
  if (phases.size() == 1 && phases[0] >= 1)
    return path_points(static_cast<int>(phases[0]), extremes);
  return path_points(1, merged_kinks(std::move(extremes), phases));
}

}  // namespace

template <int dim>
ReadPhases<dim> read_path(const Scene& scene, const CyclicMotion<dim>& motion,
                          const CounterBody<dim>& rest, std::optional<double> force) {
  require_closed_path(scene, motion.cycle, motion.axis);
  const auto slides = [](const RigidMotion<dim>& steady) {
    return steady.moves() || steady.across != 0 || !steady.across_by_x.isZero(0);
  };
  for (const BodyCycle<dim>& body : motion.bodies) {
    require_closed_path(scene, body.cycle, body.axis);
    if (slides(body.motion))
      refuse_path(scene,
                  "no motion.#.velocity or .rotation beside it: a steady motion does not stick");
  }
  if (slides(rest.motion))
    refuse_path(scene, "no counter_body.motion beside it: a steady motion does not stick");
  for (std::size_t k = 1; k < rest.guides.size(); ++k)
    for (int i = 0; i < dim; ++i)
      if (rest.guides[k].force && rest.guides[k].along[i] != 0 && motion.cycle.displacement[i])
        refuse_path(scene, fmt::format("no displacement over the cycle along {}.direction, where a "
                                       "force moves the counter-body",
                                       rest.guides[k].key));
  if (motion.cycle.rotation && std::ranges::any_of(rest.guides, &Guide<dim>::turns))
    refuse_path(scene, "no cycle.rotation beside a moment in [[counter_body.press]]");
  const std::vector<CycleFunction> loads = factors_of_loads(scene);
  const std::vector<const CycleFunction*> functions = functions_of(motion, loads);
  const std::vector<double> extremes = extremes_of(functions);
  ReadPhases<dim> result{{motion, read_cycle_quadrature(scene, extremes)}, {}, {}};
  result.phases = path_phases(points_of(scene, extremes), motion, rest, force);
  require_short_turns(scene, result.phases);
  if (rest.guides.size() < 2)  // else require_pressing()
    require_forces(scene, result.phases, rest.guides.empty() ? "" : rest.guides.front().key, force);
  const auto asked = static_cast<double>(result.phases.size());
  if (scene.reals("cycle.phases").size() == 1 && asked > 2 * scene.reals("cycle.phases")[0])
    result.remarks.push_back(
        fmt::format("cycle.phases: {} phases, since all corners and extremes of the cycle are some",
                    result.phases.size()));
  if (std::string jumps = remark_on_jumps(functions); !jumps.empty())
    result.remarks.push_back(std::move(jumps));
  return result;
}

template <int dim>
AssemblyParts<dim> with_chosen_path(const Scene& scene,
                                    const std::function<AssemblyParts<dim>(long phases)>& with) {
  const double tolerance = phase_tolerance(scene);
  AssemblyParts<dim> parts;
  ChosenPhases chosen;
  for (long count = fewest_chosen_phases; count <= most_chosen_phases; count *= 2) {
    parts = with(count);
    const std::unique_ptr<Model> model =
        std::make_unique<WearModel<dim>>(std::make_shared<const Assembly<dim>>(parts));
    Counters counters;
    const std::optional<PhaseError> found = model->phase_error(model->start(counters));
    chosen = {static_cast<long>(parts.phases.size()), found ? found->error : 0};
    if (chosen.error <= tolerance) break;
  }
  parts.remarks.push_back(remark_on_choice(chosen, tolerance));
  return parts;
}

namespace {

/// Slip in half a cycle, in the mean over the contact of spheres, by what friction can shear them,
/// where it is used to a part q (R. D. Mindlin and H. Deresiewicz, 1953).
double mean_slip(double q) {
  const double rest = 1 - q, whole = 1.2;
  return whole * std::max(1 - std::pow(rest, 5. / 3) - 5. / 6 * q * (1 + std::pow(rest, 2. / 3)),
                          5. / 162 * q * q * q);  // where the difference is rounding
}

}  // namespace

template <int dim>
double speed_on_path(const Scene& scene, const AssemblyParts<dim>& parts,
                     const Magnitudes& expected) {
  const double shear = parts.interface.friction * expected.scales.displacement,
               period = parts.cycle->motion.cycle.period;
  double stroke = 0;
  const auto carried = [&](const Phase<dim>& phase) {
    return carried_by(parts.cycle->motion, parts.interface.partner, phase);
  };
  for (const Phase<dim>& phase : parts.phases)
    for (const Phase<dim>& other : parts.phases)
      stroke = std::max(stroke, (carried(phase) - carried(other)).norm());
  const double given = *parts.interface.speed;
  if (stroke > 2 * shear) return given;
  constexpr double not_known = 0.85;
  const double used = stroke > 0 ? 1 - std::pow(1 - std::min(1.0, stroke / (2 * shear)), 1.5)
                                 : used_friction(scene, parts).value_or(not_known),
               most = 4 * mean_slip(used) * shear / period,
               least = 1e-7 * expected.scales.displacement / period,  // less is rounding
      speed = std::max(least, given > 0 ? std::min(given, most) : most);
  if (given == 0) return speed;  // what wears is not known yet
  const double deepest = expected.scales.wear_depth * speed / given;
  return speed * std::min(1.0, expected.scales.displacement / deepest);
}

namespace {

const Integrator& integrator_of(const Scene& scene) {
  return Registry<Integrator>::find(scene.text("integrator.name"), "integrator");
}

/// What slides follows within a cycle, which methods that do not damp cannot.
void require_damping(const Scene& scene) {
  if (integrator_of(scene).name == "theta" && scene.real("integrator.alpha") <= 0.5)
    refuse(scene, "integrator.alpha",
           "more than 0.5 beside friction.stick: the trapezoidal rule does not damp the memory of "
           "slip");
}

}  // namespace

void require_no_distance(const Scene& scene) {
  for (const auto& [key, reads] : {std::pair("wear.rate", reads_in_rates(scene, "s")),
                                   std::pair("friction.factor", reads_in_friction(scene, "s"))})
    if (reads)
      refuse(scene, key,
             "no sliding distance s, or also wear.velocity: the scene gives no speed of sliding");
}

bool memory_follows(const Scene& scene) {
  return integrator_of(scene).is_explicit();
}

template <int dim>
void require_path(const Scene& scene, const AssemblyParts<dim>& parts) {
  if (!parts.cycle)
    refuse_path(scene, "also [cycle], by which it is driven to and fro, or [rolling]");
  require_damping(scene);
  if (*parts.interface.speed == 0) require_no_distance(scene);
  if (!(parts.interface.friction > 0) ||
      std::ranges::any_of(parts.pairs, [](const auto& pair) { return !(pair.friction > 0); }))
    refuse(scene, "friction.coefficient",
           "a coefficient above zero beside friction.stick, and a friction above zero of every "
           "[[pair]]");
  require_pressing(scene, parts);
}

template ReadPhases<2> read_path(const Scene&, const CyclicMotion<2>&, const CounterBody<2>&,
                                 std::optional<double>);
template ReadPhases<3> read_path(const Scene&, const CyclicMotion<3>&, const CounterBody<3>&,
                                 std::optional<double>);
template AssemblyParts<2> with_chosen_path(const Scene&,
                                           const std::function<AssemblyParts<2>(long)>&);
template AssemblyParts<3> with_chosen_path(const Scene&,
                                           const std::function<AssemblyParts<3>(long)>&);
template double speed_on_path(const Scene&, const AssemblyParts<2>&, const Magnitudes&);
template double speed_on_path(const Scene&, const AssemblyParts<3>&, const Magnitudes&);
template void require_path(const Scene&, const AssemblyParts<2>&);
template void require_path(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
