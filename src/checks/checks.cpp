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
  for (const ResultantForce& each : facts.forces) largest = std::max(largest, norm(each.force));
  return largest;
}

std::array<double, 3> sum_of(const std::vector<ResultantForce>& forces) {
  std::array<double, 3> sum{};
  for (const ResultantForce& each : forces)
    for (int i = 0; i < 3; ++i) sum[i] += each.force[i];
  return sum;
}

std::string point_text(const std::array<double, 3>& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]);
}

}  // namespace

std::vector<std::string> doubts(const Examination& facts) {
  constexpr double unbalanced = 0.02, idle = 0.5, deep = 0.01, dragged = 0.05;
  std::vector<std::string> found;
  if (const double left = norm(sum_of(facts.forces)); left > unbalanced * largest_force(facts))
    found.push_back(
        fmt::format("loads, supports, springs and contact are out of balance by {:.3g}, {:.2g} of "
                    "the largest of them",
                    left, left / largest_force(facts)));
  if (facts.idle_load > idle)
    found.push_back(
        fmt::format("{:.0f} % of the loads act on nodes that supports hold in the same direction: "
                    "they do not press the bodies on each other",
                    100 * facts.idle_load));
  if (facts.intrusion && facts.intrusion->depth > deep * facts.deformation)
    found.push_back(fmt::format(
        "boundary that is not in contact lies {:.3g} mm inside the counter-body, at {}: it should "
        "touch there (wear.on), or the mesh should be finer",
        facts.intrusion->depth, point_text(facts.intrusion->position)));
  if (facts.drag && facts.drag->drag > dragged * facts.drag->stroke)
    found.push_back(fmt::format(
        "friction drags the contact by {:.3g} mm of a stroke of {:.3g} mm: for that "
        "part it sticks, and as much of the wear, {:.0f} %, is too much",
        facts.drag->drag, facts.drag->stroke, 100 * facts.drag->drag / facts.drag->stroke));
  if (!facts.touches) found.emplace_back("the bodies do not touch anywhere: nothing wears");
  return found;
}

void require_model(const Examination& facts) {
  if (facts.drag && facts.drag->drag >= facts.drag->stroke)
    throw InputError(fmt::format(
        "friction drags the contact by {:.3g} mm, the stroke is {:.3g} mm: the bodies would stick, "
        "and sliding over the whole contact is all that is modelled; expected stiffer supports, "
        "less friction or longer strokes",
        facts.drag->drag, facts.drag->stroke));
}

std::string balance_text(const Examination& facts, int dim) {
  if (facts.forces.empty()) return {};
  std::vector<std::string> parts;
  for (const ResultantForce& each : facts.forces) {
    const std::vector<double> components(each.force.begin(), each.force.begin() + dim);
    parts.push_back(fmt::format("{} ({:.4g})", each.name, fmt::join(components, ", ")));
  }
  return fmt::format("forces on the bodies: {}", fmt::join(parts, ", "));
}

}  // namespace gnomon
