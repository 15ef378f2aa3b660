// The groups of a mesh that a scene names, for purposes that may exclude each other. Messages name
// the key as well as the names that there are.
#pragma once

#include <gnomon/base/mistakes.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::part {

template <int dim>
using Facets = std::vector<typename Mesh<dim>::Facet>;

/// The facets of a group that `key` names. Throws InputError.
template <int dim>
const Facets<dim>& group_facets(const Scene& scene, const std::string& key, const std::string& name,
                                const ImportedBody<dim>& part);

/// The nodes of a group of facets, or of points, that `key` names. Throws InputError.
template <int dim>
std::vector<int> group_nodes(const Scene& scene, const std::string& key, const std::string& name,
                             const ImportedBody<dim>& part);

/// Adds all names of groups that the mesh does not have; also for a scene in which keys have no
/// value.
template <int dim>
void find_unknown_groups(const Scene& scene, const ImportedBody<dim>& part, Mistakes& mistakes);

/// Adds what needs no mesh: groups named twice in a list, wearing groups whose shape is held,
/// groups whose shape is to be held and to slide, a coefficient of wear that no surface reads.
void find_conflicts(const Scene& scene, Mistakes& mistakes);

/// Remarks where several loads act on one group, for they add up, and where a load acts on a
/// wearing surface.
std::vector<std::string> remarks_on_loads(const Scene& scene);

/// Remarks where a support holds several points of one body, for a pivot is one.
template <int dim>
std::vector<std::string> remarks_on_pivots(const Scene& scene, const ImportedBody<dim>& part);

/// Throws InputError for a rigid support on a wearing surface along its normal: it would carry the
/// contact pressure there.
template <int dim>
void require_free_contact(const Scene& scene, const ImportedBody<dim>& part);

/// Throws InputError where wear is wanted, but the shape is held at every contact node.
template <int dim>
void require_moving_shape(const Scene& scene, const std::vector<ContactPatch<dim>>& patches,
                          const ShapeMotion<dim>& shape);

}  // namespace gnomon::part
