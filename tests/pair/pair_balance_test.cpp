// Bodies that contact holds: where they rest, and what is refused since nothing determines it.

#include <cmath>
#include <map>

#include "part/part_scene.hpp"

namespace gnomon::pair_balance_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr double height = 4;  // of the pivot above the sole

/// A block with a pivot in the middle of its top, turned by `tilt`, on a plate.
std::string shoe(double tilt) {
  return "tilt = " + std::to_string(tilt) + R"(;
Point(1) = {-5, 0, 0, 0.8}; Point(2) = {5, 0, 0, 0.8}; Point(3) = {5, 4, 0, 0.8};
Point(4) = {-5, 4, 0, 0.8}; Point(5) = {-0.5, 4, 0, 0.8}; Point(6) = {0, 4, 0, 0.8};
Point(7) = {0.5, 4, 0, 0.8};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 7}; Line(4) = {7, 6}; Line(5) = {6, 5};
Line(6) = {5, 4}; Line(7) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7}; Plane Surface(1) = {1};
Rotate {{0, 0, 1}, {0, 4, 0}, tilt} { Surface{1}; }
Point(11) = {-8, 0, 0, 0.8}; Point(12) = {8, 0, 0, 0.8}; Point(13) = {8, -4, 0, 2};
Point(14) = {-8, -4, 0, 2};
Line(11) = {11, 14}; Line(12) = {14, 13}; Line(13) = {13, 12}; Line(14) = {12, 11};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Physical Surface("shoe") = {1}; Physical Surface("plate") = {11};
Physical Curve("sole") = {1}; Physical Curve("top") = {4, 5}; Physical Point("pivot") = {6};
Physical Curve("face") = {14}; Physical Curve("base") = {12};
)";
}

constexpr const char* shoe_scene = R"(
problem = "worn_body"
[mesh]
file = "shoe.geo"
[[body]]
name = "shoe"
young_modulus = 1e5
poisson_ratio = 0.3
[[body]]
name = "plate"
young_modulus = 2e5
poisson_ratio = 0.3
[[pair]]
bodies = ["shoe", "plate"]
friction = 0.3
[[motion]]
body = "plate"
velocity = [100.0, 0.0]
[[support]]
on = "base"
[[support]]
on = "pivot"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -100.0]
[shape]
hold = ["top"]
[wear]
on = ["sole", "face"]
coefficient = 1e-9
[time]
end = 100.0
)";

ResultantForce reaction_of(const Model& model, const State& state, const std::string& support) {
  for (const ResultantForce& force : model.examine(state).reactions)
    if (force.name == support) return force;
  ADD_FAILURE() << "no reaction of " << support;
  return {};
}

/// By the torque of a support about the origin, which the forces on the plate have, too.
double centre_of_pressure(const Model& model, const State& state) {
  const ResultantForce base = reaction_of(model, state, "support_1");
  return base.torque[2] / base.force[1];
}

class PairBalance : public PartScenes {};

// The resultant of pressure and friction goes through the pivot, before and after wear.
TEST_F(PairBalance, AShoeTurnsUntilItsForcesMeetThePivot) {
  for (const double tilt : {0.0, 0.05}) {
    folder_.write("shoe.geo", shoe(tilt));
    for (const char* solver : {"direct", "block"})
      for (const double friction : {0.0, 0.3, 1.0}) {
        SCOPED_TRACE(::testing::Message() << tilt << " " << solver << " " << friction);
        const auto model = this->model(shoe_scene, {"pair.1.friction=" + std::to_string(friction),
                                                    "solver.method=" + std::string(solver)});
        const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 100);
        for (const State& state : {run.states.front(), run.last()}) {
          EXPECT_NEAR(observed(*model, state, "contact_force"), 100, 0.2);
          EXPECT_NEAR(centre_of_pressure(*model, state), -friction * height, 0.03);
        }
      }
  }
}

/// A lever on a pivot at (-60, 62), a load at its other end, with a block on a drum of radius 50.
constexpr const char* lever = R"(
Point(1) = {0, 49.8, 0}; Point(2) = {-8, 49.36, 0, 0.7}; Point(3) = {8, 49.36, 0, 0.7};
Point(4) = {8, 58, 0, 2}; Point(5) = {60, 58, 0, 2}; Point(6) = {60, 66, 0, 2};
Point(7) = {50, 66, 0, 2}; Point(8) = {-60, 66, 0, 2}; Point(9) = {-60, 62, 0, 2};
Point(10) = {-60, 58, 0, 2}; Point(11) = {-8, 58, 0, 2};
Line(1) = {2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {6, 7};
Line(6) = {7, 8}; Line(7) = {8, 9}; Line(8) = {9, 10}; Line(9) = {10, 11}; Line(10) = {11, 2};
Curve Loop(1) = {1 : 10}; Plane Surface(1) = {1};
Point(20) = {0, 0, 0}; Point(21) = {-20, 45.83, 0, 1}; Point(22) = {20, 45.83, 0, 1};
Point(23) = {16, 34.6, 0, 3}; Point(24) = {-16, 34.6, 0, 3};
Circle(21) = {21, 20, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(2) = {21 : 24}; Plane Surface(2) = {2};
Physical Surface("lever") = {1}; Physical Surface("drum") = {2};
Physical Curve("sole") = {1}; Physical Curve("rim") = {21}; Physical Curve("hub") = {23};
Physical Curve("handle") = {5}; Physical Point("pivot") = {9};
)";

constexpr const char* lever_scene = R"(
problem = "worn_body"
[mesh]
file = "lever.geo"
[[body]]
name = "lever"
young_modulus = 70e3
poisson_ratio = 0.33
[[body]]
name = "drum"
young_modulus = 120e3
poisson_ratio = 0.27
[[pair]]
bodies = ["lever", "drum"]
friction = 0.4
[[motion]]
body = "drum"
rotation = -20.0
center = [0.0, 0.0]
[[support]]
on = "hub"
[[support]]
on = "pivot"
[[load]]
on = "handle"
force = [0.0, -20.0]
[wear]
on = ["sole"]
coefficient = 1e-8
[time]
end = 10.0
)";

// The mesh of the curved drum leaves a gap that only a rotation closes. Forces on the lever have no
// torque about its pivot.
TEST_F(PairBalance, ALeverIsTurnedUntilItTouches) {
  folder_.write("lever.geo", lever);
  for (const char* factor : {"0.8", "1", "1.4", "2"}) {
    SCOPED_TRACE(factor);
    const auto model = this->model(lever_scene, {std::string("mesh.factor=") + factor});
    Counters counters;
    const ResultantForce hub = reaction_of(*model, model->start(counters), "support_1");
    const double torque = hub.torque[2] - (-60 * hub.force[1] - 62 * hub.force[0]);
    EXPECT_NEAR(torque / (20 * (60 + 55)), 1, 3e-3);
  }
}

// Friction above half of the length by the height turns it over.
TEST_F(PairBalance, WhatNothingDeterminesIsRefused) {
  folder_.write("shoe.geo", shoe(0));
  EXPECT_THAT(refusal(shoe_scene, {"pair.1.friction=1.3"}), HasSubstr("\"shoe\" can turn about"));
  EXPECT_THAT(refusal(shoe_scene, {"load.1.force=[0.0, 100.0]"}),
              HasSubstr("\"shoe\" can move along y"));
  EXPECT_THAT(refusal(shoe_scene, {"load.1.times=[0.0, 50.0]", "load.1.factors=[1.0, -1.0]"}),
              HasSubstr("at t = 50 s \"shoe\" can"));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Its load goes through the pivot.
TEST_F(PairBalance, APivotThatSlidesIsRefused) {
  folder_.write("shoe.geo", shoe(0.05));
  EXPECT_THAT(refusal(replaced(shoe_scene, "[\"x\"]", "[\"y\"]")),
              HasSubstr("\"shoe\" can move along x and turn, and no load acts on it in this way"));
  EXPECT_THAT(refusal(shoe_scene, {"load.1.on=base"}), HasSubstr("no load acts on it in this way"));
  // Turned, it lies in the plate at first.
  EXPECT_THAT(refusal(shoe_scene, {"load.1.force=[0.0, 0.0]"}),
              HasSubstr("\"shoe\" can move along y and turn, and no load acts on it in this way"));
}

/// A bush around a shaft of radius 5.
std::string bush(double bore) {
  return "r[] = {2, 5, " + std::to_string(bore) + R"(, 7};
Point(1) = {0, 0, 0};
For k In {0:3}
  Point(10*k+11) = {r[k], 0, 0, 1}; Point(10*k+12) = {0, r[k], 0, 1};
  Point(10*k+13) = {-r[k], 0, 0, 1}; Point(10*k+14) = {0, -r[k], 0, 1};
  Circle(10*k+11) = {10*k+11, 1, 10*k+12}; Circle(10*k+12) = {10*k+12, 1, 10*k+13};
  Circle(10*k+13) = {10*k+13, 1, 10*k+14}; Circle(10*k+14) = {10*k+14, 1, 10*k+11};
  Curve Loop(k+1) = {10*k+11, 10*k+12, 10*k+13, 10*k+14};
EndFor
Plane Surface(1) = {2, 1}; Plane Surface(2) = {4, 3};
Physical Surface("plate") = {1}; Physical Surface("shoe") = {2};
Physical Curve("base") = {11:14}; Physical Curve("face") = {21:24};
Physical Curve("sole") = {31:34}; Physical Curve("top") = {41}; Physical Point("pivot") = {42};
)";
}

// As pressed on, it needs none.
TEST_F(PairBalance, ABushWithPlayNeedsALoad) {
  const Overrides on_the_shaft = {"load.1.on=base", "friction.coefficient=0.1"};
  folder_.write("shoe.geo", bush(4.95));
  EXPECT_NO_THROW(this->model(shoe_scene, on_the_shaft));
  folder_.write("shoe.geo", bush(5.1));
  EXPECT_THAT(refusal(shoe_scene, on_the_shaft), HasSubstr("no load acts on it in this way"));
}

TEST_F(PairBalance, SeveralPointsAreNoPivot) {
  folder_.write("shoe.geo", replaced(shoe(0), "(\"pivot\") = {6}", "(\"pivot\") = {5, 6}"));
  EXPECT_THAT(this->model(shoe_scene)->remarks,
              ::testing::Contains(HasSubstr("number 2 holds each of the 2 points of \"pivot\"")));
}

TEST_F(PairBalance, HowFarBodiesOverlapIsTold) {
  folder_.write("shoe.geo", replaced(replaced(shoe(0), "{-8, 0, 0, 0.8}", "{-8, 1, 0, 0.8}"),
                                     "{8, 0, 0, 0.8}", "{8, 1, 0, 0.8}"));
  EXPECT_THAT(refusal(shoe_scene), HasSubstr("\"shoe\" and \"plate\" overlap by about 1 mm"));
}

TEST_F(PairBalance, WhatOneBodyExertsOnTheOther) {
  folder_.write("shoe.geo", shoe(0));
  const auto model = this->model(shoe_scene);
  Counters counters;
  const std::vector<ResultantForce> pairs = model->examine(model->start(counters)).pairs;
  ASSERT_EQ(pairs.size(), 1u);
  const double side = pairs[0].name == "\"plate\" on \"shoe\"" ? 1 : -1;
  EXPECT_NEAR(side * pairs[0].force[0], 30, 0.1);  // it drags the shoe along
  EXPECT_NEAR(side * pairs[0].force[1], 100, 0.1);
}

// Of moduli in the wrong unit.
TEST_F(PairBalance, AFailureNamesTheBodyAndThePhase) {
  folder_.write("shoe.geo", shoe(0));
  const std::string cycle = "[cycle]\nperiod = 1.0\nphases = 2\nload = \"1 + 0.5*cos(2*pi*tau)\"\n";
  Counters counters;
  for (const auto& [scene, message] :
       {std::pair<std::string, std::string>{shoe_scene, "\"shoe\" can turn about"},
        {shoe_scene + cycle, "at the start, at tau = 0 of the cycle"}}) {
    const auto model = this->model(scene, {"body.shoe.young_modulus=2.0"});
    EXPECT_THAT([&] { model->start(counters); },
                ::testing::ThrowsMessage<SolutionError>(HasSubstr(message)));
  }
}

std::string disc() {
  return R"(
Point(1) = {0, 0, 0, 0.6}; Point(2) = {5, 0, 0, 0.6}; Point(3) = {0, 5, 0, 0.6};
Point(4) = {-5, 0, 0, 0.6}; Point(5) = {0, -5, 0, 0.6};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("disc") = {1}; Physical Curve("round") = {1, 2, 3, 4};
Physical Curve("upper") = {1, 2}; Physical Point("top") = {3};
)";
}

/// A block whose face touches a circle of radius 5 in the direction of an angle.
std::string wall(double degrees) {
  return "c = Cos(" + std::to_string(degrees) + " * Pi / 180); s = Sin(" + std::to_string(degrees) +
         R"( * Pi / 180);
Point(1) = {5*c + 3*s, 5*s - 3*c, 0, 0.75}; Point(2) = {5*c - 3*s, 5*s + 3*c, 0, 0.75};
Point(3) = {9*c - 3*s, 9*s + 3*c, 0, 1}; Point(4) = {9*c + 3*s, 9*s - 3*c, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("wall") = {1}; Physical Curve("face") = {1}; Physical Curve("base") = {3};
)";
}

std::string body(const std::string& name, const std::string& more) {
  return "[[body]]\nname = \"" + name + "\"\nmesh = \"" + name +
         ".geo\"\nyoung_modulus = 2e4\npoisson_ratio = 0.3\n" + more;
}

constexpr const char* disc_and_right = R"(
[[pair]]
bodies = ["disc", "right"]
[[motion]]
body = "disc"
rotation = 20.0
center = [0.0, 0.0]
[[load]]
on = "upper"
force = [0.0, -10.0]
[time]
end = 10.0
)";

// By statics, with the supports of the walls, whose forces go along the normals of their faces.
TEST_F(PairBalance, ADiscLiesInAGroove) {
  folder_.write("disc.geo", disc());
  folder_.write("right.geo", wall(-30));
  folder_.write("left.geo", wall(200));
  const std::string scene = "problem = \"worn_body\"\n" + body("disc", "shift = [0.3, 0.2]\n") +
                            body("right", "") + body("left", "") + disc_and_right + R"(
[[pair]]
bodies = ["disc", "left"]
[[support]]
on = "right.base"
[[support]]
on = "left.base"
[wear]
on = ["right.face", "left.face"]
coefficient = 1e-8
)";
  const auto model = this->model(scene + "[[support]]\non = \"top\"\ndirections = [\"x\"]\n");
  Counters counters;
  const State start = model->start(counters);
  for (const auto& [name, degrees] :
       std::map<std::string, double>{{"support_1", 150}, {"support_2", 20}}) {
    const ResultantForce reaction = reaction_of(*model, start, name);
    EXPECT_NEAR(std::atan2(reaction.force[1], reaction.force[0]) * 180 / M_PI, degrees, 0.5);
  }
  EXPECT_THAT(refusal(scene), HasSubstr("\"disc\" can turn about"));
}

// Its load above it would roll it away, and it spins without any resistance.
TEST_F(PairBalance, ADiscRollsOnAPlate) {
  folder_.write("disc.geo", disc());
  folder_.write("right.geo", wall(-90));
  const std::string scene = "problem = \"worn_body\"\n" + body("disc", "") + body("right", "") +
                            disc_and_right +
                            "[[support]]\non = \"base\"\n[wear]\non = [\"face\"]\ncoefficient = "
                            "1e-8\n[[support]]\non = \"top\"\n";
  EXPECT_THAT(refusal(scene + "directions = [\"x\"]\n"), HasSubstr("\"disc\" can turn about"));
}

// A load presses a disc, which is above its plate, on it against a weak spring at its top; a stiff
// one keeps them apart.
TEST_F(PairBalance, AWeakSpringLetsADiscTouch) {
  folder_.write("disc.geo", disc());
  folder_.write("right.geo", wall(-90));
  const std::string scene = "problem = \"worn_body\"\n" + body("disc", "shift = [0.0, 0.5]\n") +
                            body("right", "") + disc_and_right +
                            "[[support]]\non = \"base\"\n[[support]]\non = \"top\"\ndirections = "
                            "[\"x\"]\n[wear]\non = [\"face\"]\ncoefficient = 1e-8\n"
                            "[[support]]\non = \"upper\"\nstiffness = ";
  for (const auto& [stiffness, carried] : std::map<std::string, double>{{"0.01", 9.9}, {"10", 0}}) {
    const auto model = this->model(scene + stiffness + "\n");
    Counters counters;
    EXPECT_NEAR(reaction_of(*model, model->start(counters), "support_1").force[1], carried, 0.1);
  }
}

// In space, with a pivot that is free to move down and to turn.
TEST_F(PairBalance, AShoeInSpaceTurnsToo) {
  folder_.write("shoe.geo", R"(
Point(1) = {-3, -2, 0}; Point(2) = {0, -2, 0}; Point(3) = {3, -2, 0};
Point(4) = {3, 2, 0}; Point(5) = {0, 2, 0}; Point(6) = {-3, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 5}; Line(3) = {5, 6}; Line(4) = {6, 1};
Line(5) = {2, 3}; Line(6) = {3, 4}; Line(7) = {4, 5};
Transfinite Curve {1, 2, 3, 4, 5, 6, 7} = 4;
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};
Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Point(11) = {-4, -3, 0}; Point(12) = {4, -3, 0}; Point(13) = {4, 3, 0}; Point(14) = {-4, 3, 0};
Line(51) = {11, 12}; Line(52) = {12, 13}; Line(53) = {13, 14}; Line(54) = {14, 11};
Transfinite Curve {51, 53} = 8; Transfinite Curve {52, 54} = 6;
Curve Loop(51) = {51, 52, 53, 54}; Plane Surface(51) = {51};
Transfinite Surface {51}; Recombine Surface {51};
a[] = Extrude {0, 0, 2} { Surface{1, 2}; Layers{2}; Recombine; };
b[] = Extrude {0, 0, -2} { Surface{51}; Layers{2}; Recombine; };
Physical Volume("shoe") = {a[1], a[7]}; Physical Volume("plate") = {b[1]};
Physical Surface("sole") = {1, 2}; Physical Surface("top") = {a[0], a[6]};
Physical Surface("face") = {51}; Physical Surface("base") = {b[0]};
)");
  std::string scene = shoe_scene;
  const auto replace = [&](const std::string& from, const std::string& to) {
    scene.replace(scene.find(from), from.size(), to);
  };
  replace("on = \"pivot\"\ndirections = [\"x\"]", "on = \"top\"\ndirections = [\"x\", \"y\"]");
  replace("[100.0, 0.0]", "[100.0, 0.0, 0.0]");
  replace("[0.0, -100.0]", "[0.0, 0.0, -100.0]");
  const auto model = this->model(scene);
  Counters counters;
  const State start = model->start(counters);
  const ResultantForce base = reaction_of(*model, start, "support_1");
  EXPECT_NEAR(base.force[2], 100, 0.1);
  EXPECT_NEAR(-base.torque[1] / base.force[2], -0.3 * 2, 0.02);
  EXPECT_NEAR(base.torque[0] / base.force[2], 0, 0.02);
  EXPECT_THAT(refusal(scene, {"pair.1.friction=1.7"}), HasSubstr("\"shoe\" can turn about"));
}

}  // namespace
}  // namespace gnomon::pair_balance_test
