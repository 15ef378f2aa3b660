// The worn pin depends on its mesh, and on the motion of the mesh, only as the size of the elements
// explains.

#include <gnomon/base/error.hpp>

#include "support/pin.hpp"

namespace gnomon::mesh_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

// Five times the paper's wear, deeper than the first row of elements.
TEST(PinMesh, TheWornSurfaceDoesNotDependOnTheAuxiliaryEnergy) {
  const auto worn = [](const Overrides& settings) {
    Overrides all = {elements(8), "wear.coefficient=5e-7"};
    all.insert(all.end(), settings.begin(), settings.end());
    return run_pin("esdirk-4", 0, 1e-4, 1000, all);
  };
  const PinRun by_paper = worn({});
  const Eigen::VectorXd surface = by_paper.worn_surface();
  for (const Overrides& settings : {Overrides{"shape.energy=blatz-ko"},
                                    Overrides{"shape.energy=blatz-ko", "shape.poisson_ratio=0.45"},
                                    Overrides{"shape.stiffening=2"}}) {
    const PinRun run = worn(settings);
    EXPECT_LT((run.worn_surface() - surface).cwiseAbs().maxCoeff(), 2e-3) << settings[0];
    EXPECT_NE(run.observed("element_volume"), by_paper.observed("element_volume"));
  }
}

TEST(PinMesh, ADistortedMeshWearsAsARegularOne) {
  for (const char* element : {"plain", "f-bar", "f-bar-variational"}) {
    const Overrides regular = {elements(12), std::string("body.element=") + element};
    Overrides distorted = regular;
    distorted.push_back("mesh.distortion=0.24");
    const PinRun run = run_pin("esdirk-4", 0, 1e-3, 1000, distorted, false, to_rounding);
    const PinRun reference = run_pin("esdirk-4", 0, 1e-3, 1000, regular);
    EXPECT_LT(run.observed("element_quality"), 0.9);
    EXPECT_NEAR(run.observed("wear_flux"), 2e-3, 1e-12);
    EXPECT_NEAR(run.observed("worn_volume"), reference.observed("worn_volume"), 0.01);
    EXPECT_LT((run.worn_surface() - reference.worn_surface()).cwiseAbs().maxCoeff(), 0.02)
        << element;
  }
}

TEST(PinMesh, RefusesADistortionThatInvertsElements) {
  try {
    pin_model({elements(12), "mesh.distortion=0.5"});
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("mesh.distortion: expected less"));
    EXPECT_THAT(error.what(), HasSubstr("0.5 inverts element"));
  }
}

}  // namespace
}  // namespace gnomon::mesh_test
