// Located events where they come thick and in near-symmetric pairs.

#include "ball/coarse.hpp"

namespace gnomon {
namespace {

using namespace testing;

// A step that ends on an event starts the next one with a function that is zero up to rounding;
// that must not end location. Every change of the set is reported by the step that switched the
// nodes.
TEST(Ball, EveryChangeOfTheActiveSetIsLocated) {
  const auto model = model_of(ball_small, ball_mesh(5, 2, 2));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-2, 300, true);
  ASSERT_GT(run.counters.events, 5);
  ActiveSet before = run.states.front().piece;
  if (before.empty()) before = active_set(model->system(), run.states.front().y);
  for (std::size_t k = 0; k < run.reports.size(); ++k) {
    const ActiveSet& piece = run.states[k + 1].piece;
    ASSERT_FALSE(piece.empty()) << "a step over a kink, to t = " << run.states[k + 1].t;
    // The state is of the piece that the step was taken on: its start's, or, where nodes switched,
    // the next.
    if (run.reports[k].switched == 0 && k > 0 && run.reports[k - 1].switched == 0) {
      EXPECT_EQ(piece, before) << run.states[k + 1].t;
    }
    before = piece;
  }
}

}  // namespace
}  // namespace gnomon
