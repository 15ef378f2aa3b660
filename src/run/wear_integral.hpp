// The integral of the wear flux over the accepted steps, which the worn volume is held against.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <optional>

namespace gnomon {

class WearIntegral {
public:
  /// Zero at the start of a run; none where the model has no wear flux.
  explicit WearIntegral(const Model& model);
  /// Goes on from what was observed last.
  void resume(const Observation& last);
  /// What wears in an accepted step.
  void add(double increment);
  std::optional<double> value() const { return value_; }

private:
  std::optional<double> value_;
};

/// What wears by the rate must be missing from the shape, but for what the mesh cannot show:
/// whether a tenth of it is not. False where nothing wears, or too little to be seen in the volume.
bool has_lost_wear(const Observation& observed);

}  // namespace gnomon
