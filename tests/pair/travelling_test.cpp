// Torques of bodies that travel as a whole are those in space, also with small strains.

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::travelling_test {
namespace {

using namespace testing;

class Travelling : public PartScenes {
protected:
  Examination start(const std::string& text) const {
    const auto model = this->model(text);
    Counters counters;
    return model->examine(model->start(counters));
  }
};

double torque(const std::vector<ResultantForce>& forces, const std::string& name) {
  for (const ResultantForce& force : forces)
    if (force.name == name) return force.torque[2];
  return NAN;
}

/// A follower on a cam of radius 10 mm, which lets it down by 3 mm (1 - cos), with a friction of
/// 0.1 and a load that is the largest at the top.
std::string followed(const std::string& material) {
  const std::string law = "material = \"" + material + "\"";
  return R"scene(
problem = "worn_body"
mesh.file = "cam_and_follower.geo"
pair = [ { bodies = ["cam", "follower"] } ]
motion = [ { body = "cam", center = [0.0, 0.0], cycle = { rotation = "2*pi*tau" } } ]
cycle = { period = 0.1, phases = 12, load = "1+0.6*cos(2*pi*tau)" }
support = [ { on = "bore" }, { on = "guide", directions = ["x"] } ]
load = [ { on = "stem", force = [0.0, -50.0] } ]
wear = { on = ["outline", "face"], coefficient = 1e-9 }
friction.coefficient = 0.1
time.cycles = 10
[[body]]
name = "cam"
young_modulus = 210e3
poisson_ratio = 0.3
)scene" + law +
         R"scene(
[[body]]
name = "follower"
young_modulus = 110e3
poisson_ratio = 0.34
)scene" + law;
}

// The force of friction, f F, acts at the height of the contact, 10 + 3 cos, and the guide takes
// its torque.
TEST_F(Travelling, TorquesOfSmallStrainsAreThoseInSpace) {
  folder_.write("cam_and_follower.geo", text_of(shipped("cam_and_follower.geo")));
  const Examination linear = start(followed("linear")), large = start(followed("neo-hookean"));
  const double by_hand = 0.1 * 50 * (10 + 0.6 * 3 / 2);
  for (const Examination& facts : {linear, large}) {
    EXPECT_NEAR(torque(facts.reactions, "support_1"), by_hand, 0.005 * by_hand);
    EXPECT_NEAR(torque(facts.reactions, "support_2"), -by_hand, 0.005 * by_hand);
    EXPECT_NEAR(torque(facts.pairs, "\"follower\" on \"cam\""), -by_hand, 0.005 * by_hand);
  }
}

/// A linear pin of 4 mm on the friction of a plate that is 3 mm below it.
constexpr const char* dropped = R"(
problem = "worn_body"
mesh.file = "pin.geo"
pair = [ { bodies = ["pin", "plate"] } ]
motion = [ { body = "plate", velocity = [10.0, 0.0] } ]
support = [ { on = "base" }, { on = "top", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -20.0] } ]
wear = { on = "foot", coefficient = 1e-8 }
friction.coefficient = 0.3
time.end = 1000.0
[[body]]
name = "pin"
young_modulus = 100e3
poisson_ratio = 0.3
material = "linear"
[[body]]
name = "plate"
young_modulus = 200e3
poisson_ratio = 0.3
material = "linear"
)";

constexpr const char* pin = R"(
Point(1) = {-2, 0, 0, 0.5}; Point(2) = {2, 0, 0, 0.5}; Point(3) = {2, 4, 0, 1};
Point(4) = {-2, 4, 0, 1}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {-6, -3, 0, 0.5}; Point(12) = {6, -3, 0, 0.5}; Point(13) = {6, -6, 0, 1};
Point(14) = {-6, -6, 0, 1};
Line(11) = {11, 14}; Line(12) = {14, 13}; Line(13) = {13, 12}; Line(14) = {12, 11};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Physical Surface("pin") = {1}; Physical Surface("plate") = {11};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Curve("base") = {12};
)";

// The guide at the top, which has come down to 1 mm, and the base bear the friction of 6 N/mm; what
// bodies deform, and turn, counts as 0.002 mm.
TEST_F(Travelling, TorquesOfAPinThatComesFromAfarAreInBalance) {
  folder_.write("pin.geo", pin);
  const Examination facts = start(dropped);
  constexpr double by_hand = 6, deformed = 6 * 0.003;
  double sum = 0;
  for (const ResultantForce& force : facts.forces) sum += force.torque[2];
  EXPECT_NEAR(sum, 0, deformed);
  EXPECT_NEAR(torque(facts.reactions, "support_1"), -by_hand, deformed);
  EXPECT_NEAR(torque(facts.reactions, "support_2"), by_hand, deformed);
}

}  // namespace
}  // namespace gnomon::travelling_test
