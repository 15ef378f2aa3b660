// The equations and the model of a stressed body. Rows, in the order of their unknowns:
//
//   u               equilibrium, R(d, u)                                       [force]
//   d (inside)      mesh motion, K d                                           [length]
//   d (surface)     ddot + m (N . g) N / M                                     [length/time]
//   p               C + K p, adjoint of the mesh motion                        [force]
//
// u and p only where the body is elastic.
#pragma once

#include <gnomon/model/physics.hpp>

#include "surface_motion.hpp"

namespace gnomon::stressed {

class StressedModel : public Physics<2> {
public:
  explicit StressedModel(std::shared_ptr<const StressedBody> body);

  /// `worn_volume` is the area that the body has lost. Of its own: `energy` of surface_motion.hpp,
  /// its `elastic_energy`, `surface_length`, the `amplitude` of the wave or of the lobes, and the
  /// curvature of the `sharpest_notch`.
  Observation observe(const State& state) const override;
  /// displacement, shape, driving_stress (mu of the surface), equivalent_stress, element_quality.
  std::vector<GridField> fields(const State& state) const override;
  /// The free surface, which has no contact: its pressures are zero.
  std::optional<ContactSurface> contact(const State& state) const override;

private:
  struct Equations;
  StressedModel(std::shared_ptr<const StressedBody> body, const Equations& equations);
  std::vector<SurfaceNode<>> nodes(const FieldValues<2>& values) const;
  std::optional<State> exact(double t) const;
  /// Zero where the body is not elastic.
  NodalField<2> displacement(const FieldValues<2>& values) const;

  std::shared_ptr<const StressedBody> body_;
  StressedFields fields_;
};

}  // namespace gnomon::stressed
