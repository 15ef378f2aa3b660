#include "run/mesh_watch.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>

namespace gnomon {

namespace {

/// One where the model has no such scalar.
double value_of(const std::vector<Scalar>& scalars, const char* name) {
  const Scalar* scalar = find_scalar(scalars, name);
  return scalar ? scalar->value : 1;
}

}  // namespace

void require_sound_mesh(const std::vector<Scalar>& scalars) {
  const double volume = value_of(scalars, "element_volume");
  const double quality = value_of(scalars, "element_quality");
  // What wear leaves of such an element takes ever shorter steps to nowhere.
  if (volume < 0.01)
    throw SolutionError(fmt::format(
        "an element is worn down to {:.2g} of its volume: the body is worn away, or its mesh too "
        "flat for that depth",
        volume));
  if (quality <= 0)
    throw SolutionError(fmt::format(
        "an element of the worn mesh is folded: its scaled Jacobian is {:.2g}", quality));
}

std::vector<MeshWarning> mesh_warnings(const std::vector<Scalar>& scalars) {
  const double volume = value_of(scalars, "element_volume");
  const double quality = value_of(scalars, "element_quality");
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
  const Scalar* gradient = find_scalar(scalars, "displacement_gradient");
  if (gradient && gradient->value > 0.5)
    warnings.push_back(
        {"strain",
         fmt::format("displacements have gradients up to {:.2g}, for which body.kinematics = "
                     "\"small\" is not meant: the result is worthless",
                     gradient->value)});
  return warnings;
}

}  // namespace gnomon
