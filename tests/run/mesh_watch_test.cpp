// When a worn mesh ends a run, and when a run warns of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/base/error.hpp>

#include "run/guards.hpp"

namespace gnomon::mesh_watch_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

Observation mesh(double volume, double quality) {
  return {common("element_volume", volume), common("element_quality", quality)};
}

std::vector<std::string> warned_of(const Observation& observed, double initial = 1) {
  std::vector<std::string> subjects;
  for (const MeshWarning& warning : mesh_warnings(observed, initial))
    subjects.push_back(warning.about);
  return subjects;
}

TEST(MeshWatch, EndsWhereAnElementHasLessThanAHundredthOfItsVolume) {
  EXPECT_NO_THROW(require_sound_mesh(mesh(0.01, 0.5)));
  EXPECT_THAT([] { require_sound_mesh(mesh(0.0099, 0.5)); },
              ThrowsMessage<SolutionError>(HasSubstr("worn down to 0.0099 of its volume")));
}

TEST(MeshWatch, EndsWhereAnElementIsFolded) {
  EXPECT_NO_THROW(require_sound_mesh(mesh(0.5, 1e-9)));
  EXPECT_THAT([] { require_sound_mesh(mesh(0.5, 0)); },
              ThrowsMessage<SolutionError>(HasSubstr("folded: its scaled Jacobian is 0")));
}

TEST(MeshWatch, WarnsOfWearBelowATenth) {
  EXPECT_THAT(warned_of(mesh(0.1, 0.1)), IsEmpty());
  EXPECT_THAT(warned_of(mesh(0.099, 0.5)), ElementsAre("wear"));
  EXPECT_THAT(warned_of(mesh(0.5, 0.099)), ElementsAre("wear"));
  EXPECT_THAT(warned_of(mesh(0.05, 0.05)), ElementsAre("wear"));  // once
  EXPECT_THAT(mesh_warnings(mesh(0.05, 0.05), 1)[0].text, HasSubstr("0.05 of its volume"));
}

// The mesh, not wear, is then the cause.
TEST(MeshWatch, SaysWhenTheMeshWasFoldedFromTheStart) {
  EXPECT_THAT(warned_of(mesh(1, 0.08), 0.09), ElementsAre("mesh"));
  EXPECT_THAT(
      mesh_warnings(mesh(1, 0.08), 0.09)[0].text,
      HasSubstr("as it was from the start: its scaled Jacobian is 0.08, and was 0.09 before"));
  EXPECT_THAT(warned_of(mesh(1, 0.08), 0.1), ElementsAre("wear"));
  EXPECT_THAT(mesh_warnings(mesh(1, 0.08), 0.1)[0].text, Not(HasSubstr("start")));
  // Wear has made it much worse.
  EXPECT_THAT(warned_of(mesh(1, 0.04), 0.09), ElementsAre("wear"));
  EXPECT_THAT(mesh_warnings(mesh(1, 0.04), 0.09)[0].text,
              HasSubstr("Jacobian is 0.04, that of the mesh was 0.09 from the start"));
  EXPECT_THAT(warned_of(mesh(0.09, 0.08), 0.09), ElementsAre("wear"));  // the volume
}

// A rhombus with an angle whose sine is 0.05, beside a square.
TEST(MeshWatch, KnowsTheQualityOfAMeshBeforeWear) {
  const double c = std::sqrt(1 - 0.05 * 0.05);
  Grid grid;
  grid.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1 + c, 0.05, 0}, {c, 0.05, 0}};
  grid.cells = {0, 1, 2, 3};
  EXPECT_NEAR(initial_quality(grid), 1, 1e-12);
  grid.cells.insert(grid.cells.end(), {0, 1, 4, 5});
  EXPECT_NEAR(initial_quality(grid), 0.05, 1e-12);
  EXPECT_EQ(initial_quality({}), 1);
}

TEST(MeshWatch, WarnsOfStrainsThatAreNotSmall) {
  Observation observed = mesh(1, 1);
  observed.push_back(common("displacement_gradient", 0.5));
  EXPECT_THAT(warned_of(observed), IsEmpty());
  observed.back().value = 0.51;
  EXPECT_THAT(warned_of(observed), ElementsAre("strain"));
  observed.front().value = 0.05;
  EXPECT_THAT(warned_of(observed), ElementsAre("wear", "strain"));
}

TEST(MeshWatch, HasNothingToSayWithoutAMesh) {
  EXPECT_NO_THROW(require_sound_mesh({}));
  EXPECT_THAT(mesh_warnings({}, 1), IsEmpty());
}

}  // namespace
}  // namespace gnomon::mesh_watch_test
