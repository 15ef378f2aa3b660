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

/// Whether the worn volume differs from the wear integral by a tenth of it or more; smaller
/// differences may come from the mesh. False without wear, or if the wear is too small to be seen
/// in the volume.
bool has_lost_wear(const Observation& observed);

}  // namespace gnomon
