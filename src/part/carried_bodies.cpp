#include "part/carried_bodies.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "model/connected_parts.hpp"

namespace gnomon::part {

namespace {

/// Of each connected part of the mesh, by number: the mean displacement of what supports hold.
template <int dim>
NodalField<dim> shifts_at(const AssemblyParts<dim>& parts, const std::vector<int>& part_of,
                          double t, double within) {
  const Eigen::Index count = *std::ranges::max_element(part_of) + 1;
  NodalField<dim> sum = NodalField<dim>::Zero(count, dim), held = sum;
  for (const PrescribedValues& moved : parts.supports.moved)
    for (const auto& [node, i, value] : moved.entries) {
      sum(part_of[static_cast<std::size_t>(node)], i) += value * moved.history.factor(t, within);
      held(part_of[static_cast<std::size_t>(node)], i) += 1;
    }
  return (sum.array() / held.array().max(1)).matrix();
}

}  // namespace

template <int dim>
std::vector<std::vector<Vector<dim>>> carried_meshes(const AssemblyParts<dim>& parts) {
  constexpr int between = 8;
  std::vector<std::vector<Vector<dim>>> meshes = {parts.mesh.nodes};
  if (parts.supports.moved.empty()) return meshes;
  std::set<double> times = {0};
  for (const PrescribedValues& moved : parts.supports.moved)
    times.insert(moved.history.times().begin(), moved.history.times().end());
  const std::vector<int> part_of = connected_parts(parts.mesh);
  const auto add = [&](const NodalField<dim>& shifts) {
    std::vector<Vector<dim>>& x = meshes.emplace_back(parts.mesh.nodes);
    for (std::size_t node = 0; node < x.size(); ++node)
      x[node] += shifts.row(part_of[node]).transpose();
  };
  NodalField<dim> last = NodalField<dim>::Zero(*std::ranges::max_element(part_of) + 1, dim);
  for (auto from = times.begin(); from != times.end(); ++from) {
    const auto to = std::next(from) == times.end() ? from : std::next(from);
    for (int k = 0; k <= between; ++k) {
      const double t = *from + (*to - *from) * k / between;
      const NodalField<dim> shifts = shifts_at(parts, part_of, t, *from);
      if (shifts != last) add(shifts);
      last = shifts;
    }
  }
  return meshes;
}

template std::vector<std::vector<Vector<2>>> carried_meshes(const AssemblyParts<2>&);
template std::vector<std::vector<Vector<3>>> carried_meshes(const AssemblyParts<3>&);

}  // namespace gnomon::part
