// Springs whose other ends move press bodies on a cam that lifts them, as loads do.

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::sprung_cam_test {
namespace {

using namespace testing;

/// Of "cam_and_follower.geo" or "cam_and_rocker.geo": what presses the second body is `more`.
std::string scene(const std::string& follower, const std::string& wear, const std::string& more) {
  return R"(
problem = "worn_body"
mesh.file = "cam_and_)" +
         follower + R"(.geo"
body = [ { name = "cam", young_modulus = 210e3, poisson_ratio = 0.3 },
         { name = ")" +
         follower + R"(", young_modulus = 210e3, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["cam", ")" +
         follower + R"("] } ]
motion = [ { body = "cam", center = [0.0, 0.0], cycle = { rotation = "2*pi*tau" } } ]
wear = { on = ["outline", ")" +
         wear + R"("], coefficient = 1e-9 }
cycle.period = 0.1
time.cycles = 10
[[support]]
on = "bore"
)" + more;
}

class SprungCam : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    for (const char* mesh : {"cam_and_follower.geo", "cam_and_rocker.geo"})
      folder_.write(mesh, text_of(shipped(mesh)));
  }
  /// At the start, mean over the phases [N/mm].
  double force(const std::string& text, const Overrides& overrides = {}) const {
    const auto model = this->model(text, overrides);
    Counters counters;
    return observed(*model, model->start(counters), "contact_force");
  }
};

/// On springs of 2 N/mm^3 along its width of 12 mm, their other ends 8 mm lower.
const std::string guided = R"(
[[support]]
on = "guide"
directions = ["x"]
[[support]]
on = "stem"
directions = ["y"]
stiffness = 2.0
value = [-8.0]
)";

/// It follows the cam by 3 mm (1 - cos) down from where this is highest.
constexpr double mean_force = 2.0 * 12 * (8 - 3);

// The polygon of the cam's facets of 1.5 mm lies up to 1.5^2 / (8 10) mm inside of its circle.
constexpr double facets = 2.0 * 12 * 0.03;

TEST_F(SprungCam, SpringsAlonePressAFollower) {
  EXPECT_NEAR(force(scene("follower", "face", guided), {"cycle.phases=12"}), mean_force, facets);
}

/// In every phase, however small the load is beside the springs.
TEST_F(SprungCam, ASmallLoadBesideSpringsDoesNotLoseContact) {
  const std::string loaded = "[[load]]\non = \"stem\"\nforce = [0.0, -1e-6]\n";
  EXPECT_NEAR(force(scene("follower", "face", guided + loaded), {"cycle.phases=24"}), mean_force,
              facets);
}

/// A pivot at (40, 13.8), a pad that is 0.8 mm above the cam of eccentricity 2, and springs of 5
/// N/mm^3 along 6 mm of its left end, 43 mm from the pivot: their force turns the rocker down on
/// the cam, at x = 2 cos.
TEST_F(SprungCam, SpringsAlonePressARocker) {
  const std::string hinged = R"(
[[support]]
on = "pivot"
[[support]]
on = "spring"
directions = ["y"]
stiffness = 5.0
value = [-10.0]
)";
  constexpr int phases = 8;
  double mean = 0;
  for (int k = 0; k < phases; ++k) {
    const double angle = 2 * M_PI * (k + 0.5) / phases, arm = 40 - 2 * std::cos(angle),
                 turn = (0.8 - 2 * std::sin(angle)) / arm;
    mean += 30 * (10 - 43 * turn) * 43 / arm / phases;
  }
  // The turned pad meets the cam beside its top, and the rocker bends.
  EXPECT_NEAR(force(scene("rocker", "pad", hinged), {"cycle.phases=8"}), mean, 0.02 * mean);
}

}  // namespace
}  // namespace gnomon::sprung_cam_test
