// The ball under an oscillating load, with friction: contact is lost and regained.

#include <cmath>

#include "ball/coarse.hpp"

namespace gnomon::load_history_test {
namespace {

using namespace testing;

const Overrides oscillating = {"load.times=[0, 100, 200, 300, 400]",
                               "load.factors=[1, 1e-3, 1, 1e-3, 1]"};
double breath(double t) {
  const double phase = std::fmod(t, 200) / 100;
  return phase < 1 ? 1 - 0.999 * phase : 0.001 + 0.999 * (phase - 1);
}

Eigen::VectorXd wear(const Model& model, const State& state) {
  const std::vector<double> depth = model.contact(state)->wear_depth;
  return Eigen::Map<const Eigen::VectorXd>(depth.data(), static_cast<long>(depth.size()));
}

TEST(BreathingBall, WearsByTheForceAndAgreesWithBdf) {
  for (const char* scene : {ball_small, ball_finite}) {
    SCOPED_TRACE(scene);
    const auto model = model_of(scene, ball_mesh(4, 2, 1) + oscillating);
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 400, false, to_rounding);
    double least = 1e9, most = 0;
    for (const State& state : run.states) {
      EXPECT_NEAR(observed(*model, state, "wear_flux") / 0.005, breath(state.t), 1e-8) << state.t;
      least = std::min(least, observed(*model, state, "contact_nodes"));
      most = std::max(most, observed(*model, state, "contact_nodes"));
    }
    EXPECT_LT(least, 0.5 * most);
    const ModelRun bdf = run_model(*model, "bdf", 0, 1e-4, 400);
    const Eigen::VectorXd depth = wear(*model, run.last());
    EXPECT_LT((wear(*model, bdf.last()) - depth).norm(), 100 * 1e-4 * depth.norm());
  }
}

TEST(BreathingGroove, AgreesWithBdf) {
  const auto model = model_of(
      groove_small, block_mesh(6, 12, 4, 0.08) + Overrides{"load.times=[0, 2, 4, 6, 8]",
                                                           "load.factors=[1, 1e-3, 1, 1e-3, 1]"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 8);
  const ModelRun bdf = run_model(*model, "bdf", 0, 1e-3, 8);
  const Eigen::VectorXd depth = wear(*model, run.last());
  EXPECT_LT((wear(*model, bdf.last()) - depth).norm(), 1e-2 * depth.norm());
}

}  // namespace
}  // namespace gnomon::load_history_test
