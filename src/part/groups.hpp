// The groups of a mesh that a scene names; messages name the key as well as the names that there
// are.
#pragma once

#include <gnomon/base/mistakes.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::part {

/// The facets of a group that `key` names. Throws InputError.
template <int dim>
const std::vector<typename Mesh<dim>::Facet>& group_facets(const Scene& scene,
                                                           const std::string& key,
                                                           const std::string& name,
                                                           const ImportedBody<dim>& part);

/// The nodes of a group of facets, or of points, that `key` names. Throws InputError.
template <int dim>
std::vector<int> group_nodes(const Scene& scene, const std::string& key, const std::string& name,
                             const ImportedBody<dim>& part);

/// Adds all names of groups that the mesh does not have; also for a scene in which keys have no
/// value.
template <int dim>
void find_unknown_groups(const Scene& scene, const ImportedBody<dim>& part, Mistakes& mistakes);

}  // namespace gnomon::part
