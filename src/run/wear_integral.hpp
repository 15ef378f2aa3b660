// The integral of the scalar "wear_flux" over the accepted steps, by the trapezoidal rule.
#pragma once

#include <gnomon/model/model.hpp>
#include <vector>

namespace gnomon {

class WearIntegral {
public:
  /// Advances the integral to `t` and appends it to the scalars as "wear_integral". Nothing happens
  /// when the model has no wear flux.
  void append_to(std::vector<Scalar>& scalars, double t);
  /// Goes on from the scalars that it was appended to at `t`.
  void resume(const std::vector<Scalar>& scalars, double t);

private:
  double t_ = 0;
  double flux_ = 0;
  double value_ = 0;
  bool started_ = false;
};

/// What wears by the rate must be missing from the shape, but for what the mesh cannot show:
/// whether a tenth of it is not. False where nothing wears, or too little to be seen in the volume.
bool has_lost_wear(const std::vector<Scalar>& scalars);

}  // namespace gnomon
