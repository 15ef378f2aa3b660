// Accuracy as one number: the cheapest settings within it, what is given stays, and the runs that
// follow keep it.

#include <gnomon/base/error.hpp>
#include <gnomon/budget/plan.hpp>
#include <gnomon/run/setup.hpp>

#include "budget/choices.hpp"
#include "budget/trade.hpp"
#include "budget/trial.hpp"
#include "part/part_scene.hpp"
#include "support/pin_text.hpp"
#include "support/problem_run.hpp"

namespace gnomon::plan_test {
namespace {

using namespace testing;
using budget::Choices;
using budget::Trade;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Trade trade{.mesh = 0.01,
                      .time = 0.001,
                      .rest = 0,
                      .seconds = 1,
                      .coarsest = 16,
                      .free_mesh = true,
                      .free_time = true};

TEST(Trade, IsCheapestWhereMeshAndTimeHaveTheirShare) {
  double before = 0;
  for (const double within : {0.3, 0.1, 0.03, 0.01, 0.003}) {
    const budget::Factors best = budget::cheapest(trade, within);
    const PlanLine line = budget::predicted(trade, best);
    EXPECT_LE(line.error(), within);
    EXPECT_GT(line.error(), within / 20);  // it pays for no more than that
    EXPECT_GT(line.cpu_seconds, before);
    before = line.cpu_seconds;
    // One of the two larger alone would be too much, or cost no less.
    for (const budget::Factors other : {budget::Factors{best.mesh * std::sqrt(2.0), best.time},
                                        budget::Factors{best.mesh, best.time * std::sqrt(10.0)}})
      if (other.time < 400 && other.mesh <= trade.coarsest) {
        EXPECT_GT(budget::predicted(trade, other).error(), within / 2);
      }
  }
}

TEST(Trade, LeavesWhatIsGiven) {
  Trade given = trade;
  given.coarsest = 2;
  EXPECT_EQ(budget::cheapest(given, 0.5).mesh, 2);  // no coarser than what carries contact
  given.free_mesh = false;
  EXPECT_EQ(budget::cheapest(given, 1e-4).mesh, 1);
  EXPECT_LT(budget::cheapest(given, 1e-4).time, 1);  // not without end, for the mesh spoils it
  EXPECT_GT(budget::cheapest(given, 1e-4).time, 1e-3);
}

// An error of the user's settings as large as what is asked for, or nearly, calls for no mesh
// without bounds; and who asks for less pays no less.
TEST(Trade, PaysNoExtremesForWhatCannotBeChanged) {
  Trade given = trade;
  given.rest = 0.008;
  const auto mesh = [](double error) { return budget::cheapest(trade, error).mesh; };
  double before = 0;
  for (const double within : {0.04, 0.02, 0.01, 0.005, 0.0025}) {
    const budget::Factors best = budget::cheapest(given, within);
    EXPECT_GE(best.mesh, mesh(within / 2)) << within;
    const double cost = budget::predicted(given, best).cpu_seconds;
    EXPECT_GE(cost, before);
    before = cost;
  }
}

/// A pin of height 10 mm that wears by 0.2 mm, without mesh and tolerance.
Scene scene(const Overrides& overrides) {
  return checked_scene_of_text(test::pin_text(300), "pin.toml", overrides);
}

// The models are chosen for the error of each row, as if that were asked for.
TEST(Choices, AreThoseOfEveryAskedError) {
  Choices choices;
  const Scene own = scene({"body.material=neo-hookean"});
  for (const Key& key : own.controlling_keys())
    if (key.name == "body.material")
      choices.models.push_back(
          {.key = key, .error = 0.01, .rest = 0.02, .saved = 3, .is_taken = true});
  ASSERT_EQ(choices.models.size(), 1u);
  const budget::Choice pilots{own.with("body.material", std::string("linear")),
                              {.rest = 0.021, .seconds = 1}};
  const auto large = choices.for_error(0.05, pilots), small = choices.for_error(0.03, pilots);
  EXPECT_EQ(large.scene.text("body.material"), "linear");
  EXPECT_EQ(large.trade.rest, 0.021);
  EXPECT_EQ(small.scene.text("body.material"), "neo-hookean");
  EXPECT_NEAR(small.trade.rest, 0.001, 1e-12);
  EXPECT_EQ(small.trade.seconds, 3);
}

Plan plan(const Overrides& overrides) {
  return plan_of(scene(overrides), {});
}

TEST(Plan, LeavesWhatTheSceneGives) {
  const Plan made = plan({"accuracy.within=0.05", "mesh.elements=[40,20]", "shape.motion=mesh"});
  EXPECT_EQ(made.scene.integers("mesh.elements"), (std::vector<long>{40, 20}));
  EXPECT_EQ(made.scene.text("shape.motion"), "mesh");
  EXPECT_THAT(made.remarks, ::testing::Contains(HasSubstr("mesh.elements")));
  EXPECT_THAT(plan_text(made), HasSubstr("\n     5 %"));
}

// Against the same mesh and model in steps that hardly matter.
TEST(Plan, ChoosesATolerance) {
  const auto goes_on = [](double) { return false; };
  const Plan made = plan({"accuracy.within=0.01", "accuracy.of=[\"depth\"]", "shape.motion=mesh",
                          "body.material=linear"});
  EXPECT_GT(made.scene.real("integrator.rtol"), 1e-4);
  const auto run = budget::try_scene(made.scene, goes_on);
  const auto reference = budget::try_scene(made.scene.with("integrator.rtol", 1e-7), goes_on);
  const double depth = *value_of(reference.goals.values, "wear_depth");
  EXPECT_LT(std::abs(*value_of(run.goals.values, "wear_depth") / depth - 1), 0.01);
}

Scene shipped(const std::string& name, const Overrides& overrides) {
  return checked_scene(GNOMON_SOURCE_DIR "/problems/worn_body/" + name, overrides);
}

// On a coarse mesh 8 phases are wrong by some 5 % in pressures inside of the contact.
TEST(Plan, ChoosesPhases) {
  const auto phases = [](const char* within) {
    const Scene asked =
        shipped("cylinder_on_flat.toml",
                {std::string("accuracy.within=") + within, "accuracy.of=[\"pressure\"]",
                 "mesh.factor=4", "integrator.rtol=1e-2", "shape.motion=mesh"})
            .without("cycle.phases");
    return plan_of(asked, {}).scene.reals("cycle.phases").at(0);
  };
  const double few = phases("0.5"), many = phases("0.002");
  EXPECT_LT(few, many);
  EXPECT_GE(many, 16);
  EXPECT_LE(many, 128);
}

// The contact stays where it is on the cylinder, and the speed is the same in all phases.
TEST(Plan, TakesFewPhasesWhereMoreChangeNothing) {
  const Scene asked = shipped("cylinder_worn.toml",
                              {"accuracy.within=0.05", "mesh.factor=4", "integrator.rtol=1e-2"})
                          .without("cycle.phases");
  const Plan made = plan_of(asked, {});
  EXPECT_EQ(made.scene.reals("cycle.phases"), std::vector<double>{4});
  const auto goes_on = [](double) { return false; };
  const auto few = budget::try_scene(made.scene, goes_on),
             many = budget::try_scene(made.scene.with("cycle.phases", std::vector<double>{32}),
                                      goes_on);
  for (const double error : differences(few.goals, many.goals)) EXPECT_LT(std::abs(error), 0.005);
}

TEST(Plan, LeavesAndJudgesAMeshThatItsGeometryFixes) {
  const Plan made = plan_of(shipped("bore.toml", {"accuracy.within=0.05"}), {});
  EXPECT_EQ(made.scene.real("mesh.factor"), 1);
  EXPECT_EQ(made.scene.integer("mesh.split"), 0);
  EXPECT_THAT(made.remarks, ::testing::Contains(HasSubstr("the mesh is given, its error is")));
  const auto mesh = std::ranges::find(made.known, "mesh.split", &BudgetPart::key);
  ASSERT_NE(mesh, made.known.end());
  EXPECT_GT(made.chosen().rest, *std::ranges::max_element(mesh->errors) / 2);
}

/// The largest elements of a liner are what its circles make of them, whatever size is asked for.
TEST(Plan, RefinesAGeometryWhoseCoarsestMeshesAreTheSame) {
  const SceneFolder folder;
  folder.write("liner.geo", R"(SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 12}; Disk(2) = {0, 0, 0, 9}; Disk(3) = {0, 0, 0, 7.03};
BooleanDifference(4) = {Surface{1}; Delete;} {Surface{2};};
BooleanDifference(5) = {Surface{2}; Delete;} {Surface{3}; Delete;};
Coherence;
bore() = Curve In BoundingBox {-7.1, -7.1, -1, 7.1, 7.1, 1};
middle() = Curve In BoundingBox {-9.1, -9.1, -1, 9.1, 9.1, 1};
out() = Curve In BoundingBox {-12.1, -12.1, -1, 12.1, 12.1, 1}; out() -= middle();
Physical Curve("bore") = bore(); Physical Curve("housing") = out();
Physical Surface("shell") = {4}; Physical Surface("liner") = {5};
)");
  const Scene asked = checked_scene(folder.write("liner.toml", R"(problem = "worn_body"
mesh.file = "liner.geo"
body = [ { name = "shell", young_modulus = 210e3, poisson_ratio = 0.3 },
         { name = "liner", young_modulus = 1800.0, poisson_ratio = 0.38 } ]
support = [ { on = "housing" } ]
friction.coefficient = 0.1
wear = { on = ["bore"], coefficient = 3e-8 }
time.end = 3000.0
accuracy.within = 0.003
[counter_body]
shape = "cylinder"
center = [0.0, 0.0]
radius = 7.0
motion = { rotation = 60.0 }
press = { direction = [0.0, -1.0], force = 40.0 }
)"),
                                    {});
  const Plan made = plan_of(asked, {});
  EXPECT_THAT(made.remarks, ::testing::Not(::testing::Contains(HasSubstr("is given"))));
  EXPECT_LT(made.scene.real("mesh.factor"), 1);
  EXPECT_LT(made.chosen().error(), 0.003);
}

TEST(Plan, RefusesWhatItCannotJudge) {
  EXPECT_THAT([] { plan({}); }, ThrowsMessage<InputError>(HasSubstr("expected accuracy.within")));
  EXPECT_THAT(
      [] {
        plan({"accuracy.within=0.1", "accuracy.of=[\"colour\"]"});
      },
      ThrowsMessage<InputError>(HasSubstr("accuracy.of: expected some of \"depth\", \"volume\"")));
  EXPECT_THAT(
      [] {
        plan_of(shipped("hertz_cylinder.toml", {"accuracy.within=0.1", "accuracy.of=[\"depth\"]"}),
                {});
      },
      ThrowsMessage<InputError>(
          HasSubstr("expected values that are not zero in this scene, got depth")));
}

TEST(Plan, DoesNotPromiseWhatNoPilotTells) {
  const Scene asked = scene({"accuracy.within=0.01", "accuracy.of=[\"depth\"]"});
  const PlanLine line{.within = 0.01, .settings = "", .mesh = not_known, .time = 0.002, .rest = 0};
  const Plan made{.scene = asked, .lines = {line}, .known = {}, .remarks = {}};
  EXPECT_THAT(plan_text(made), HasSubstr("> 0.2 %         ?     0.2 %"));
  const Budget budget{
      .values = {{"wear_depth", "mm", 1}},
      .parts = {{.source = ErrorSource::mesh, .key = "mesh.file", .errors = {not_known}},
                {.source = ErrorSource::time, .key = "integrator.rtol", .errors = {0.002}}}};
  Budget unknown = budget;
  unknown.parts[0].unknown = "no other";
  EXPECT_THAT(accuracy_text(asked, unknown), HasSubstr("more than 0.2 %"));
  EXPECT_THAT(accuracy_text(asked, unknown), HasSubstr("whether this is within it is not known"));
  EXPECT_THAT(accuracy_text(asked, budget),
              AllOf(HasSubstr("not known, that of wear_depth, mostly by mesh.file"),
                    HasSubstr("whether this is within it is not known")));
}

// The plan promised more; what lowers the error is told, not the plan, which is the same again.
TEST(Plan, SaysWhatLowersAnErrorThatIsTooLarge) {
  const Scene asked =
      scene({"accuracy.within=0.01", "accuracy.of=[\"depth\"]", "mesh.elements=[40,20]"});
  const auto shown = [](double mesh, double time) {
    return Budget{.values = {{"wear_depth", "mm", 1}},
                  .parts = {{ErrorSource::mesh, "mesh.elements", "", {mesh}},
                            {ErrorSource::time, "integrator.rtol", "", {time}}}};
  };
  const Scene settings = asked.with("integrator.rtol", 1e-3);
  EXPECT_THAT(accuracy_text(asked, shown(0.03, 0.001)), EndsWith("; this is NOT within it"));
  EXPECT_EQ(finer_text(asked, settings, shown(0.03, 0.001)), "mesh.elements = [80, 40]");
  EXPECT_EQ(finer_text(asked, settings, shown(0.001, 0.03)), "integrator.rtol = 0.0001");
  EXPECT_EQ(finer_text(asked, settings, shown(0.003, 0.001)), "");
}

TEST(Plan, IsRefinedWhereItsRunShowsMore) {
  const Scene asked =
      scene({"accuracy.within=0.01", "accuracy.of=[\"depth\"]", "mesh.elements=[40,20]"});
  const Plan made{.scene = asked, .lines = {}, .known = {}, .remarks = {}};
  const auto shown = [](double mesh, double time) {
    return Budget{.values = {{"wear_depth", "mm", 1}},
                  .parts = {{ErrorSource::mesh, "mesh.elements", "", {mesh}},
                            {ErrorSource::time, "integrator.rtol", "", {time}}}};
  };
  EXPECT_FALSE(refined(made, asked, made.scene, shown(0.003, 0.005), 1));
  EXPECT_TRUE(refined(made, asked, made.scene, shown(0.004, 0.005), 1)) << "not sure";
  EXPECT_FALSE(refined(made, asked, made.scene, shown(0.004, 0.005), 2));
  EXPECT_FALSE(refined(made, asked, made.scene, shown(0.001, 0.03), 3)) << "often enough";
  const auto finer = refined(made, asked, made.scene, shown(0.001, 0.03), 1);
  ASSERT_TRUE(finer);
  EXPECT_LT(finer->real("integrator.rtol"), asked.real("integrator.rtol") / 3);
  const auto again = refined(made, asked, *finer, shown(0.001, 0.03), 2);
  ASSERT_TRUE(again);
  EXPECT_LT(again->real("integrator.rtol"), finer->real("integrator.rtol") / 3)
      << "of the last run";
  // The mesh is given.
  EXPECT_EQ(finer->integers("mesh.elements"), asked.integers("mesh.elements"));
}

// What cells that are split show is no reason for the same run once more.
TEST(Plan, IsNotRepeatedForAMeshThatStays) {
  const Scene asked =
      shipped("valve_seat.toml", {"accuracy.within=0.01", "accuracy.of=[\"depth\"]"});
  const Plan made{.scene = asked, .lines = {}, .known = {}, .remarks = {}};
  const Budget shown{.values = {{"wear_depth", "mm", 1}},
                     .parts = {{ErrorSource::mesh, "mesh.split", "", {0.05}}}};
  EXPECT_FALSE(refined(made, asked, made.scene, shown, 1));
}

TEST(Plan, IsRefinedInPhasesThatItChose) {
  const Scene asked =
      shipped("cylinder_on_flat.toml", {"accuracy.within=0.01", "accuracy.of=[\"depth\"]"})
          .without("cycle.phases");
  const Plan made{.scene = asked.with("cycle.phases", std::vector<double>{16}),
                  .lines = {},
                  .known = {},
                  .remarks = {}};
  const Budget shown{.values = {{"wear_depth", "mm", 1}},
                     .parts = {{ErrorSource::phases, "cycle.phases", "", {0.02}}}};
  const auto finer = refined(made, asked, made.scene, shown, 1);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->reals("cycle.phases"), std::vector<double>{32});
}

}  // namespace
}  // namespace gnomon::plan_test
