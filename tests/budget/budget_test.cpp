// The error budget: what it estimates against what is known in closed form or from a finer run, and
// that it says what it does not know.

#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/budget.hpp>
#include <gnomon/run/setup.hpp>

#include "budget/trial.hpp"
#include "support/problem_run.hpp"

namespace gnomon::budget_test {
namespace {

using namespace testing;

std::string shipped(const std::string& scene) {
  return std::string(GNOMON_SOURCE_DIR "/problems/") + scene;
}

Budget budget_of(const std::string& scene, const Overrides& overrides = {}) {
  return find_budget(checked_scene(shipped(scene), overrides), {});
}

std::size_t index_of(const Budget& budget, const std::string& name) {
  const auto found = std::ranges::find(budget.values, name, &Scalar::name);
  EXPECT_NE(found, budget.values.end()) << name;
  return static_cast<std::size_t>(found - budget.values.begin());
}

double value(const Budget& budget, const std::string& name) {
  return budget.values[index_of(budget, name)].value;
}

double total(const Budget& budget, const std::string& name) {
  return budget.total(index_of(budget, name));
}

const BudgetPart& part(const Budget& budget, ErrorSource source) {
  const auto found = std::ranges::find(budget.parts, source, &BudgetPart::source);
  EXPECT_NE(found, budget.parts.end()) << name_of(source);
  return *found;
}

void expect_effectivity(double estimate, double error) {
  EXPECT_GT(error, 1e-4);  // else this test shows nothing
  EXPECT_GT(estimate, 0.3 * error);
  EXPECT_LT(estimate, 3 * error);
}

// Hertz: half width 0.25 mm, largest pressure 288.4 MPa.
const double E = 210e3 / (1 - 0.09), F = 113.26, R = 100;
const double half_width = std::sqrt(4 * F * R / (M_PI * E)), largest = 2 * F / (M_PI * half_width);

TEST(Budget, OfALineContactIsTheErrorAgainstHertz) {
  const Budget budget = budget_of("worn_body/hertz_cylinder.toml", {"mesh.factor=2"});
  expect_effectivity(total(budget, "contact_half_width"),
                     std::abs(value(budget, "contact_half_width") / half_width - 1));
  expect_effectivity(total(budget, "max_pressure"),
                     std::abs(value(budget, "max_pressure") / largest - 1));
  EXPECT_TRUE(std::isnan(total(budget, "worn_volume")));  // it is zero, and has no relative error
}

// On the mesh of the run: on the coarser one widths would differ by which nodes close.
TEST(Budget, OfTheMeanOverPhasesIsTheErrorAgainstMany) {
  const Overrides few = {"mesh.factor=4", "integrator.rtol=1e-2", "cycle.phases=16"};
  const Budget budget = budget_of("worn_body/cylinder_on_flat.toml", few);
  const BudgetPart& phases = part(budget, ErrorSource::phases);
  EXPECT_EQ(phases.how, "cycle.phases = 8");
  Overrides many = few;
  many.back() = "cycle.phases=64";
  const auto reference =
      budget::try_scene(checked_scene(shipped("worn_body/cylinder_on_flat.toml"), many),
                        [](double) { return false; });
  for (const char* name : {"wear_depth", "contact_half_width"})
    expect_effectivity(phases.errors[index_of(budget, name)],
                       std::abs(value(budget, name) / *value_of(reference.goals.values, name) - 1));
}

// Of twelve phases on a cam whose elements are shorter than its way from one to the next: on
// elements of twice the size the depth changes by 0.2 % only.
TEST(Budget, OfFewPhasesIsFoundOnTheMeshOfTheRun) {
  const Budget budget = budget_of("worn_body/cam_and_follower.toml", {"time.cycles=1e4"});
  const BudgetPart& phases = part(budget, ErrorSource::phases);
  EXPECT_EQ(phases.how, "cycle.phases = 24");
  const auto reference = budget::try_scene(checked_scene(shipped("worn_body/cam_and_follower.toml"),
                                                         {"time.cycles=1e4", "cycle.phases=48"}),
                                           [](double) { return false; });
  expect_effectivity(
      phases.errors[index_of(budget, "wear_depth")],
      std::abs(value(budget, "wear_depth") / *value_of(reference.goals.values, "wear_depth") - 1));
}

// Backward Euler in few steps: the error is that of time, and falls with the step.
TEST(Budget, OfLargeStepsIsTheErrorAgainstSmallOnes) {
  const Overrides coarse = {"mesh.elements=[16,8]", "integrator.name=backward-euler",
                            "integrator.step=50"};
  const Budget budget = budget_of("pin_on_flat/small_deformation.toml", coarse);
  Overrides fine = coarse;
  fine.back() = "integrator.step=1";
  const Budget reference = budget_of("pin_on_flat/small_deformation.toml", fine);
  const BudgetPart& time = part(budget, ErrorSource::time);
  for (const char* name : {"wear_depth", "max_pressure"})
    expect_effectivity(time.errors[index_of(budget, name)],
                       std::abs(value(budget, name) / value(reference, name) - 1));
  // The paper's rule of normals loses volume: k F v t is 2.
  const double lost = std::abs(2 / value(budget, "worn_volume") - 1);
  EXPECT_GT(lost, 1e-3);
  EXPECT_GT(total(budget, "worn_volume"), 0.99 * lost);
}

TEST(Budget, OfWearAsAGapIsTheDifferenceToTheMovingMesh) {
  const Overrides coarse = {"mesh.elements=[16,8]", "integrator.rtol=1e-5", "body.material=linear",
                            "wear.normal=conservative"};
  Overrides gap = coarse;
  gap.insert(gap.end(), {"shape.motion=gap", "solver.reduce=true"});
  const Budget budget = budget_of("pin_on_flat/small_deformation.toml", gap);
  const Budget reference = budget_of("pin_on_flat/small_deformation.toml", coarse);
  const auto model = std::ranges::find(budget.parts, "shape.motion", &BudgetPart::key);
  ASSERT_NE(model, budget.parts.end());
  expect_effectivity(
      model->errors[index_of(budget, "max_pressure")],
      std::abs(value(budget, "max_pressure") / value(reference, "max_pressure") - 1));
}

TEST(Budget, OfSpringsIsTheErrorAgainstMoreOfThem) {
  const Budget budget = budget_of("winkler/pin.toml", {"foundation.points=41"}),
               reference = budget_of("winkler/pin.toml", {"foundation.points=801"});
  expect_effectivity(
      total(budget, "max_pressure"),
      std::abs(value(budget, "max_pressure") / value(reference, "max_pressure") - 1));
}

// A quarter of a disc whose radius shrinks from 2 mm to its half.
TEST(Budget, OfAStressedSurfaceIsTheErrorOfItsPolygon) {
  const Budget budget = budget_of("stressed_surface/circle.toml");
  expect_effectivity(total(budget, "worn_volume"),
                     std::abs(value(budget, "worn_volume") / (M_PI / 4 * 0.75) - 1));
  EXPECT_EQ(std::ranges::find(budget.values, "inner_pressure", &Scalar::name), budget.values.end());
}

// Hertz: as above, on a mesh that is given, whose cells are split.
TEST(Budget, OfAMeshThatIsGivenIsTheErrorAgainstHertz) {
  const std::filesystem::path mesh = std::filesystem::path(::testing::TempDir()) / "given.msh";
  std::filesystem::remove(mesh);
  const std::string command = std::string(GNOMON_PROGRAM) + " mesh " +
                              shipped("worn_body/hertz_cylinder.geo") + " -o " + mesh.string() +
                              " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const Overrides given = {"mesh.file=\"" + mesh.string() + "\""};
  const Budget budget = budget_of("worn_body/hertz_cylinder.toml", given);
  EXPECT_EQ(part(budget, ErrorSource::mesh).key, "mesh.split");
  expect_effectivity(total(budget, "contact_half_width"),
                     std::abs(value(budget, "contact_half_width") / half_width - 1));
  expect_effectivity(total(budget, "max_pressure"),
                     std::abs(value(budget, "max_pressure") / largest - 1));
}

// Its script gives the number of elements on the sole: other sizes refine what does not touch.
TEST(Budget, SplitsCellsWhereAGeometryFixesThoseOfTheContact) {
  const std::filesystem::path geometry = std::filesystem::path(::testing::TempDir()) / "pad.geo";
  std::ofstream(geometry) << R"(
Point(1) = {-5, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {5, 4, 0}; Point(4) = {-5, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Transfinite Curve {1, 3} = 21; Transfinite Curve {2, 4} = 8 / Mesh.MeshSizeFactor + 1;
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("sole") = {1}; Physical Curve("top") = {3}; Physical Surface("pad") = {1};
)";
  const Scene scene = checked_scene_of_text(R"(problem = "worn_body"
mesh.file = ")" + geometry.string() + R"("
body = { young_modulus = 600, poisson_ratio = 0.4, material = "linear" }
wear = { on = ["sole"], coefficient = 1e-8, rate = "k * p * v" }
time.end = 2000
[[support]]
on = "top"
directions = ["x", "y"]
[counter_body]
shape = "cylinder"
center = [0, -100]
radius = 100
motion = { velocity = [500, 0] }
press = { direction = [0, 1], force = 100 }
)",
                                            "pad.toml", {});
  EXPECT_EQ(part(find_budget(scene, {}), ErrorSource::mesh).key, "mesh.split");
}

TEST(Budget, RefusesWhatHasNoWornSurface) {
  EXPECT_THROW(budget_of("dahlquist/decay.toml"), InputError);
}

TEST(Budget, IsTheSameFromItsJson) {
  Budget budget{.values = {{"wear_depth", "mm", 0.25}, {"approach", "mm", 0}},
                .parts = {{.source = ErrorSource::phases,
                           .key = "cycle.phases",
                           .how = "cycle.phases = 32",
                           .errors = {0.125, not_known},
                           .unknown = ""}},
                .run_seconds = 0,
                .companion_seconds = 0};
  const Budget again = budget_of_json(budget_json(budget));
  EXPECT_EQ(budget_text(again), budget_text(budget));
  EXPECT_EQ(again.parts[0].errors[0], 0.125);
  EXPECT_TRUE(std::isnan(again.total(1)));
  EXPECT_THROW(budget_of_json("{}"), InputError);
}

TEST(Budget, SaysThatASumLacksAPart) {
  const Budget budget{.values = {{"wear_depth", "mm", 0.25}},
                      .parts = {{ErrorSource::time, "integrator.rtol", "", {0.01}},
                                {ErrorSource::mesh, "mesh.factor", "", {not_known}, "no time"}}};
  EXPECT_THAT(budget_table(budget), ::testing::AllOf(::testing::HasSubstr("> 1 %"),
                                                     ::testing::HasSubstr("mesh is not known")));
}

// The fields of another mesh are interpolated; what is linear along the surface exactly.
TEST(Budget, ComparesProfilesOfDifferentMeshes) {
  const auto line = [](int elements, double slope) {
    Goals goals{.values = {{"profile", "mm", 1}}, .surface = {}};
    for (int i = 0; i <= elements; ++i) {
      const double x = double(i) / elements;
      goals.surface.initial.push_back({x, 0, 0});
      goals.surface.worn.push_back({x, -slope * x, 0});
      goals.surface.pressure.push_back(1);
    }
    return goals;
  };
  EXPECT_NEAR(differences(line(10, 1), line(7, 1))[0], 0, 1e-9);
  // Nodes at 0, 0.1, ... 1: the sum of x^2 is 3.85.
  EXPECT_NEAR(differences(line(10, 1.01), line(7, 1))[0], 0.01 * std::sqrt(3.85), 1e-9);
}

TEST(QuickBudget, EndsWhereTheUserOrTheLimitDoes) {
  const Scene scene = checked_scene(shipped("pin_on_flat/small_deformation.toml"),
                                    {"mesh.elements=[8,8]", "integrator.rtol=1e-2"});
  const gnomon::Setup setup = set_up(scene);
  Counters counters;
  const State start = setup.model->start(counters);
  const auto goals = goals_of(*setup.model, start, setup.model->observe(start));
  ASSERT_TRUE(goals);
  const Budget none = quick_budget(setup.scene, *goals, 0, {.interrupted = [] { return true; }});
  EXPECT_TRUE(none.parts.empty());
  for (const BudgetHooks& hooks : {BudgetHooks{.limit = 0}, BudgetHooks{.seconds = 0}}) {
    const Budget limited = quick_budget(setup.scene, *goals, 0, hooks);
    ASSERT_FALSE(limited.parts.empty());
    for (const BudgetPart& part : limited.parts) EXPECT_FALSE(part.unknown.empty());
  }
}

// One more solve than the first is refused: it is that of the start which asks before it fails.
TEST(Trial, AsksWithinItsStart) {
  const Scene scene = checked_scene(shipped("pin_on_flat/small_deformation.toml"),
                                    {"mesh.elements=[8,8]", "integrator.rtol=1e-2"});
  int asked = 0;
  const auto count = [&](double) { return ++asked < 0; };
  EXPECT_THROW(budget::try_scene(scene, count, nullptr, 0), SolutionError);
  EXPECT_GT(asked, 4);
}

/// Nodes that come into contact make the largest part of it, which depends on the mesh.
TEST(QuickBudget, OfASmallRunHasItsTimeErrorOnItsOwnMesh) {
  const auto goals_at = [](const std::string& rtol) {
    const Scene scene =
        checked_scene(shipped("pin_on_flat/small_deformation.toml"),
                      {"mesh.elements=[24,8]", "integrator.name=esdirk-3", "time.end=400",
                       "wear.rate=\"k*p*v*sqrt(p/2)\"", "integrator.rtol=" + rtol});
    const gnomon::Setup setup = set_up(scene);
    const ModelRun run = run_model(*setup.model, "esdirk-3", 0, scene.real("integrator.rtol"), 400);
    return std::pair(setup.scene,
                     goals_of(*setup.model, run.last(), setup.model->observe(run.last())).value());
  };
  const auto [scene, goals] = goals_at("1e-3");
  const Goals fine = goals_at("1e-7").second;
  const Budget budget = quick_budget(scene, goals, 1e6, {});
  const BudgetPart& time = part(budget, ErrorSource::time);
  for (const char* name : {"worn_volume", "wear_depth"}) {
    const std::size_t i = index_of(budget, name);
    expect_effectivity(time.errors[i], std::abs(goals.values[i].value / fine.values[i].value - 1));
  }
}

// What rolling is computed for; a creepage of zero has no relative error.
TEST(Budget, TellsOfCreepageAndPower) {
  const auto run = budget::try_scene(checked_scene(shipped("worn_body/rolling.toml"), {}),
                                     [](double) { return false; });
  EXPECT_GT(value_of(run.goals.values, "creepage_x").value_or(0), 1e-3);
  EXPECT_GT(value_of(run.goals.values, "friction_power").value_or(0), 100);
  EXPECT_EQ(value_of(run.goals.values, "creepage_y"), 0);
}

}  // namespace
}  // namespace gnomon::budget_test
