// What a run is made for, by closed forms and definitions.
#include <algorithm>
#include <gnomon/budget/budget.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/run/setup.hpp>

#include "budget/extrapolation.hpp"
#include "support/problem_run.hpp"

namespace gnomon::goals_test {
namespace {

using namespace testing;

/// In a bore: the force of each node, whatever way it points, over the length that carries it.
TEST(Goals, OfABoreHaveTheMeanPressureAlongIt) {
  const auto model =
      make_model(checked_scene(GNOMON_SOURCE_DIR "/problems/worn_body/bore.toml", {}));
  Counters counters;
  const State start = model->start(counters);
  const Observation observed = model->observe(start);
  const auto of = [&](const Observation& values, const char* name) {
    return std::ranges::find(values, name, &Scalar::name)->value;
  };
  const double mean = of(goals_of(*model, start, observed)->values, "mean_pressure");
  EXPECT_NEAR(mean, of(observed, "contact_force") / of(observed, "contact_area"), 1e-12 * mean);
  EXPECT_LT(mean, 0.9 * of(observed, "max_pressure"));
}

/// A round pin that has worn flat: the distance of the ends, which lie between nodes.
TEST(Goals, OfASurfaceThatHasWornFlatHaveTheMeanOverItsEnds) {
  const auto model = model_of("pin_on_flat/small_deformation.toml", {"mesh.elements=[16,8]"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-2, 1000);
  const Observation observed = model->observe(run.last());
  const auto goals = goals_of(*model, run.last(), observed);
  EXPECT_TRUE(goals->by_ends);
  EXPECT_EQ(goals->area, 0);
  EXPECT_NEAR(
      *value_of(goals->values, "mean_pressure"),
      *value_of(observed, "contact_force") / (2 * *value_of(observed, "contact_half_width")),
      1e-12);
}

/// In a cycle nodes that close later than others in a phase make the ends those of nodes.
TEST(Goals, OfACycleHaveTheAreaThatTheLastNodesLeaveOpen) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const auto model =
      make_model(checked_scene(GNOMON_SOURCE_DIR "/problems/worn_body/cylinder_worn.toml", {}));
  Counters counters;
  const State start = model->start(counters);
  const Observation observed = model->observe(start);
  const auto goals = goals_of(*model, start, observed);
  EXPECT_NEAR(
      goals->area,
      *value_of(observed, "contact_area_error") / (4 * *value_of(observed, "contact_half_width")),
      1e-3 * goals->area);
  EXPECT_GT(goals->area, 0.01);
  std::vector<double> errors(goals->values.size());
  budget::respect_area(*goals, errors);
  const auto width = std::ranges::find(goals->values, "contact_half_width", &Scalar::name);
  EXPECT_EQ(errors[static_cast<std::size_t>(width - goals->values.begin())], goals->area);
}

/// A mean over the ends and one over the area are not compared.
TEST(Goals, OfUnlikeMeansHaveNoDifference) {
  Goals one{.values = {{"mean_pressure", "MPa", 1}}, .surface = {}}, other = one;
  EXPECT_EQ(differences(one, other)[0], 0);
  other.by_ends = true;
  EXPECT_TRUE(std::isnan(differences(one, other)[0]));
}

}  // namespace
}  // namespace gnomon::goals_test
