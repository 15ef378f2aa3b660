// Paths of bodies whose contact is inclined to what presses them.
#include "stick/stick_scenes.hpp"

namespace gnomon::inclined_path_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

double radians(double degrees) {
  return degrees * M_PI / 180;
}

/// A pad on its bottom under a rigid plane that rises along x, as its face does.
class InclinedPath : public PartScenes {
protected:
  static constexpr double F = 10;

  /// `press`: tables of the counter-body.
  std::string pad(double degrees, double friction, const std::string& press,
                  const std::string& cycle = "") const {
    folder_.write("incline.geo", fmt::format(R"(T = {};
Point(1) = {{-2, -4, 0}}; Point(2) = {{2, -4, 0}}; Point(3) = {{2, 2*T, 0}}; Point(4) = {{-2, -2*T, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = 9; Transfinite Curve {{2, 4}} = 7;
Transfinite Surface {{1}}; Recombine Surface {{1}};
Physical Curve("bottom") = {{1}}; Physical Curve("face") = {{3}}; Physical Surface("pad") = {{1}};
)",
                                             std::tan(radians(degrees))));
    return fmt::format(R"toml(problem = "worn_body"
mesh.file = "incline.geo"
body = {{ young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" }}
support = [ {{ on = "bottom" }} ]
friction = {{ coefficient = {}, stick = true }}
wear = {{ on = ["face"], coefficient = 1e-8 }}
time.cycles = 10
cycle = {{ period = 1.0, phases = 8{} }}
[counter_body]
shape = "plane"
center = [0.0, 0.0]
normal = [{}, -1.0]
)toml",
                       friction, cycle, std::tan(radians(degrees))) +
           press;
  }
  static std::string press(const std::string& direction, double force,
                           const std::string& cycle = "") {
    return fmt::format("[[counter_body.press]]\ndirection = {}\nforce = {:.1f}\n", direction,
                       force) +
           (cycle.empty() ? "" : fmt::format("cycle = \"{}\"\n", cycle));
  }
  static std::string down(const std::string& cycle = "") { return press("[0.0, -1.0]", F, cycle); }
  static std::string along(double force, const std::string& cycle = "") {
    return press("[1.0, 0.0]", force, cycle);
  }
  double friction_force(const std::string& text) const {
    const auto model = this->model(text);
    Counters counters;
    return observed(*model, model->start(counters), "friction_force");
  }
};

/// Up the slope N = F / (cos - f sin).
TEST_F(InclinedPath, FrictionIsAlongASlopeHoweverSmall) {
  constexpr double f = 0.3;
  for (const double degrees : {-10.0, 0.0, 1.0, 10.0, 25.0}) {
    const double a = std::abs(radians(degrees)), N = F / (std::cos(a) - f * std::sin(a));
    const std::string text = pad(degrees, f, down(), ", x = \"0.3 * sin(2*pi*tau)\"");
    EXPECT_NEAR(friction_force(text) / (f * N), 1, 1e-6) << degrees;
  }
}

/// A direction that is free under no force does not press.
TEST_F(InclinedPath, AForceThatSwingsPressesBesideADirectionWithoutOne) {
  EXPECT_EQ(refusal(pad(10, 0.3, down("1 + 0.2*sin(2*pi*tau)") + along(0))), "");
}

/// With 12 down and 1 along x friction carries 1.099 where 11.99 press, the most in the cycle.
TEST_F(InclinedPath, WhatFrictionHoldsIsKnownAlongThePlane) {
  const auto remarks = [this](double friction) {
    return model(pad(10, friction, down("1 + 0.2*sin(2*pi*tau)") + along(1)))->remarks;
  };
  const auto told = Contains(HasSubstr("becomes more than friction holds"));
  EXPECT_THAT(remarks(0.35), Not(told));
  EXPECT_THAT(remarks(0.093), Not(told));
  EXPECT_THAT(remarks(0.090), Contains(HasSubstr("the force along the surface, 1.09")));
}

/// It presses straight on the face; the constant one would push the plane along it.
TEST_F(InclinedPath, AForceThatSwingsPressesBeforeAnObliqueOne) {
  const std::string text = pad(10, 0.35, down("1 + 0.2*sin(2*pi*tau)") + along(1));
  ASSERT_EQ(failed_start(text), "");
  const double a = radians(10);
  EXPECT_NEAR(friction_force(text), 1.2 * F * std::sin(a) - std::cos(a), 1e-6);
}

/// Friction alone holds the plane, whose force of 1 along x swings: F sin + cos at most.
TEST_F(InclinedPath, AFlatPadIsHeldByFrictionAlone) {
  for (const double degrees : {-10.0, 1.0, 5.0, 10.0, 15.0}) {
    const double a = std::abs(radians(degrees));
    const std::string text = pad(degrees, 0.5, down() + along(1, "sin(2*pi*tau)"));
    ASSERT_EQ(failed_start(text), "") << degrees;
    EXPECT_NEAR(friction_force(text), F * std::sin(a) + std::cos(a), 1e-6) << degrees;
  }
}

/// A pad that its load keeps on a base which moves along x slides by more than this, and sticks
/// nowhere.
TEST_F(InclinedPath, WhatFollowsASlopeIsNotDraggedByFriction) {
  folder_.write("pair.geo", R"(T = Tan(25*Pi/180);
Point(1) = {-2, -2*T, 0}; Point(2) = {2, 2*T, 0}; Point(3) = {2, 4, 0}; Point(4) = {-2, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(11) = {-3, -4, 0}; Point(12) = {3, -4, 0}; Point(13) = {3, 3*T, 0}; Point(14) = {-3, -3*T, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Transfinite Curve {1, 3} = 7; Transfinite Curve {11, 13} = 11; Transfinite Curve {2, 4, 12, 14} = 5;
Transfinite Surface {1, 11}; Recombine Surface {1, 11};
Physical Curve("pf") = {1}; Physical Curve("top") = {3}; Physical Curve("sides") = {2, 4};
Physical Curve("bf") = {13}; Physical Curve("bottom") = {11};
Physical Surface("pad") = {1}; Physical Surface("base") = {11};
)");
  const auto dragged = [this](double modulus) {
    const auto model = this->model(fmt::format(R"toml(problem = "worn_body"
mesh.file = "pair.geo"
body = [ {{ name = "pad", young_modulus = {0}, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "base", young_modulus = {0}, poisson_ratio = 0.3, material = "linear" }} ]
support = [ {{ on = "bottom" }}, {{ on = "top", directions = ["x"] }},
            {{ on = "sides", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -10.0] }} ]
pair = [ {{ bodies = ["pad", "base"], friction = 0.3 }} ]
motion = [ {{ body = "base", cycle = {{ x = "0.3 * sin(2*pi*tau)" }} }} ]
cycle = {{ period = 1.0, phases = 8 }}
wear = {{ on = ["pf", "bf"], coefficient = 1e-8 }}
time.cycles = 10
)toml",
                                               modulus));
    Counters counters;
    const Examination facts = model->examine(model->start(counters));
    return facts.drag->drag / facts.drag->stroke;
  };
  const double elastic = dragged(1e4);
  EXPECT_LT(elastic, 0.01);
  EXPECT_NEAR(dragged(1e3) / elastic, 10, 0.5);  // what friction drags is by the elastic shear
}

}  // namespace
}  // namespace gnomon::inclined_path_test
