// Watches the mesh: elements that wear has nearly used up, or folded, end a run.
#pragma once

#include <gnomon/model/observation.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// Throws SolutionError for a state with an element that is folded (element_quality not positive)
/// or has less than a hundredth of its volume (element_volume).
void require_sound_mesh(const Observation& observed);

struct MeshWarning {
  std::string about;  ///< the same for all that need be said once only
  std::string text;
};

/// What is said when that is near (a tenth of the volume, a scaled Jacobian of 0.1), or when small
/// strains are not (displacement_gradient above one half).
std::vector<MeshWarning> mesh_warnings(const Observation& observed);

}  // namespace gnomon
