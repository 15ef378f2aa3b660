// The normal that conserves volume: what the shape has lost is what has worn, on every mesh.

#include <cmath>

#include "support/pin.hpp"

namespace gnomon {
namespace {

using namespace testing;

constexpr double k_v_F = 2e-3, end = 400;

struct End {
  double volume, height;
};

/// The pin of n x n elements at `end`; height: of the centre of its surface.
End worn_pin(int n, const Overrides& more, const char* integrator = "esdirk-4",
             double rtol = 1e-5) {
  Overrides overrides = {elements(n)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const PinRun run = run_pin(integrator, 0, rtol, end, overrides);
  const ContactSurface surface = run.model->contact(run.last()).value();
  return {run.observed("worn_volume"), surface.worn[surface.worn.size() / 2][1]};
}

TEST(ConservativeNormal, LosesTheVolumeThatWearsByEveryFamily) {
  for (const char* integrator : {"esdirk-4", "bdf", "erk-4"}) {
    const double worn = worn_pin(8, {"wear.normal=conservative"}, integrator).volume;
    EXPECT_NEAR(worn / (k_v_F * end), 1, 2e-5) << integrator;
  }
  const double averaged = worn_pin(8, {"wear.normal=averaged"}).volume;
  EXPECT_LT(averaged, 0.995 * k_v_F * end);
}

TEST(ConservativeNormal, HoldsOnDistortedMeshesAndHeldSides) {
  for (const Overrides& more :
       {Overrides{"mesh.distortion=0.2"}, {"pin.sides=held"}, {"shape.constraint=multiplier"},
        {"friction.coefficient=0.2"}}) {
    Overrides all = more;
    all.push_back("wear.normal=conservative");
    EXPECT_NEAR(worn_pin(8, all).volume / (k_v_F * end), 1, 2e-5) << more.front();
  }
}

// Worn from a polygon of the true area the surface is where finer meshes have it; from one with its
// nodes on the parabola it is too deep, by the height that such a polygon lacks.
TEST(ConservativeNormal, NeedsAPolygonOfTheTrueArea) {
  const auto height = [](int n, const char* polygon) {
    return worn_pin(n, {"wear.normal=conservative", std::string("mesh.polygon=") + polygon}).height;
  };
  const double fine = height(40, "area");
  const double area = height(20, "area"), nodes = height(20, "nodes");
  std::printf("height of the centre: 40x40 %.5f, 20x20 %.5f, with nodes on the parabola %.5f mm\n",
              fine, area, nodes);
  EXPECT_LT(std::abs(area - fine), 0.35 * std::abs(nodes - fine));
}

TEST(ConservativeNormal, AlsoOfABallInSpace) {
  const auto worn = [](const char* normal) {
    const auto model = model_of("ball_on_flat/finite_deformation.toml",
                                {"mesh.elements=[3, 2, 2]", std::string("wear.normal=") + normal});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1000);
    return observed(*model, run.last(), "worn_volume") / observed(*model, run.last(), "wear_flux");
  };
  // The flux is nearly constant: volume = flux x time.
  const double lost = std::abs(worn("averaged") / 1000 - 1);
  EXPECT_LT(std::abs(worn("conservative") / 1000 - 1), 0.1 * lost);
  EXPECT_GT(lost, 1e-3);
}

}  // namespace
}  // namespace gnomon
