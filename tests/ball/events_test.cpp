// Located events that follow each other closely, in nearly symmetric pairs.

#include <gnomon/system/system.hpp>

#include "ball/coarse.hpp"

namespace gnomon::events_test {
namespace {

using namespace testing;

// After a step that ends on an event, the next one starts with a switching function that is zero up
// to rounding; location must continue to work.
// Every change of the set is reported by the step that switched the
// nodes.
TEST(Ball, EveryChangeOfTheActiveSetIsLocated) {
  const auto model = model_of(ball_small, ball_mesh(5, 2, 2));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-2, 300, true);
  ASSERT_GT(run.counters.events, 5);
  ActiveSet before = run.states.front().branch;
  if (before.empty()) before = active_set(model->system(), 0, run.states.front().y);
  for (std::size_t k = 0; k < run.reports.size(); ++k) {
    const ActiveSet& branch = run.states[k + 1].branch;
    ASSERT_FALSE(branch.empty()) << "a step over a kink, to t = " << run.states[k + 1].t;
    // The state belongs to the branch on which the step was taken: that of its start, or, if nodes
    // switched, the next one.
    if (run.reports[k].switched == 0 && k > 0 && run.reports[k - 1].switched == 0) {
      EXPECT_EQ(branch, before) << run.states[k + 1].t;
    }
    before = branch;
  }
}

// After an event the next one follows very soon, in a step that is a thousand times longer: it is
// found at its own time scale, or the step is shortened. (The interpolation once searched at the
// far end: two of six nodes penetrated the flat, with an error of 84 % of the wear.)
TEST(Ball, AnEventAtTheBeginningOfALongStepIsFound) {
  const auto model =
      model_of(ball_small, ball_mesh(3, 1, 2) +
                               Overrides{"time.end=10", "output.times=[]", "load.force=1",
                                         "load.times=[3.9, 3.9012, 4.7, 9.6]",
                                         "load.factors=[0.018456, 0.103294, 0.41741, 1.11413]",
                                         "body.young_modulus=28939.698", "friction.coefficient=1.5",
                                         "wear.coefficient=7.44388864798367e-05"});
  const auto depths = [&](const char* integrator, double tolerance, bool locate) {
    const ModelRun run = run_model(*model, integrator, 0, tolerance, 10, locate);
    const auto depth = model->contact(run.last())->wear_depth;
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(depth.data(), long(depth.size())));
  };
  const Eigen::VectorXd exact = depths("esdirk-4", 1e-5, false);
  for (const char* integrator : {"sdirk-4", "esdirk-2", "esdirk-3", "esdirk-4"})
    for (const double tolerance : {1e-1, 1e-2, 1e-3})
      EXPECT_LT((depths(integrator, tolerance, true) - exact).norm(), 0.02 * exact.norm())
          << integrator << " " << tolerance;
}

}  // namespace
}  // namespace gnomon::events_test
