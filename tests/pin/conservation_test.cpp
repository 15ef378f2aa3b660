// The conservative normal: the lost volume is equal to the wear integral, on every mesh.

#include <cmath>

#include "support/pin.hpp"

namespace gnomon::conservation_test {
namespace {

using namespace testing;

constexpr double k_v_F = 2e-3, end = 400;

/// The volume that the pin of n x n elements has lost at `end`.
double worn_volume(int n, const Overrides& more, const char* integrator = "esdirk-4",
                   double rtol = 1e-5) {
  Overrides overrides = {elements(n)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const PinRun run = run_pin(integrator, 0, rtol, end, overrides);
  return run.observed("worn_volume");
}

TEST(ConservativeNormal, LosesTheVolumeThatWearsByEveryFamily) {
  for (const char* integrator : {"esdirk-4", "bdf", "erk-4"}) {
    const double worn = worn_volume(8, {"wear.normal=conservative"}, integrator);
    EXPECT_NEAR(worn / (k_v_F * end), 1, 2e-5) << integrator;
  }
  const double averaged = worn_volume(8, {"wear.normal=averaged"});
  EXPECT_LT(averaged, 0.995 * k_v_F * end);
}

TEST(ConservativeNormal, HoldsOnDistortedMeshesAndHeldSides) {
  for (const Overrides& more : {Overrides{"mesh.distortion=0.2"},
                                {"pin.sides=held"},
                                {"shape.constraint=multiplier"},
                                {"friction.coefficient=0.2"}}) {
    Overrides all = more;
    all.push_back("wear.normal=conservative");
    EXPECT_NEAR(worn_volume(8, all) / (k_v_F * end), 1, 2e-5) << more.front();
  }
}

/// Heights of the centre of the surface at times at which contact grows over one facet after the
/// other.
std::vector<double> heights(int n, const char* normal) {
  const auto model = pin_model({elements(n), std::string("wear.normal=") + normal});
  const IntegratorSettings settings = controlled_settings(*model, 1e-5, 1000);
  Counters counters;
  State state = model->start(counters);
  const auto stepper =
      Integrators::find("esdirk-4", "integrator").make(model->system(), settings, counters);
  std::vector<double> result;
  for (double t = 100; t <= 1000; t += 50) {
    while (state.t < t) stepper->advance(state, t);
    const ContactSurface surface = model->contact(state).value();
    result.push_back(surface.worn[surface.worn.size() / 2][1]);
  }
  return result;
}

// While the edge of contact crosses a facet, the depth of a coarse mesh goes up and down by a
// fraction of h^2/R around that of a fine one; its mean is right; with the paper's normal it is too
// small by the missing volume.
TEST(ConservativeNormal, WearsAsDeepAsAFineMeshInTheMean) {
  const std::vector<double> fine = heights(40, "conservative");
  const auto mean_difference = [&](const char* normal) {
    const std::vector<double> coarse = heights(20, normal);
    double sum = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) sum += coarse[k] - fine[k];
    return sum / static_cast<double>(fine.size());
  };
  const double conservative = mean_difference("conservative"),
               averaged = mean_difference("averaged");
  std::printf("mean difference of the depth, 20x20 to 40x40: %.1e mm, with eq. 35 %.1e mm\n",
              conservative, averaged);
  EXPECT_LT(std::abs(conservative), 2e-4);
  EXPECT_LT(averaged, -3e-4);
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
}  // namespace gnomon::conservation_test
