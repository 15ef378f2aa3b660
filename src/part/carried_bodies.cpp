#include "part/carried_bodies.hpp"

#include <algorithm>
#include <gnomon/shapes/counter_surface.hpp>
#include <iterator>
#include <set>

#include "model/connected_parts.hpp"

namespace gnomon::part {

namespace {

/// Of each of `count` connected parts of the mesh: the mean displacement of what supports move.
template <int dim>
NodalField<dim> shifts_at(const AssemblyParts<dim>& parts, const std::vector<int>& part_of,
                          Eigen::Index count, double t, double within) {
  NodalField<dim> sum = NodalField<dim>::Zero(count, dim), moved_nodes = sum;
  for (const PrescribedValues& moved : parts.supports.moved)
    for (const auto& [node, i, value] : moved.entries) {
      sum(part_of[static_cast<std::size_t>(node)], i) += value * moved.history.factor(t, within);
      moved_nodes(part_of[static_cast<std::size_t>(node)], i) += 1;
    }
  return (sum.array() / moved_nodes.array().max(1)).matrix();
}

/// Those that differ by a part of the size of the mesh, in the order of the histories.
template <int dim>
std::vector<NodalField<dim>> shifts_of(const AssemblyParts<dim>& parts,
                                       const std::vector<int>& part_of, double end) {
  constexpr double little = 1.0 / 200;
  constexpr int between = 8;
  constexpr std::size_t most = 100;
  const double apart = little * Box<dim>::around(parts.mesh.nodes).diagonal();
  std::set<double> times = {0};
  for (const PrescribedValues& moved : parts.supports.moved)
    for (const double t : moved.history.times()) times.insert(std::min(t, end));
  const Eigen::Index count = *std::ranges::max_element(part_of) + 1;
  std::vector<NodalField<dim>> shifts = {NodalField<dim>::Zero(count, dim)};
  for (auto from = times.begin(); from != times.end(); ++from) {
    const auto to = std::next(from) == times.end() ? from : std::next(from);
    for (int k = 0; k <= between && shifts.size() < most; ++k) {
      const double t = *from + (*to - *from) * k / between;
      const NodalField<dim> shift = shifts_at(parts, part_of, count, t, *from);
      const auto is_near = [&](const NodalField<dim>& other) {
        return (other - shift).rowwise().norm().maxCoeff() <= apart;
      };
      if (std::ranges::none_of(shifts, is_near)) shifts.push_back(shift);
    }
  }
  return shifts;
}

}  // namespace

template <int dim>
std::vector<std::vector<Vector<dim>>> carried_meshes(const AssemblyParts<dim>& parts, double end) {
  std::vector<std::vector<Vector<dim>>> meshes;
  if (parts.supports.moved.empty()) return {parts.mesh.nodes};
  const std::vector<int> part_of = connected_parts(parts.mesh);
  for (const NodalField<dim>& shift : shifts_of(parts, part_of, end)) {
    std::vector<Vector<dim>>& x = meshes.emplace_back(parts.mesh.nodes);
    for (std::size_t node = 0; node < x.size(); ++node)
      x[node] += shift.row(part_of[node]).transpose();
  }
  return meshes;
}

template std::vector<std::vector<Vector<2>>> carried_meshes(const AssemblyParts<2>&, double);
template std::vector<std::vector<Vector<3>>> carried_meshes(const AssemblyParts<3>&, double);

}  // namespace gnomon::part
