// Boundary that joins the contact in a later epoch, against the same boundary from the start.
#include <gtest/gtest.h>

#include <gnomon/model/wear_model.hpp>

#include "part/stepped_part.hpp"
#include "support/cut_run.hpp"

namespace gnomon {
namespace {

using namespace testing;

struct Case {
  const char* integrator;
  double step;  // 0: error control
  bool locate;
  double tolerance;  // of the comparison
};

class JoiningBoundary : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
  std::shared_ptr<const WearModel<2>> whole(const std::string& motion = steady) const {
    return std::dynamic_pointer_cast<const WearModel<2>>(
        std::shared_ptr<const Model>(stepped_part(folder_, motion)));
  }
  /// Without the shelf, which is 0.1 mm away, until the plane comes near to it.
  static std::shared_ptr<const Model> later(const WearModel<2>& model, double reach = 0.12) {
    AssemblyParts<2> parts = model.assembly();
    parts.interface.surfaces.pop_back();
    parts.interface.reach = reach;
    return std::make_shared<const WearModel<2>>(std::move(parts));
  }
  static std::shared_ptr<const Model> alone(const WearModel<2>& model) {
    AssemblyParts<2> parts = model.assembly();
    parts.interface.surfaces.pop_back();
    parts.interface.reach = 0;
    return std::make_shared<const WearModel<2>>(std::move(parts));
  }
  static RunOutcome outcome_of(const Model& model, const Case& c) {
    IntegratorSettings settings = controlled_settings(model, 1e-3, 40000);
    settings.step = c.step;
    settings.locate_events = c.locate;
    settings.nonlinear_fraction = to_rounding;
    return run(model, Integrators::find(c.integrator, "integrator"), settings, {}, nullptr, {});
  }

  SceneFolder folder_;
};

double value(const Model& model, const RunOutcome& outcome, const char* name) {
  return observed(outcome.successor ? *outcome.successor : model, *outcome.state, name);
}

class JoiningBoundaryBy : public JoiningBoundary, public ::testing::WithParamInterface<Case> {};

TEST_P(JoiningBoundaryBy, EndsAsIfItHadBeenInContactFromTheStart) {
  const Case& c = GetParam();
  const auto model = whole();
  const auto joins = later(*model);
  const RunOutcome expected = outcome_of(*model, c), outcome = outcome_of(*joins, c);
  ASSERT_EQ(expected.text(), "finished");
  ASSERT_EQ(outcome.text(), "finished");
  EXPECT_EQ(expected.epochs, 1);
  EXPECT_GE(outcome.epochs, 2);
  const auto sole = value(*joins, outcome_of(*alone(*model), c), "wear_depth");
  EXPECT_LT(value(*joins, outcome, "wear_depth"), 0.98 * sole);  // the shelf carries
  for (const char* name : {"worn_volume", "approach", "contact_force", "wear_depth"})
    EXPECT_NEAR(value(*joins, outcome, name) / value(*model, expected, name), 1, c.tolerance)
        << name;
}

INSTANTIATE_TEST_SUITE_P(Methods, JoiningBoundaryBy,
                         ::testing::Values(Case{"backward-euler", 2000, false, 1e-8},
                                           Case{"esdirk-3", 0, false, 1e-8},
                                           Case{"esdirk-3", 0, true, 1e-8},
                                           Case{"bdf", 0, false, 2e-3}));  // it restarts

TEST_F(JoiningBoundary, AStepBeyondItIsRepeatedInShorterOnes) {
  const auto model = whole();
  const auto joins = later(*model, 1e-3);  // steps go on by ten times as much
  const Case c{"backward-euler", 2000, false, 0};
  const RunOutcome expected = outcome_of(*model, c), outcome = outcome_of(*joins, c);
  EXPECT_EQ(outcome.text(), "finished");
  EXPECT_GE(outcome.epochs, 2);
  EXPECT_GT(outcome.counters.rejected_steps, 0);
  EXPECT_FALSE(outcome.examination.intrusion);
  for (const char* name : {"worn_volume", "approach", "max_pressure"})
    EXPECT_NEAR(value(*joins, outcome, name) / value(*model, expected, name), 1, 1e-2) << name;
}

TEST_F(JoiningBoundary, ACutRunGoesOn) {
  CutRun(*later(*whole()), 40000).expect_to_go_on();
}

TEST_F(JoiningBoundary, CyclesGoOnAcrossIt) {
  const auto model = whole("[cycle]\nperiod = 1.0\nphases = 4\nx = \"25*sin(2*pi*tau)\"\n");
  const auto joins = later(*model);
  const Case c{"esdirk-3", 0, false, 1e-8};
  const RunOutcome expected = outcome_of(*model, c), outcome = outcome_of(*joins, c);
  EXPECT_GE(outcome.epochs, 2);
  EXPECT_NEAR(value(*joins, outcome, "worn_volume") / value(*model, expected, "worn_volume"), 1,
              1e-8);
}

// Its outside, which nothing holds, comes first on the way of a shaft from afar.
TEST_F(JoiningBoundary, ABushOnSpringsIsMetFromInside) {
  const auto bush = make_model(
      load_scene(shipped("bore.toml"), {"support.1.stiffness=1e4", "mesh.factor=2"}, key_table));
  Counters unused;
  const State start = bush->start(unused);
  EXPECT_GT(observed(*bush, start, "wear_flux"), 0);
  EXPECT_LT(std::abs(observed(*bush, start, "approach")), 1);
}

}  // namespace
}  // namespace gnomon
