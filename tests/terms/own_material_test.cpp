// A user's material: a law at a point and a registration, in one file and without other changes. It
// can be chosen in a scene, and is tested like all registered ones (material_test.cpp).

#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/solid_kernels.hpp>

#include "support/pin.hpp"

namespace gnomon::own_material_test {
namespace {

using namespace testing;

/// Saint Venant and Kirchhoff: phi = lambda/2 (tr E)^2 + mu E : E, E = (F^T F - I)/2.
template <int dim, class Scalar = double>
class SaintVenantPoint {
public:
  using T = Tensor<dim, Scalar>;
  static constexpr Kinematics kinematics = Kinematics::finite;

  SaintVenantPoint(const ElasticModuli& moduli, const T& F)
      : moduli_(moduli), F_(F), E_((F.transpose() * F - T::Identity()) / Scalar(2)) {}

  Scalar energy() const { return hooke(E_).cwiseProduct(E_).sum() / Scalar(2); }
  T stress() const { return F_ * hooke(E_); }
  T stress_change(const T& dF) const {
    const T dE = (dF.transpose() * F_ + F_.transpose() * dF) / Scalar(2);
    return dF * hooke(E_) + F_ * hooke(dE);
  }

private:
  T hooke(const T& E) const {
    return Scalar(moduli_.lambda) * E.trace() * T::Identity() + Scalar(2 * moduli_.mu) * E;
  }
  ElasticModuli moduli_;
  T F_, E_;
};

const Registration<MaterialLaw> registration{{.name = "saint-venant-kirchhoff",
                                              .help = "linear in the Green-Lagrange strain",
                                              .kernels = &law_kernels<SaintVenantPoint>}};

/// Of a pin after a few steps.
struct End {
  double force, half_width, volume;
};

End run(const std::string& law, double young) {
  const auto model = pin_model(
      {elements(8), "body.material=" + law, "body.young_modulus=" + std::to_string(young)});
  const ModelRun run = run_model(*model, "backward-euler", 50, 1e-3, 200);
  return {observed(*model, run.last(), "contact_force"),
          observed(*model, run.last(), "contact_half_width"),
          observed(*model, run.last(), "worn_volume")};
}

TEST(OwnMaterial, RunsASceneThatNamesIt) {
  const End own = run("saint-venant-kirchhoff", 40), paper = run("neo-hookean", 40);
  EXPECT_NEAR(own.force, paper.force, 1e-6 * paper.force);              // what presses the pin
  EXPECT_NEAR(own.volume, paper.volume, 2e-2 * paper.volume);           // k v F t, by any law
  EXPECT_GT(std::abs(own.volume - paper.volume), 1e-6 * paper.volume);  // but not the same body
  // With a stiff body both are linear elasticity.
  const End stiff = run("saint-venant-kirchhoff", 1e5), linear = run("neo-hookean", 1e5);
  EXPECT_NEAR(stiff.volume, linear.volume, 1e-5 * linear.volume);
}

TEST(OwnMaterial, IsAChoiceOfEveryWornBody) {
  for (const Key& key : key_table("pin_on_flat")) {
    if (key.name != "body.material" && key.name != "shape.energy") continue;
    EXPECT_NE(std::ranges::find(key.choices, "saint-venant-kirchhoff"), key.choices.end());
  }
}

}  // namespace
}  // namespace gnomon::own_material_test
