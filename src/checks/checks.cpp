#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>

namespace gnomon {

namespace {

double norm(const std::array<double, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

double largest_force(const Examination& facts) {
  double largest = 0;
  for (const auto* forces : {&facts.forces, &facts.reactions})
    for (const ResultantForce& each : *forces) largest = std::max(largest, norm(each.force));
  return largest;
}

std::array<double, 3> sum_of(const std::vector<ResultantForce>& forces,
                             std::array<double, 3> ResultantForce::*member) {
  std::array<double, 3> sum{};
  for (const ResultantForce& each : forces)
    for (int i = 0; i < 3; ++i) sum[i] += (each.*member)[i];
  return sum;
}

std::string point_text(const std::array<double, 3>& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]);
}

}  // namespace

std::vector<std::string> doubts(const Examination& facts) {
  constexpr double unbalanced = 0.02, idle = 0.5, deep = 0.01, dragged = 0.05, peak = 1.05,
                   wedged = 50, lost = 0.02, stale = 0.01, inside = 1e-3, renewed = 0.02,
                   blind = 1e-3, turned = 0.02, displaced = 0.02, small = 0.01, worn = 0.02,
                   undriven = 0.1, nothing = 1e-6;
  constexpr int narrow = 2;
  std::vector<std::string> found;
  // Over a cycle all of them may cancel out.
  const double largest = std::max(largest_force(facts), small * facts.force);
  if (const double left = norm(sum_of(facts.forces, &ResultantForce::force));
      left > unbalanced * largest)
    found.push_back(
        fmt::format("loads, supports, springs and contact are out of balance by {:.3g}, {:.2g} of "
                    "the largest of them",
                    left, left / largest));
  if (const double left = norm(sum_of(facts.forces, &ResultantForce::torque));
      left > unbalanced * largest * facts.size)
    found.push_back(fmt::format(
        "torques of loads, supports, springs and contact are out of balance by {:.3g}, {:.2g} of "
        "the largest force times the size of the bodies",
        left, left / largest / facts.size));
  if (facts.idle_load > idle)
    found.push_back(
        fmt::format("{:.0f} % of the loads act on nodes that supports hold in the same direction: "
                    "they do not press the bodies on each other",
                    100 * facts.idle_load));
  if (facts.moved_axis && std::abs(facts.moved_axis->part) > displaced)
    found.push_back(fmt::format(
        "\"{}\" turns about its fixed motion.center, from which it has moved by {:.3g} mm: it "
        "slides by {:.2g} % too {}",
        facts.moved_axis->body, facts.moved_axis->way, 100 * std::abs(facts.moved_axis->part),
        facts.moved_axis->part > 0 ? "fast" : "slowly"));
  if (facts.unseen_sliding && facts.unseen_sliding->part > displaced)
    found.push_back(fmt::format(
        "{} over the cycle beside what {} says, with about {:.2g} % of the sliding speed, which "
        "wear leaves out",
        facts.unseen_sliding->body.empty() ? "contact moves"
                                           : '"' + facts.unseen_sliding->body + "\" moves",
        facts.unseen_sliding->body.empty() ? "[cycle]" : "[[motion]]",
        100 * facts.unseen_sliding->part));
  if (facts.body_turn && facts.body_turn->angle > turned)
    found.push_back(fmt::format(
        "{} turns by {:.2g} rad, which small strains take for a strain of about {:.2g}, and forces "
        "do not turn with it: material = \"neo-hookean\" has finite rotations",
        facts.body_turn->body.empty() ? "the body" : '"' + facts.body_turn->body + '"',
        facts.body_turn->angle, facts.body_turn->angle * facts.body_turn->angle / 2));
  if (facts.stale_weight > stale)
    found.push_back(
        fmt::format("the weight of what has worn off is {:.3g} % of the contact force, and still "
                    "acts: an acceleration has the mass of the unworn bodies",
                    100 * facts.stale_weight));
  if (!facts.touched_end.empty())
    found.push_back(fmt::format(
        "contact reaches an end of the mesh of \"{}\", which is a piece of its track: "
        "shapes and pressures are wrong, unless this is a plane of symmetry and path the "
        "half; a longer mesh is needed",
        facts.touched_end));
  if (facts.lost_wear > lost)
    found.push_back(fmt::format(
        "{:.3g} % of the wear of a body is at contact nodes whose shape is held, and is "
        "lost: shape.hold, or the end of the wearing surface at a curved side",
        100 * facts.lost_wear));
  if (facts.intrusion &&
      facts.intrusion->depth > (facts.pairs.empty() ? deep : 10 * deep) * facts.deformation)
    found.push_back(
        fmt::format("boundary that is not in contact lies {:.3g} mm inside the {}, at {}: it "
                    "should touch there "
                    "({}), or the mesh should be finer",
                    facts.intrusion->depth, facts.pairs.empty() ? "counter-body" : "other body",
                    point_text(facts.intrusion->position),
                    facts.pairs.empty() ? "wear.on" : "wear.on, pair.#.surfaces"));
  if (facts.drag && facts.drag->drag > dragged * facts.drag->stroke)
    found.push_back(fmt::format(
        "friction drags the contact by {:.3g} mm of a stroke of {:.3g} mm: for that "
        "part it sticks, and as much of the wear, {:.0f} %, is too much; friction.stick = true, or "
        "stick of a [[pair]], follows it",
        facts.drag->drag, facts.drag->stroke, 100 * facts.drag->drag / facts.drag->stroke));
  if (facts.without_friction > blind)
    found.push_back(
        fmt::format("{:.3g} % of the contact force is on nodes without friction, because the mesh "
                    "does not say from where their material comes: wear.on should begin upstream "
                    "of the contact, and have all of it",
                    100 * facts.without_friction));
  if (facts.slip_zone && *facts.slip_zone <= narrow)
    found.push_back(
        *facts.slip_zone == 0
            ? "no contact node slips, and nothing wears: the bodies move with each other, as where "
              "one may roll, or, where pressure falls to zero at the edges of contact, a zone "
              "slips that is narrower than an element and that a finer mesh shows"
            : fmt::format("the zone that slips beside contact that sticks is {} element{} wide: "
                          "friction work and wear are wrong by about 30 % with 2 of them, 5 % with "
                          "3, and mean little with 1; a finer mesh at the edges of contact helps",
                          *facts.slip_zone, *facts.slip_zone == 1 ? "" : "s"));
  if (!facts.rubs && facts.touches && facts.slip_area == 0)
    found.push_back(
        "no contact node slips over the cycle, and nothing wears by v or q: expected a longer "
        "motion or a larger force along the contact (cycle.x, cycle of a load)");
  if (facts.turn > turned)
    found.push_back(fmt::format(
        "its moment turns the counter-body by {:.2g} rad, and slip is of first order in "
        "it, so that about {:.1f} % of the slip is wrong: cycle.rotation is exact",
        facts.turn, 100 * facts.turn / 2));
  if (std::abs(facts.power_by_driving) < nothing)
    found.push_back(
        "all that rolls sticks, so that friction dissipates nothing and nothing wears: the mesh is "
        "too coarse for what slips");
  else if (std::abs(facts.power_by_driving - 1) > undriven)
    found.push_back(fmt::format(
        "friction in rolling dissipates {:.2g} times the power of what drives it: pressures move "
        "along the surfaces, by the mesh, small blocks or strains (a finer mesh there or larger "
        "blocks tell)",
        facts.power_by_driving));
  else if (std::abs(facts.upwind_power) > unbalanced)
    found.push_back(fmt::format(
        "in rolling differences along the velocity {} {:.2g} times the power of friction: "
        "it needs a finer mesh there",
        facts.upwind_power > 0 ? "add" : "take", std::abs(facts.upwind_power)));
  if (facts.worn_radius > worn)
    found.push_back(fmt::format(
        "{:.2g} % of the radius of a roller with this path has worn off, and path and curvature "
        "are still those of the scene: the depth is too small by about {:.2g} %, or, where the "
        "rate reads it (docs/rolling.md), worn_volume as much too large",
        100 * facts.worn_radius, 50 * facts.worn_radius));
  if (facts.overlap > inside * facts.size)
    found.push_back(fmt::format(
        "the counter-body lies {:.3g} mm inside the unloaded bodies and cannot give way: they are "
        "pressed by {:.3g} mm",
        facts.overlap, facts.pressed));
  if (facts.wedging > wedged)
    found.push_back(
        fmt::format("contact forces add up to {:.3g} times the force on the counter-body: it is "
                    "wedged, or larger than the place that it is pressed into",
                    facts.wedging));
  if (facts.edge && facts.edge->pressure > peak * facts.edge->inside)
    found.push_back(fmt::format(
        "the largest pressure, {:.4g} MPa, is that of the last node in contact, at {}, and within "
        "the contact it is {:.4g} MPa at most: the former depends on the tolerance of the steps "
        "and on the mesh",
        facts.edge->pressure, point_text(facts.edge->position), facts.edge->inside));
  if (facts.gap_error && !facts.gap_error->failure.empty())
    found.push_back(
        "wear is a gap, and what this leaves out is not known, because a mesh that "
        "follows the wear has no equilibrium: " +
        facts.gap_error->failure);
  else if (facts.gap_error && facts.gap_error->pressure > renewed)
    found.push_back(fmt::format(
        "wear is a gap: the pressures of this moment would change by {:.2g} of themselves if the "
        "mesh followed the wear; the worn shape is mostly far less wrong",
        facts.gap_error->pressure));
  if (!facts.touches)
    found.push_back(fmt::format(
        "the bodies do not touch anywhere, they are {:.3g} mm apart: nothing wears", facts.gap));
  return found;
}

std::vector<std::string> doubts(const std::vector<Body>& bodies) {
  constexpr double locking = 0.48;
  std::vector<std::string> found;
  for (const Body& each : bodies) {
    const ElasticModuli& moduli = each.material.moduli;
    const double ratio = moduli.lambda / (2 * (moduli.lambda + moduli.mu));
    if (each.element.technology == ElementTechnology::plain && ratio > locking)
      found.push_back(fmt::format(
          "element \"plain\" locks at Poisson's ratio {:.4g}{}: the body is too stiff, and its "
          "approach and contact too small; \"f-bar\" does not lock",
          ratio, each.name.empty() ? "" : fmt::format(" (\"{}\")", each.name)));
  }
  return found;
}

std::vector<std::string> doubts(const Examination& start, const Examination& end) {
  constexpr double little = 0.05, beside = 0.05;
  std::vector<std::string> found;
  if (end.unworn_force > start.unworn_force + beside)
    found.push_back(
        fmt::format("{:.3g} % of the contact force is on boundary that does not wear ({:.3g} % at "
                    "the start), and "
                    "so much less wears: wear.on may name it{}",
                    100 * end.unworn_force, 100 * start.unworn_force,
                    end.gap_error ? ", or mesh motion, instead of a gap, carry it along" : ""));
  if (end.few_nodes > 0)
    found.push_back(
        fmt::format("contact at the end is {} node{}: depths and pressures are those of this mesh, "
                    "and mean little; it needs a finer one there",
                    end.few_nodes, end.few_nodes == 1 ? "" : "s"));
  // What begins to slip adds to what wears.
  const double least =
      start.slip_area > 0 ? std::min(start.stick_area, start.slip_area) : start.stick_area;
  if (start.stick_area - end.stick_area > little * least)
    found.push_back(fmt::format(
        "the contact that always sticks has shrunk from {:.3g} to {:.3g} [mm, of solids mm^2]: its "
        "edge moves by a node where elements concentrate tractions, as well as where bodies would "
        "slip; depths beside it are less certain than the budget says (docs/fretting.md)",
        start.stick_area, end.stick_area));
  return found;
}

std::string doubt_about_few_nodes(const Examination& start) {
  if (start.few_nodes == 0 || start.pressed == 0) return {};
  return fmt::format(
      "contact at the start is {} node{}: pressures there mean little before it has grown; a finer "
      "mesh near the contact helps",
      start.few_nodes, start.few_nodes == 1 ? "" : "s");
}

void require_model(const Examination& facts) {
  if (facts.drag && facts.drag->drag >= facts.drag->stroke)
    throw InputError(fmt::format(
        "friction drags the contact by {:.3g} mm, the stroke is {:.3g} mm: the bodies would stick, "
        "which sliding over the whole contact does not know; expected friction.stick = true, "
        "or stick of a [[pair]], stiffer supports, less friction or longer strokes",
        facts.drag->drag, facts.drag->stroke));
}

std::string model_text(const Examination& facts) {
  if (!facts.gap_error || !facts.gap_error->failure.empty()) return {};
  return fmt::format(
      "wear as a gap: pressures would change by {:.2g} of themselves (root mean "
      "square) if the mesh followed the wear\n",
      facts.gap_error->pressure);
}

std::string balance_text(const Examination& facts, int dim) {
  if (facts.forces.empty()) return {};
  const auto line = [](const char* title, const std::vector<ResultantForce>& all,
                       std::array<double, 3> ResultantForce::*member, int from, int to) {
    std::vector<std::string> parts;
    for (const ResultantForce& each : all) {
      const auto& v = each.*member;
      const std::vector<double> components(v.begin() + from, v.begin() + to);
      parts.push_back(fmt::format("{} ({:.4g})", each.name, fmt::join(components, ", ")));
    }
    return parts.empty() ? "" : fmt::format("{}: {}\n", title, fmt::join(parts, ", "));
  };
  const auto torque = &ResultantForce::torque;
  const int first = dim == 2 ? 2 : 0;
  const bool turned = std::ranges::any_of(
      facts.forces, [&](const ResultantForce& each) { return norm(each.torque) > 0; });
  return line("forces on the bodies", facts.forces, &ResultantForce::force, 0, dim) +
         line("forces between the bodies", facts.pairs, &ResultantForce::force, 0, dim) +
         line("reactions", facts.reactions, &ResultantForce::force, 0, dim) +
         (turned ? line("torques about the origin", facts.forces, torque, first, 3) +
                       line("reacting torques", facts.reactions, torque, first, 3)
                 : "");
}

}  // namespace gnomon
