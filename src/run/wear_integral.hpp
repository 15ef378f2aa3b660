// The integral of the wear flux over the accepted steps, with which the worn volume is compared.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <optional>

namespace gnomon {

class WearIntegral {
public:
  /// Zero at the start of a run; absent if the model has no wear flux.
  explicit WearIntegral(const Model& model);
  /// Continues from the last observation.
  void resume(const Observation& last);
  /// Adds the integral over an accepted step.
  void add(double increment);
  std::optional<double> value() const { return value_; }

private:
  std::optional<double> value_;
};

/// Size of the rounding errors of the worn volume, to an order of magnitude [mm^2 | mm^3]: a part
/// of the box around the mesh, or around the body of revolution that it is a section of (`dim` 3,
/// the axis being x = 0 of a mesh in the plane). Zero without a mesh: the volume is then a sum of
/// depths.
double invisible_volume(const std::optional<Grid>& grid, int dim);

/// Whether the worn volume differs from the wear integral by a tenth of it or more, and by more
/// than rounding errors; smaller differences may come from the mesh. False without wear.
bool has_lost_wear(const Observation& observed, double invisible);

}  // namespace gnomon
