// Two bonded pads on one track, which carries the pressures under the one and meets them under the
// other: sums over the contact.

#include "part/part_scene.hpp"

namespace gnomon::bonded_pads_test {
namespace {

using namespace testing;

// The joint of the pads is not at a node of the track, whose facets are larger.
const char* const pads = R"(
Point(1) = {-8, 0, 0}; Point(2) = {0, 0, 0}; Point(3) = {0, 4, 0}; Point(4) = {-8, 4, 0};
Point(5) = {6, 0, 0}; Point(6) = {6, 4, 0};
Point(7) = {-15, -5, 0}; Point(8) = {15, -5, 0}; Point(9) = {15, 0, 0}; Point(10) = {-15, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};
Line(8) = {7, 8}; Line(9) = {8, 9}; Line(10) = {9, 10}; Line(11) = {10, 7};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};
Curve Loop(3) = {8, 9, 10, 11}; Plane Surface(3) = {3};
Transfinite Curve {1, 3} = 13; Transfinite Curve {5, 7} = 10; Transfinite Curve {2, 4, 6} = 4;
Transfinite Curve {8, 10} = 21; Transfinite Curve {9, 11} = 5;
Transfinite Surface {1, 2, 3}; Recombine Surface {1, 2, 3};
Physical Curve("left") = {1}; Physical Curve("right") = {5}; Physical Curve("back") = {3, 7};
Physical Curve("base") = {8}; Physical Curve("track") = {10};
Physical Surface("A") = {1}; Physical Surface("B") = {2}; Physical Surface("disc") = {3};
)";

const char* const text = R"toml(
problem = "worn_body"
mesh.file = "pads.geo"
[[body]]
name = "A"
young_modulus = 2000.0
poisson_ratio = 0.0
material = "linear"
[[body]]
name = "B"
young_modulus = 2000.0
poisson_ratio = 0.0
material = "linear"
[[body]]
name = "disc"
young_modulus = 1e10
poisson_ratio = 0.0
material = "linear"
[[pair]]
bodies = ["A", "disc"]
[[pair]]
bodies = ["B", "disc"]
[[support]]
on = "base"
[[support]]
on = "back"
directions = ["x"]
[[load]]
on = "back"
force = [0.0, -70.0]
[[motion]]
body = "disc"
velocity = [100.0, 0.0]
[wear]
on = ["left", "right", "track"]
coefficient = 1e-7
[time]
end = 100.0
)toml";

using BondedPads = PartScenes;

TEST_F(BondedPads, CarryTheLoadOnce) {
  folder_.write("pads.geo", pads);
  const auto model = this->model(text);
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "max_pressure"), 5, 1e-4);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 70, 1e-6);
  EXPECT_NEAR(observed(*model, start, "contact_area"), 14, 1e-3);
  // Each has its own half of the node that they share.
  EXPECT_NEAR(observed(*model, start, "wear_flux_A") / (1e-7 * 100), 40, 1e-3);
  EXPECT_NEAR(observed(*model, start, "wear_flux_B") / (1e-7 * 100), 30, 1e-3);
}

/// Two pairs of the same bodies, by their surfaces.
TEST_F(BondedPads, MayBeOneBodyWithItsOwnFrictionOfEach) {
  std::string geometry = pads, one = text;
  const auto replace = [](std::string& in, const std::string& from, const std::string& to) {
    in.replace(in.find(from), from.size(), to);
  };
  replace(geometry, R"(Physical Surface("A") = {1}; Physical Surface("B") = {2};)",
          R"(Physical Surface("A") = {1, 2};)");
  folder_.write("pads.geo", geometry);
  const std::size_t second = one.find("[[body]]\nname = \"B\"");
  one.erase(second, one.find("[[body]]", second + 1) - second);
  replace(one, R"(bodies = ["A", "disc"])",
          "bodies = [\"A\", \"disc\"]\nsurfaces = [\"left\", \"track\"]\nfriction = 0.01");
  const std::string repeated = one;
  replace(one, R"(bodies = ["B", "disc"])",
          "bodies = [\"disc\", \"A\"]\nsurfaces = [\"track\", \"right\"]\nfriction = 0.03");
  const auto model = this->model(one);
  Counters counters;
  const auto reactions = model->examine(model->start(counters)).reactions;
  ASSERT_FALSE(reactions.empty());
  EXPECT_NEAR(std::abs(reactions[0].force[0]), 0.01 * 40 + 0.03 * 30, 0.02);  // they tilt a little
  std::string all = repeated, same = repeated, more = repeated;
  replace(all, R"(bodies = ["B", "disc"])", R"(bodies = ["disc", "A"])");
  replace(same, R"(bodies = ["B", "disc"])",
          "bodies = [\"disc\", \"A\"]\nsurfaces = [\"track\", \"left\"]");
  replace(more, R"(bodies = ["B", "disc"])",
          "bodies = [\"disc\", \"A\"]\nsurfaces = [\"track\", \"left\", \"right\"]");
  for (const std::string& scene : {all, same, more})
    EXPECT_THAT(refusal(scene), ::testing::HasSubstr("each pair of bodies once"));
}

// Gross sliding, but for the shear of the pads where the motion turns.
TEST_F(BondedPads, HaveTheWorkOfTheirFrictionOnce) {
  folder_.write("pads.geo", pads);
  std::string swinging = text;
  const std::string velocity = "velocity = [100.0, 0.0]";
  swinging.replace(swinging.find(velocity), velocity.size(),
                   "cycle = { x = \"0.5*sin(2*pi*tau)\" }");
  const auto model = this->model(
      swinging +
      "[friction]\ncoefficient = 0.1\nstick = true\n[cycle]\nperiod = 1.0\nphases = 8\n");
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "friction_work"), 0.1 * 70 * 4 * 0.5, 0.2);
}

}  // namespace
}  // namespace gnomon::bonded_pads_test
