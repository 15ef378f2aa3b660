// A pair by an explicit method, whose runs end where nodes leave contact again and again.
#include <gnomon/run/run.hpp>

#include "part/part_scene.hpp"

namespace gnomon::explicit_pair_test {
namespace {

using namespace testing;

// A node of the master that shares a facet with contact is loaded by rounding only.
TEST(ExplicitPair, ChattersNotByRounding) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const Scene scene =
      load_scene(shipped("cylinder_on_plate.toml"),
                 {"integrator.name=forward-euler", "integrator.step=0.5", "time.end=5"}, key_table);
  const auto model = make_model(scene);
  const RunOutcome outcome =
      run(*model, chosen_integrator(scene), integrator_settings(scene, *model), store_policy(scene),
          nullptr, {});
  EXPECT_EQ(outcome.status, RunOutcome::Status::finished) << outcome.diagnosis;
}

}  // namespace
}  // namespace gnomon::explicit_pair_test
