#include "shape_support.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "groups.hpp"

namespace gnomon::part {

std::vector<Key> shape_support_keys() {
  return {{.name = "shape.reach",
           .unit = "mm",
           .presence = Key::Presence::optional,
           .absent_meaning = "the whole body, or, where it is large, what the wear is expected to "
                             "move (gnomon check tells)",
           .range = positive_quantity,
           .help = "distance from the wearing surfaces up to which the mesh moves (Remark 2)"},
          {.name = "shape.hold",
           .kind = KeyKind::texts,
           .presence = Key::Presence::defaulted,
           .default_value = std::vector<std::string>{},
           .help = "groups of the mesh whose shape is held altogether"},
          {.name = "shape.slide",
           .kind = KeyKind::texts,
           .presence = Key::Presence::defaulted,
           .default_value = std::vector<std::string>{},
           .help = "groups that are nearly planes or round cylinders, whose shape slides along the "
                   "coordinate directions that lie in them; exact ones do so without being named"}};
}

namespace {

/// 1 where a side holds a component of the shape.
template <int dim>
using Held = std::array<char, dim>;

/// A side with this unit normal slides along the coordinate directions that lie in it, but for a
/// part of its length.
template <int dim>
Held<dim> held_across(const Vector<dim>& normal, double tolerance) {
  Held<dim> held;
  for (int i = 0; i < dim; ++i) held[i] = normal[i] * normal[i] > 2 * tolerance;
  return held;
}

template <int dim>
bool slides(const Held<dim>& held) {
  return std::count(held.begin(), held.end(), char{1}) < dim;
}

template <int dim>
Vector<dim> facet_normal(const Mesh<dim>& mesh, const typename Mesh<dim>::Facet& facet) {
  if constexpr (dim == 2) {
    const Vector<2> edge = mesh.nodes[facet[1]] - mesh.nodes[facet[0]];
    return Vector<2>(edge[1], -edge[0]).normalized();
  } else {
    const Vector<3> a = mesh.nodes[facet[2]] - mesh.nodes[facet[0]];
    const Vector<3> b = mesh.nodes[facet[3]] - mesh.nodes[facet[1]];
    return a.cross(b).normalized();
  }
}

template <int dim>
void hold(WornBody<dim>& body, int node, const Held<dim>& held) {
  for (int i = 0; i < dim; ++i)
    if (held[i]) body.shape_fixed(node, i) = 1;
}

template <int dim>
constexpr Held<dim> altogether() {
  Held<dim> held;
  held.fill(1);
  return held;
}

template <int dim>
typename Mesh<dim>::Facet sorted(typename Mesh<dim>::Facet facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

/// Whether all nodes of a side have one distance from an axis along a coordinate direction, to a
/// part of it. By the circle with the least squares of the algebraic distances.
template <int dim>
bool is_round(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets, int axis,
              double tolerance) {
  std::set<int> nodes;
  for (const auto& facet : facets) nodes.insert(facet.begin(), facet.end());
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
  const Eigen::SelfAdjointEigenSolver<Tensor<3>> spectrum(matrix);
  constexpr double straight = 1e-10;  // nodes on a line have no circle
  if (spectrum.eigenvalues()[0] < straight * spectrum.eigenvalues()[2]) return false;
  const Vector<3> circle = matrix.ldlt().solve(right);
  const Vector<2> centre = circle.head<2>();
  const double radius = std::sqrt(circle[2] + centre.squaredNorm());
  return std::all_of(nodes.begin(), nodes.end(), [&](int node) {
    const Vector<2> x = (across(node) - middle) / size;
    return std::abs((x - centre).norm() - radius) <= tolerance * radius;
  });
}

/// What a side holds as a whole: as a plane, or as a round cylinder along a coordinate direction,
/// whose facets need not lie along it.
template <int dim>
Held<dim> held_by_side(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                       double tolerance) {
  const FlatPart<dim> plane = flat_part<dim>(mesh, facets, tolerance);
  if (plane.flat) return held_across<dim>(plane.normal, tolerance * tolerance);
  Held<dim> held = altogether<dim>();
  if constexpr (dim == 3)
    for (int axis = 0; axis < 3; ++axis)
      if (is_round<3>(mesh, facets, axis, tolerance)) held[axis] = 0;
  return held;
}

/// What the sides hold that slide as a whole: those that the scene names, and round ones.
template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> sliding_sides(const Scene& scene,
                                                             const ImportedBody<dim>& part) {
  constexpr double nearly = 1e-2, exactly = 1e-7;  // of its size and of its direction
  std::map<typename Mesh<dim>::Facet, Held<dim>> sides;
  const auto add = [&](const auto& facets, const Held<dim>& held) {
    for (const auto& facet : facets) sides[sorted<dim>(facet)] = held;
  };
  for (const auto& [name, facets] : part.mesh.boundary)
    if (const Held<dim> held = held_by_side<dim>(part.mesh, facets, exactly); slides<dim>(held))
      add(facets, held);
  for (const std::string& name : scene.texts("shape.slide")) {
    const auto& facets = group_facets(scene, "shape.slide", name, part);
    const Held<dim> held = held_by_side<dim>(part.mesh, facets, nearly);
    if (!slides<dim>(held))
      throw InputError(fmt::format(
          "{}: expected sides that are planar or round cylinders, to a hundredth, and along a "
          "coordinate direction, \"{}\" is none; name it in shape.hold, or nowhere",
          scene.where("shape.slide"), name));
    add(facets, held);
  }
  return sides;
}

/// Sides by their facets: along the coordinate directions that lie in them they slide.
template <int dim>
void hold_sides(const Scene& scene, const ImportedBody<dim>& part,
                const std::vector<typename Mesh<dim>::Facet>& wearing, WornBody<dim>& body) {
  std::set<typename Mesh<dim>::Facet> worn;
  for (const auto& facet : wearing) worn.insert(sorted<dim>(facet));
  const auto sides = sliding_sides(scene, part);
  for (const auto& facet : part.exterior) {
    const auto key = sorted<dim>(facet);
    if (worn.contains(key)) continue;
    const auto found = sides.find(key);
    const Held<dim> held = found != sides.end()
                               ? found->second
                               : held_across<dim>(facet_normal(part.mesh, facet), 1e-9);
    for (int node : facet) hold<dim>(body, node, held);
  }
}

template <int dim>
void hold_named(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body) {
  for (const std::string& name : scene.texts("shape.hold"))
    for (const auto& facet : group_facets(scene, "shape.hold", name, part))
      for (int node : facet) hold<dim>(body, node, altogether<dim>());
}

/// Nodes in boxes as large as the reach, so that only neighbouring boxes are searched.
template <int dim>
class NearNodes {
public:
  NearNodes(const Mesh<dim>& mesh, const std::vector<char>& chosen, double reach)
      : mesh_(mesh), reach_(reach) {
    for (std::size_t node = 0; node < chosen.size(); ++node)
      if (chosen[node]) boxes_[key(box_of(mesh.nodes[node]))].push_back(static_cast<int>(node));
  }
  bool contains(const Vector<dim>& x) const {
    const Box centre = box_of(x);
    Box box = centre;
    return search(x, centre, box, 0);
  }

private:
  using Box = std::array<long, dim>;
  Box box_of(const Vector<dim>& x) const {
    Box box;
    for (int i = 0; i < dim; ++i) box[i] = static_cast<long>(std::floor(x[i] / reach_));
    return box;
  }
  static std::size_t key(const Box& box) {
    std::size_t hash = 0;
    for (long i : box) hash = hash * 1000003 + static_cast<std::size_t>(i);
    return hash;
  }
  bool search(const Vector<dim>& x, const Box& centre, Box& box, int axis) const {
    if (axis < dim) {
      for (long step = -1; step <= 1; ++step) {
        box[axis] = centre[axis] + step;
        if (search(x, centre, box, axis + 1)) return true;
      }
      return false;
    }
    const auto found = boxes_.find(key(box));
    if (found == boxes_.end()) return false;
    return std::any_of(found->second.begin(), found->second.end(), [&](int node) {
      return (mesh_.nodes[node] - x).squaredNorm() <= reach_ * reach_;
    });
  }
  const Mesh<dim>& mesh_;
  double reach_;
  std::unordered_map<std::size_t, std::vector<int>> boxes_;
};

template <int dim>
double longest_edge(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets) {
  double size = 0;
  for (const auto& facet : facets)
    for (std::size_t k = 1; k < facet.size(); ++k)
      size = std::max(size, (mesh.nodes[facet[k]] - mesh.nodes[facet[k - 1]]).norm());
  return size;
}

/// A small body moves as a whole. In a large one elements strain by no more than a twentieth where
/// the mesh moves over twenty depths, and over four facets at least.
template <int dim>
double default_reach(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& wearing,
                     double expected_depth) {
  constexpr std::size_t small = 20'000;  // nodes
  if (mesh.nodes.size() < small) return std::numeric_limits<double>::infinity();
  return std::max(20 * expected_depth, 4 * longest_edge(mesh, wearing));
}

}  // namespace

template <int dim>
double read_shape_support(const Scene& scene, const ImportedBody<dim>& part,
                          const std::vector<typename Mesh<dim>::Facet>& wearing,
                          double expected_depth, WornBody<dim>& body) {
  const auto nodes = static_cast<Eigen::Index>(part.mesh.nodes.size());
  body.shape_fixed = NodalFlags<dim>::Zero(nodes, dim);
  hold_sides(scene, part, wearing, body);
  hold_named(scene, part, body);
  const double reach =
      scene.real_if("shape.reach").value_or(default_reach(part.mesh, wearing, expected_depth));
  if (!std::isfinite(reach)) return reach;
  std::vector<char> worn(part.mesh.nodes.size());
  for (const auto& facet : wearing)
    for (int node : facet) worn[node] = 1;
  const NearNodes<dim> near(part.mesh, worn, reach);
  for (Eigen::Index node = 0; node < nodes; ++node)
    if (!near.contains(part.mesh.nodes[node])) body.shape_fixed.row(node).setOnes();
  return reach;
}

template double read_shape_support(const Scene&, const ImportedBody<2>&,
                                   const std::vector<Mesh<2>::Facet>&, double, WornBody<2>&);
template double read_shape_support(const Scene&, const ImportedBody<3>&,
                                   const std::vector<Mesh<3>::Facet>&, double, WornBody<3>&);

}  // namespace gnomon::part
