// Checks the mesh: elements that are nearly worn away, or folded, end a run.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/model/observation.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Throws SolutionError for a state with an element that is folded (element_quality not positive)
/// or has less than a hundredth of its volume (element_volume).
void require_sound_mesh(const Observation& observed);

struct MeshWarning {
  std::string about;  ///< subject; only one warning per subject is needed
  std::string text;
};

/// The least scaled Jacobian of a mesh before any wear; 1 without one.
double initial_quality(const std::optional<Grid>& grid);

/// Warnings when one of these limits is near (a tenth of the volume, a scaled Jacobian of 0.1), or
/// when small strains are not small (displacement_gradient above one half). `initial`: the
/// initial_quality() of the mesh; where it was below 0.1 already and wear has not halved it, the
/// warning is about the mesh, not about wear.
std::vector<MeshWarning> mesh_warnings(const Observation& observed, double initial);

}  // namespace gnomon
