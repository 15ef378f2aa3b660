#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <map>
#include <set>
#include <string>

#include "mesh/facet_table.hpp"

namespace gnomon {

namespace {

/// Position of `node` in the patch; a new node is appended.
template <int dim>
int place_in_patch(ContactPatch<dim>& patch, int node) {
  const auto found = std::find(patch.nodes.begin(), patch.nodes.end(), node);
  if (found != patch.nodes.end()) return static_cast<int>(found - patch.nodes.begin());
  patch.nodes.push_back(node);
  return static_cast<int>(patch.nodes.size()) - 1;
}

template <int dim>
typename ContactPatch<dim>::Corner make_corner(ContactPatch<dim>& patch,
                                               const typename Mesh<dim>::Facet& facet, int local,
                                               Section section) {
  typename ContactPatch<dim>::Corner corner{};
  const int count = static_cast<int>(facet.size());
  corner.nodes[0] = place_in_patch(patch, facet[local]);
  corner.nodes[1] = place_in_patch(patch, facet[(local + 1) % count]);
  if constexpr (dim == 3) {
    corner.nodes[2] = place_in_patch(patch, facet[(local + count - 1) % count]);
    corner.nodes[3] = place_in_patch(patch, facet[(local + 2) % count]);
  }
  corner.sign = local == 0 ? 1 : -1;
  corner.section = section;
  return corner;
}

template <int dim>
void add_corners_beyond(const std::vector<typename Mesh<dim>::Facet>& surface,
                        const std::vector<typename Mesh<dim>::Facet>& boundary, Section section,
                        std::map<int, ContactPatch<dim>>& by_node) {
  std::set<typename Mesh<dim>::Facet> contact;
  for (const auto& facet : surface) contact.insert(sorted(facet));
  for (const auto& facet : boundary) {
    if (contact.contains(sorted(facet))) continue;
    for (std::size_t local = 0; local < facet.size(); ++local)
      if (const auto at = by_node.find(facet[local]); at != by_node.end())
        at->second.corners_beyond.push_back(
            make_corner<dim>(at->second, facet, static_cast<int>(local), section));
  }
}

/// Integral of the shape function of the corner's node over the bilinear facet, whose area element
/// is bilinear, too (where the facet is not plane, nearly).
double integral_of_node(const ContactPatch<3>::Corner& corner, const PatchNodal<3>& X) {
  const auto area_at = [&](int node, int next, int previous) -> Vector<3> {
    const Vector<3> own = X.row(corner.nodes[node]), a = X.row(corner.nodes[next]),
                    b = X.row(corner.nodes[previous]);
    return (a - own).cross(b - own) / 4;
  };
  return (4 * area_at(0, 1, 2) + 2 * area_at(1, 3, 0) + 2 * area_at(2, 0, 3) + area_at(3, 2, 1))
             .norm() /
         9;
}

/// Integral of f, with values of a vector space, over [0, 1], exact to the fifth degree.
template <class Function>
auto integral_0_1(const Function& f) {
  const double off = std::sqrt(0.15);
  return ((5 * f(0.5 - off) + 8 * f(0.5) + 5 * f(0.5 + off)) / 18).eval();
}

/// Mean of (X - X_0)(X - X_0)' over the facet of a corner, weighted by its shape function: that of
/// a segment also with the circumference of a body of revolution, that of a bilinear facet with the
/// weights of a parallelogram.
template <int dim>
Tensor<dim> spread(const typename ContactPatch<dim>::Corner& corner, const PatchNodal<dim>& X) {
  const auto edges = corner_edges<dim, double>(corner, X);
  using Weighted = Eigen::Matrix<double, dim * dim + 1, 1>;  // the dyad and 1
  const auto at = [](const Vector<dim>& x, double weight) {
    Weighted value;
    value << Tensor<dim>(x * x.transpose()).reshaped(), 1;
    return (weight * value).eval();
  };
  Weighted sum;
  if constexpr (dim == 2) {
    sum = integral_0_1([&](double s) {
      const bool turns = corner.section == Section::meridian;
      const double radius = turns ? X(corner.nodes[0], 0) + s * edges(0, 0) : 1;
      return at(s * edges, (1 - s) * radius);
    });
  } else {
    const Vector<3> twist =
        (X.row(corner.nodes[3]) - X.row(corner.nodes[0])).transpose() - edges.rowwise().sum();
    sum = integral_0_1([&](double s) {
      return integral_0_1([&](double t) {
        return at(s * edges.col(0) + t * edges.col(1) + s * t * twist, (1 - s) * (1 - t));
      });
    });
  }
  return (sum.template head<dim * dim>() / sum[dim * dim]).reshaped(dim, dim);
}

template <int dim>
void measure(const Mesh<dim>& mesh, ContactPatch<dim>& patch) {
  PatchNodal<dim> X(patch.nodes.size(), dim);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p)
    X.row(static_cast<int>(p)) = mesh.nodes[patch.nodes[p]].transpose();
  const auto area_vector = [&X](auto& corner) {
    const Vector<dim> S = corner_area_vector<dim, double>(corner, X);
    if constexpr (dim == 3) corner.share = integral_of_node(corner, X) / S.norm();
    corner.initial_area = corner.share * S.norm();
    return Vector<dim>(corner.share * S);
  };
  patch.initial_position = mesh.nodes[patch.node];
  patch.initial_normal.setZero();
  patch.initial_spread.setZero();
  for (auto& corner : patch.corners) {
    patch.initial_normal += area_vector(corner);
    patch.initial_area += corner.initial_area;
    patch.initial_spread += corner.initial_area * spread<dim>(corner, X);
    if (corner.section == Section::meridian && !(corner.initial_area > 0))
      throw Error("contact surface: a facet at node " + std::to_string(patch.node) +
                  " lies on the axis");
  }
  patch.initial_normal.normalize();
  patch.initial_spread /= patch.initial_area;
  for (auto& corner : patch.corners_beyond) area_vector(corner);
}

}  // namespace

template <int dim>
std::vector<ContactPatch<dim>> contact_patches(
    const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
    const std::vector<typename Mesh<dim>::Facet>& boundary, Section section) {
  std::map<int, ContactPatch<dim>> by_node;
  for (const auto& facet : facets)
    for (std::size_t local = 0; local < facet.size(); ++local) {
      ContactPatch<dim>& patch = by_node[facet[local]];
      patch.node = facet[local];
      patch.corners.push_back(make_corner<dim>(patch, facet, static_cast<int>(local), section));
    }
  add_corners_beyond<dim>(facets, boundary, section, by_node);
  std::vector<ContactPatch<dim>> patches;
  for (auto& [node, patch] : by_node) {
    if (patch.corners.size() + patch.corners_beyond.size() > max_patch_facets ||
        patch.nodes.size() > max_patch_nodes)
      throw InputError(fmt::format(
          "the mesh: {} facets meet at ({:.6g}), a node of the contact surface; expected "
          "{} or fewer",
          patch.corners.size() + patch.corners_beyond.size(), fmt::join(mesh.nodes[node], ", "),
          max_patch_facets));
    measure(mesh, patch);
    patches.push_back(std::move(patch));
  }
  return patches;
}

template std::vector<ContactPatch<2>> contact_patches<2>(const Mesh<2>&,
                                                         const std::vector<Mesh<2>::Facet>&,
                                                         const std::vector<Mesh<2>::Facet>&,
                                                         Section);
template std::vector<ContactPatch<3>> contact_patches<3>(const Mesh<3>&,
                                                         const std::vector<Mesh<3>::Facet>&,
                                                         const std::vector<Mesh<3>::Facet>&,
                                                         Section);

}  // namespace gnomon
