#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <map>
#include <string>

namespace gnomon {

namespace {

/// Position of `node` in the patch, appended when new.
template <int dim>
int place_in_patch(ContactPatch<dim>& patch, int node) {
  const auto found = std::find(patch.nodes.begin(), patch.nodes.end(), node);
  if (found != patch.nodes.end()) return static_cast<int>(found - patch.nodes.begin());
  patch.nodes.push_back(node);
  return static_cast<int>(patch.nodes.size()) - 1;
}

template <int dim>
typename ContactPatch<dim>::Corner make_corner(ContactPatch<dim>& patch,
                                               const typename Mesh<dim>::Facet& facet, int local) {
  typename ContactPatch<dim>::Corner corner{};
  const int count = static_cast<int>(facet.size());
  corner.nodes[0] = place_in_patch(patch, facet[local]);
  corner.nodes[1] = place_in_patch(patch, facet[(local + 1) % count]);
  if constexpr (dim == 3)
    corner.nodes[2] = place_in_patch(patch, facet[(local + count - 1) % count]);
  for (int node : facet) place_in_patch(patch, node);
  corner.sign = local == 0 ? 1 : -1;
  return corner;
}

}  // namespace

template <int dim>
std::vector<ContactPatch<dim>> contact_patches(
    const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets) {
  std::map<int, ContactPatch<dim>> by_node;
  for (const auto& facet : facets)
    for (std::size_t local = 0; local < facet.size(); ++local) {
      ContactPatch<dim>& patch = by_node[facet[local]];
      patch.node = facet[local];
      patch.corners.push_back(make_corner<dim>(patch, facet, static_cast<int>(local)));
    }
  std::vector<ContactPatch<dim>> patches;
  for (auto& [node, patch] : by_node) {
    if (patch.corners.size() > max_patch_facets || patch.nodes.size() > max_patch_nodes)
      throw Error("contact surface: more than " + std::to_string(max_patch_facets) +
                  " facets meet at node " + std::to_string(node));
    PatchNodal<dim> X(patch.nodes.size(), dim);
    for (std::size_t p = 0; p < patch.nodes.size(); ++p)
      X.row(static_cast<int>(p)) = mesh.nodes[patch.nodes[p]].transpose();
    for (auto& corner : patch.corners) {
      corner.initial_area = corner_area_vector<dim, double>(corner, X).norm();
      patch.initial_area += corner.initial_area;
    }
    patches.push_back(std::move(patch));
  }
  return patches;
}

template std::vector<ContactPatch<2>> contact_patches<2>(const Mesh<2>&,
                                                         const std::vector<Mesh<2>::Facet>&);
template std::vector<ContactPatch<3>> contact_patches<3>(const Mesh<3>&,
                                                         const std::vector<Mesh<3>::Facet>&);

}  // namespace gnomon
