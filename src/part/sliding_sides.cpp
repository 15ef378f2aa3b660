#include "part/sliding_sides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <numeric>
#include <set>

#include "base/spectrum.hpp"
#include "mesh/facet_table.hpp"
#include "part/groups.hpp"

namespace gnomon::part {

namespace {

constexpr double exactly = 1e-7;  // of the size of a side and of its direction

/// What a plane with this unit normal holds; coordinate directions that lie in it to the tolerance
/// do so exactly.
template <int dim>
Held<dim> held_across(Vector<dim> normal, double tolerance) {
  for (double& component : normal)
    if (std::abs(component) <= tolerance) component = 0;
  normal.normalize();
  return normal * normal.transpose();
}

/// Whether all nodes of a side have one distance from an axis along a coordinate direction, to a
/// part of it. By the circle with the least squares of the algebraic distances.
template <int dim>
bool is_round(const Mesh<dim>& mesh, const Facets<dim>& facets, int axis, double tolerance) {
  const std::set<int> nodes = nodes_of_facets(facets);
  const auto across = [&](int node) {
    const Vector<dim>& X = mesh.nodes[node];
    return Vector<2>(X[(axis + 1) % dim], X[(axis + 2) % dim]);
  };
  Vector<2> middle = Vector<2>::Zero();
  for (int node : nodes) middle += across(node) / double(nodes.size());
  double size = 0;
  for (int node : nodes) size = std::max(size, (across(node) - middle).norm());
  if (nodes.size() < 4 || size == 0) return false;
  // |x|^2 = 2 c . x + e
  Tensor<3> matrix = Tensor<3>::Zero();
  Vector<3> right = Vector<3>::Zero();
  for (int node : nodes) {
    const Vector<2> x = (across(node) - middle) / size;
    const Vector<3> row(2 * x[0], 2 * x[1], 1);
    matrix += row * row.transpose();
    right += x.squaredNorm() * row;
  }
  const Eigen::VectorXd values = spectrum_of(matrix).values;
  constexpr double straight = 1e-10;  // nodes on a line have no circle
  if (values[0] < straight * values[2]) return false;
  const Vector<3> circle = pseudo_inverse(matrix) * right;
  const Vector<2> centre = circle.head<2>();
  const double radius = std::sqrt(circle[2] + centre.squaredNorm());
  return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    const Vector<2> x = (across(node) - middle) / size;
    return std::abs((x - centre).norm() - radius) <= tolerance * radius;
  });
}

/// What a facet holds that is not known to belong to a plane: it may be one of a curved side,
/// unless it lies across a coordinate direction.
template <int dim>
Held<dim> held_by_facet(const Vector<dim>& normal) {
  const Held<dim> held = held_across<dim>(normal, 5e-5);
  return held.isDiagonal(0) ? held : altogether<dim>();
}

/// What a side holds as a whole: as a plane, or as a round cylinder along a coordinate direction,
/// whose facets need not lie along it.
template <int dim>
Held<dim> held_by_side(const Mesh<dim>& mesh, const Facets<dim>& facets, double tolerance) {
  const FlatPart<dim> plane = flat_part<dim>(mesh, facets, tolerance);
  if (plane.flat) return held_across<dim>(plane.normal, std::sqrt(2) * tolerance);
  Held<dim> held = altogether<dim>();
  if constexpr (dim == 3)
    for (int axis = 0; axis < 3; ++axis)
      if (is_round<3>(mesh, facets, axis, tolerance)) held(axis, axis) = 0;
  return held;
}

/// The k-th edge of a facet in space, or end in the plane, by which it meets its neighbour.
template <int dim>
std::array<int, 2> border(const typename Mesh<dim>::Facet& facet, std::size_t k) {
  if constexpr (dim == 2) return {facet[k], facet[k]};
  const auto [least, most] = std::minmax(facet[k], facet[(k + 1) % facet.size()]);
  return {least, most};
}

/// Parts of a surface without sharp edges.
template <int dim>
std::vector<Facets<dim>> smooth_sheets(const Mesh<dim>& mesh, const Facets<dim>& facets) {
  constexpr double sharp = 40 * M_PI / 180;
  std::vector<int> sheet(facets.size());
  std::iota(sheet.begin(), sheet.end(), 0);
  const auto root = [&](int k) {
    while (sheet[k] != k) k = sheet[k] = sheet[sheet[k]];
    return k;
  };
  std::map<std::array<int, 2>, int> first_at;  // facet by border
  for (int k = 0; k < static_cast<int>(facets.size()); ++k)
    for (std::size_t i = 0; i < facets[k].size(); ++i) {
      const auto [other, is_first] = first_at.try_emplace(border<dim>(facets[k], i), k);
      if (!is_first &&
          area_vector(mesh, facets[k])
                  .normalized()
                  .dot(area_vector(mesh, facets[other->second]).normalized()) > std::cos(sharp))
        sheet[root(k)] = root(other->second);
    }
  std::map<int, Facets<dim>> by_root;
  for (int k = 0; k < static_cast<int>(facets.size()); ++k) by_root[root(k)].push_back(facets[k]);
  std::vector<Facets<dim>> sheets;
  for (auto& [number, members] : by_root) sheets.push_back(std::move(members));
  return sheets;
}

}  // namespace

template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> held_by_sides(const Scene& scene,
                                                             const ImportedBody<dim>& part,
                                                             const Facets<dim>& wearing) {
  std::map<typename Mesh<dim>::Facet, Held<dim>> sides;
  std::set<typename Mesh<dim>::Facet> worn;
  for (const auto& facet : wearing) worn.insert(sorted(facet));
  Facets<dim> rest;
  for (const auto& facet : part.exterior)
    if (!worn.contains(sorted(facet))) {
      rest.push_back(facet);
      sides[sorted(facet)] = held_by_facet<dim>(area_vector(part.mesh, facet).normalized());
    }
  const auto slide = [&](const Facets<dim>& facets, double tolerance) {
    const Held<dim> held = held_by_side<dim>(part.mesh, facets, tolerance);
    if (held == altogether<dim>()) return false;
    for (const auto& facet : facets)
      if (const auto side = sides.find(sorted(facet)); side != sides.end()) side->second = held;
    return true;
  };
  // Groups, because they may end where the surface goes on smoothly; sheets, because not all are
  // named, or have a group of their own.
  for (const Facets<dim>& sheet : smooth_sheets<dim>(part.mesh, rest)) slide(sheet, exactly);
  for (const auto& [name, facets] : part.mesh.boundary) slide(facets, exactly);
  for (const std::string& name : scene.texts("shape.slide"))
    if (!slide(group_facets(scene, "shape.slide", name, part), nearly))
      throw InputError(fmt::format(
          "{}: expected sides that are planar, or round cylinders along a coordinate direction, to "
          "a hundredth, \"{}\" is none; name it in shape.hold, or nowhere",
          scene.where("shape.slide"), name));
  return sides;
}

template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> held_by_bonds(const Mesh<dim>& mesh,
                                                             const Facets<dim>& bonded) {
  std::map<typename Mesh<dim>::Facet, Held<dim>> bonds;
  for (const Facets<dim>& sheet : smooth_sheets<dim>(mesh, bonded)) {
    const Held<dim> held = held_by_side<dim>(mesh, sheet, exactly);
    for (const auto& facet : sheet) bonds[facet] = held;
  }
  return bonds;
}

template std::map<Mesh<2>::Facet, Held<2>> held_by_bonds(const Mesh<2>&, const Facets<2>&);
template std::map<Mesh<3>::Facet, Held<3>> held_by_bonds(const Mesh<3>&, const Facets<3>&);
template std::map<Mesh<2>::Facet, Held<2>> held_by_sides(const Scene&, const ImportedBody<2>&,
                                                         const Facets<2>&);
template std::map<Mesh<3>::Facet, Held<3>> held_by_sides(const Scene&, const ImportedBody<3>&,
                                                         const Facets<3>&);

}  // namespace gnomon::part
