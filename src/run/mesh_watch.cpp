#include "run/mesh_watch.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>

namespace gnomon {

namespace {
constexpr double sound = 1;  // volume and quality where a model has no mesh
}

void require_sound_mesh(const Observation& observed) {
  const double volume = observed.element_volume.value_or(sound);
  const double quality = observed.element_quality.value_or(sound);
  // With such an element steps would become ever shorter without an end.
  if (volume < 0.01)
    throw SolutionError(fmt::format(
        "an element is worn down to {:.2g} of its volume: the body is worn away, or its mesh too "
        "flat for that depth",
        volume));
  if (quality <= 0)
    throw SolutionError(fmt::format(
        "an element of the worn mesh is folded: its scaled Jacobian is {:.2g}", quality));
}

std::vector<MeshWarning> mesh_warnings(const Observation& observed) {
  const double volume = observed.element_volume.value_or(sound);
  const double quality = observed.element_quality.value_or(sound);
  std::vector<MeshWarning> warnings;
  if (volume < 0.1)
    warnings.push_back(
        {"wear",
         fmt::format("an element is worn down to {:.2g} of its volume; at 0.01 the run ends",
                     volume)});
  else if (quality < 0.1)
    warnings.push_back(
        {"wear",
         fmt::format("an element of the worn mesh is nearly folded: its scaled Jacobian is {:.2g}",
                     quality)});
  const double gradient = observed.displacement_gradient.value_or(0);
  if (gradient > 0.5)
    warnings.push_back(
        {"strain",
         fmt::format("displacements have gradients up to {:.2g}, for which body.kinematics = "
                     "\"small\" is not meant: the result is worthless",
                     gradient)});
  return warnings;
}

}  // namespace gnomon
