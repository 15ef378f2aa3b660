// What holds for every shipped scene.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/system/system.hpp>
#include <iterator>

#include "support/problem_run.hpp"

namespace gnomon::scenes_test {
namespace {

using namespace testing;

bool is_study(const std::filesystem::path& file) {
  const std::string folder = file.parent_path().filename();
  return folder == "studies" || folder == "extremes";
}

std::vector<std::string> scenes() {
  const std::filesystem::path root = GNOMON_SOURCE_DIR "/problems";
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.path().extension() == ".toml" && !is_study(entry.path()) &&
        (reads_mesh_files() || entry.path().parent_path().filename() != "worn_body"))
      result.push_back(std::filesystem::relative(entry.path(), root).string());
  return result;
}

/// Meshes for fast runs.
Overrides coarse(const std::string& scene) {
  if (scene.starts_with("pin_on_flat/")) return {"mesh.elements=[8, 8]"};
  if (scene == "flat_punch/half_plane.toml") return {"mesh.punch_elements=4"};
  if (scene.starts_with("ball_on_flat/")) return {"mesh.elements=[3, 1, 1]"};
  if (scene.starts_with("ball_on_half_space/"))
    return {"mesh.elements=[4, 8, 3]", "mesh.size=[0.2, 0.1, 0.1]", "mesh.fine=[0.0, 0.0, 0.0]"};
  if (scene == "worn_body/block_on_ring.toml")
    return {"mesh.factor=2.5", "time.end=720", "output.times=[]"};
  if (scene == "worn_body/pin_on_disc_axisymmetric.toml")
    return {"mesh.factor=2", "time.end=40", "output.times=[]"};
  if (scene == "worn_body/cylinder_on_flat.toml")
    return {"mesh.factor=3", "cycle.phases=4", "time.end=400", "output.times=[]"};
  if (scene == "worn_body/fretting.toml")
    return {"cycle.phases=4", "time.end=400", "output.times=[]"};
  if (scene == "worn_body/cam.toml")
    return {"mesh.factor=3", "cycle.phases=6", "time.end=1000", "output.times=[]"};
  if (scene == "worn_body/ball_joint.toml")  // a single layer of elements
    return {"mesh.factor=4", "cycle.phases=4", "time.end=3e5", "output.times=[]"};
  if (scene == "worn_body/block_on_elastic_ring.toml")
    return {"mesh.factor=2.5", "time.end=720", "output.times=[]"};
  if (scene == "worn_body/cylinder_and_flat.toml")
    return {"mesh.factor=3", "cycle.phases=2", "time.end=400", "output.times=[]"};
  if (scene == "worn_body/fretting_pair.toml")
    return {"mesh.factor=3", "cycle.phases=4", "time.end=400", "output.times=[]"};
  if (scene == "worn_body/dovetail.toml")
    return {"mesh.factor=2", "cycle.phases=4", "time.end=100"};
  if (scene == "worn_body/press_fit.toml") return {"mesh.factor=2", "cycle.phases=4", "time.end=2"};
  if (scene == "worn_body/press_fit_bending.toml") return {"mesh.factor=2", "time.end=0.1"};
  if (scene == "worn_body/half_round_ring_on_steel.toml")
    return {"mesh.factor=2", "time.end=0.3", "output.times=[]"};
  if (scene == "worn_body/sphere_on_disc.toml")
    return {"mesh.factor=2", "time.end=64", "output.times=[]"};
  if (scene == "worn_body/ball_on_block.toml") return {"mesh.factor=3.5", "time.end=20"};
  if (scene == "worn_body/cam_and_rocker.toml") return {"mesh.factor=2", "time.cycles=100"};
  if (scene == "worn_body/pin_on_track.toml") return {"mesh.factor=2", "time.end=200"};
  if (scene == "worn_body/gear_teeth.toml")
    return {"mesh.factor=2", "cycle.phases=4", "time.end=100"};
  if (scene == "worn_body/wheel_on_rail.toml") return {"mesh.factor=2.5", "time.end=5e4"};
  if (scene == "worn_body/hip.toml") return {"mesh.factor=1.5", "cycle.phases=1", "time.end=1e5"};
  if (scene == "worn_body/cylinder_worn.toml")
    return {"mesh.factor=3", "time.end=400", "output.times=[]"};
  if (scene == "worn_body/held_cylinder.toml")
    return {"mesh.factor=3", "cycle.phases=4", "time.end=400"};
  if (scene == "worn_body/half_round_ring.toml")
    return {"mesh.factor=2", "time.end=0.3", "output.times=[]"};
  if (scene.find("axisymmetric") != std::string::npos || scene == "worn_body/hertz_cylinder.toml")
    return {"mesh.factor=2"};
  if (scene == "worn_body/pin.toml") return {"time.end=100", "output.times=[]"};
  if (scene == "worn_body/pin_on_disc.toml")
    return {"mesh.factor=3", "time.end=20", "output.times=[]"};
  if (scene.starts_with("worn_body/ball_in_")) return {"mesh.factor=3"};
  if (scene == "worn_body/ball.toml") return {"mesh.factor=3", "time.end=100", "output.times=[]"};
  if (scene == "worn_body/bushing.toml") return {"mesh.factor=2", "time.end=1", "output.times=[]"};
  return {};
}

TEST(Scenes, EveryProblemHasOne) {
  if (!reads_mesh_files()) GTEST_SKIP() << "without Gmsh there is no worn_body";
  const std::vector<std::string> all = scenes();
  for (const std::string& problem : Problems::names())
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const std::string& scene) {
      return scene.starts_with(problem + "/");
    })) << problem;
}

TEST(Scenes, BlocksAddUpAndTheExactSolutionIsOfTheDifferentialComponents) {
  for (const std::string& scene : scenes()) {
    SCOPED_TRACE(scene);
    const auto model = model_of(scene, coarse(scene));
    const Structure& structure = model->system().structure();
    long size = 0;
    for (const BlockSize& block : model->blocks) size += block.size;
    EXPECT_EQ(size, structure.size);
    const std::optional<State> exact = model->exact ? model->exact(1) : std::nullopt;
    if (!exact) continue;
    EXPECT_EQ(exact->t, 1);
    ASSERT_EQ(exact->y.size(), std::size_t(structure.size));
    ASSERT_EQ(exact->ydot.size(), std::size_t(structure.size));
    for (long i = 0; i < structure.size; ++i)
      EXPECT_TRUE(structure.differential[i] || exact->y[i] == 0) << i;
  }
}

class EveryScene : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryScene, StartsConsistently) {
  const auto model = model_of(GetParam(), coarse(GetParam()));
  Counters counters;
  const State start = model->start(counters);
  const Structure& structure = model->system().structure();
  std::vector<double> F(start.y.size());
  model->system().residual({0, start.y, start.ydot}, F);
  for (std::size_t i = 0; i < F.size(); ++i)
    ASSERT_LE(std::abs(F[i]), 1e-8 * structure.row_scale[i]) << "row " << i;
}

/// As `resume` reads it: every key that has a value is given.
TEST_P(EveryScene, IsReadAgainFromItsResult) {
  const std::filesystem::path file = GNOMON_SOURCE_DIR "/problems/" + GetParam();
  const gnomon::Setup setup = set_up(checked_scene(file, coarse(GetParam())));
  const gnomon::Setup again = set_up(checked_scene_of_text(setup.scene.resolved(), file, {}));
  EXPECT_EQ(again.scene.resolved(), setup.scene.resolved());
  EXPECT_EQ(again.model->system().structure().size, setup.model->system().structure().size);
}

TEST_P(EveryScene, ItsSurfaceIsWholeAndThePressureTheMeanOfThePhases) {
  const auto model = model_of(GetParam(), coarse(GetParam()));
  Counters counters;
  const std::optional<ContactSurface> surface = model->contact(model->start(counters));
  if (!surface) return;
  const std::size_t nodes = surface->node.size(), phases = surface->phase_position.size();
  for (const std::size_t size :
       {surface->initial.size(), surface->worn.size(), surface->current.size(),
        surface->pressure.size(), surface->wear_depth.size(), surface->active.size()})
    EXPECT_EQ(size, nodes);
  ASSERT_EQ(surface->phase_weight.size(), phases);
  ASSERT_EQ(surface->phase_pressure.size(), phases * nodes);
  double sum = 0, largest = 0;
  for (double weight : surface->phase_weight) sum += weight;
  EXPECT_NEAR(sum, phases > 0 ? 1 : 0, 1e-12);
  for (double p : surface->phase_pressure) largest = std::max(largest, p);
  for (std::size_t i = 0; phases > 0 && i < nodes; ++i) {
    double mean = 0;
    for (std::size_t q = 0; q < phases; ++q)
      mean += surface->phase_weight[q] * surface->phase_pressure[q * nodes + i];
    EXPECT_NEAR(surface->pressure[i], mean, 1e-9 * largest) << "node " << i;
  }
}

/// Explicit methods would need tens of thousands of steps.
bool is_stiff(const std::string& scene) {
  return scene == "dahlquist/stiff.toml" || scene.starts_with("ball_on") ||
         (scene.starts_with("worn_body/") && scene != "worn_body/pin.toml");
}

/// Whether friction may stick.
bool sticks(const std::string& scene) {
  std::ifstream file(GNOMON_SOURCE_DIR "/problems/" + scene);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  return text.find("stick = true") != std::string::npos;
}

// With the tolerance of the scene: no method with an error estimate needs help.
TEST_P(EveryScene, RunsToItsEndWithEveryErrorControl) {
  for (const Integrator& integrator : Integrators::all()) {
    if (integrator.error_estimate.empty() ||
        (is_stiff(GetParam()) && integrator.family.starts_with("explicit")))
      continue;
    SCOPED_TRACE(integrator.name);
    Overrides overrides = coarse(GetParam());
    overrides.push_back("integrator.name=\"" + integrator.name + "\"");
    if (sticks(GetParam()) && integrator.name == "theta")  // the trapezoidal rule is refused
      overrides.emplace_back("integrator.alpha=0.75");
    const Scene scene =
        load_scene(GNOMON_SOURCE_DIR "/problems/" + GetParam(), overrides, key_table);
    const auto model = Problems::find(scene.text("problem"), "problem").make(scene);
    const RunOutcome outcome =
        run(*model, chosen_integrator(scene), integrator_settings(scene, *model), {}, nullptr, {});
    EXPECT_EQ(outcome.text(), "finished");
    EXPECT_EQ(outcome.last->t, scene.real("time.end"));
    if (integrator.family.starts_with("explicit")) {
      EXPECT_EQ(outcome.chattering_nodes, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryScene, ::testing::ValuesIn(scenes()), [](const auto& info) {
  std::string name = info.param.substr(0, info.param.rfind('.'));
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
});

}  // namespace
}  // namespace gnomon::scenes_test
