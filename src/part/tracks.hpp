// Surfaces that wear by the mean along a track: wear.surfaces.NAME.path.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::part {

/// Whether the scene gives the surface a path.
bool is_track(const Scene& scene, const std::string& surface);

/// Without pairs: throws InputError where the scene gives the surface a path.
void refuse_track(const Scene& scene, const std::string& surface);

/// That of a surface of `parts`, which have pairs; none: it wears where it is in contact. Throws
/// InputError where its material does not pass the contact along straight lines or circles.
template <int dim>
std::optional<Track<dim>> read_track(const Scene& scene, const Surface<dim>& surface,
                                     const AssemblyParts<dim>& parts);

/// Throws InputError where the nodes of a track do not lie on lines along it, or the mesh is longer
/// than the path.
template <int dim>
void require_lines(const Scene& scene, const AssemblyParts<dim>& parts);

/// Throws InputError where sides hold the shape of a line across the surface.
template <int dim>
void require_receding_tracks(const Scene& scene, const AssemblyParts<dim>& parts);

/// How long the path is, the mesh and the contact.
template <int dim>
std::vector<std::string> remarks_on_tracks(const Magnitudes& expected,
                                           const AssemblyParts<dim>& parts);

/// Of pairs in steady motion: surfaces whose material moves on, but that have no track.
template <int dim>
std::vector<std::string> remarks_on_passing_material(const Scene& scene,
                                                     const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
