// A wheel that turns about its axle and rolls: its material passes the contact along circles.
#include "stick/rolling_scenes.hpp"

namespace gnomon::turning_wheel_test {
namespace {

using namespace testing;

constexpr double V = 1000;  // of the material [mm/s]

class TurningWheel : public PairRolling {
protected:
  /// The block of two_half_planes() below a ring, held and pressed at its inner circle.
  void SetUp() override {
    PairRolling::SetUp();
    std::string block = rail(two_half_planes(10, 12, 1.4));
    const auto replace = [&block](const std::string& from, const std::string& to) {
      block.replace(block.find(from), from.size(), to);
    };
    replace("For k In {0:1}", "For k In {0:0}");
    block.erase(block.find("Physical Curve(\"top\")"));
    folder_.write("wheel.geo", block + R"(Physical Surface("flat") = {1, 2, 3, 4};
Point(100) = {0, R, 0};
angle[] = {-0.2, -b/R, b/R, 0.2, Pi};
For i In {0:4}
  x = Sin(angle[i]); y = -Cos(angle[i]);
  Point(101+i) = {R * x, R + R * y, 0}; Point(111+i) = {R/2 * x, R + R/2 * y, 0};
  Line(121+i) = {101+i, 111+i};
  Transfinite Curve {121+i} = m + 1 Using Progression r;
EndFor
For i In {0:4}
  j = (i + 1) % 5;
  Circle(101+i) = {101+i, 100, 101+j}; Circle(111+i) = {111+i, 100, 111+j};
  Curve Loop(101+i) = {101+i, 121+j, -(111+i), -(121+i)}; Plane Surface(101+i) = {101+i};
  Transfinite Surface {101+i} = {101+i, 101+j, 111+j, 111+i}; Recombine Surface {101+i};
EndFor
Transfinite Curve {102, 112} = 2 * n + 1;
Transfinite Curve {103, 113, -101, -111} = 14 Using Progression 1.35;
Transfinite Curve {104, 114, -105, -115} = 8 Using Progression 1.3;
Physical Surface("cap") = {101:105};
Physical Curve("rim") = {101:105};
Physical Curve("hub") = {111:115};
)");
  }

  /// rolling_cap(), whose upper body moves in this way.
  static std::string wheel(const std::string& moves) {
    std::string text = rolling_cap(V);
    const auto replace = [&text](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("velocity = [1000, 0.0]", moves);
    return text;
  }
  static std::string turns(double creepage) {
    return fmt::format("rotation = {:.17g}, center = [0.0, 6.0]", V * (1 + creepage) / Mindlin::R);
  }
  static std::string passes(double creepage) {
    return fmt::format("velocity = [{:.17g}, 0.0]", V * (1 + creepage));
  }
};

TEST_F(TurningWheel, IsOneWhoseRimHasThatVelocity) {
  Counters counters;
  const auto power = [&](const std::string& moves) {
    const auto model = this->model(wheel(moves), {});
    return observed(*model, model->start(counters), "friction_power");
  };
  EXPECT_NEAR(power(turns(5e-4)) / power(passes(5e-4)), 1, 1e-6);
}

/// Carter's, of a closed circle, which has no end and wears alike all around; with lines of the
/// block in the place of circles, and backwards, the same.
TEST_F(TurningWheel, MayBeAWholeRing) {
  constexpr double creepage = 5e-4, time = 1000, f = 0.3, rim = 2 * M_PI * Mindlin::R;
  const auto ring = [&](const std::string& moves, double velocity_of_block, const char* worn) {
    std::string text = wheel(moves);
    text.replace(text.find("on = \"sides\""), 12, "on = \"hub\"");
    text.replace(text.find("on = \"top\""), 10, "on = \"hub\"");
    text.replace(text.find(".face]\npath = 100.0"), 19,
                 fmt::format(".{}]\npath = {:.17g}", worn, rim));
    return this->model(text, {"mesh.file=wheel.geo", fmt::format("wear.on=[\"{}\"]", worn),
                              fmt::format("motion.2.velocity=[{}, 0.0]", velocity_of_block)});
  };
  const auto model = ring(turns(creepage), V, "rim");
  const ModelRun run = run_model(*model, "backward-euler", time, 0, time);
  const auto of = [&](const char* name) { return observed(*model, run.last(), name); };
  const double a = Mindlin::a(), b = a - creepage * Mindlin::R / f;
  const double Q = f * Mindlin::P * (1 - b * b / (a * a)), power = of("friction_power");
  EXPECT_NEAR(power / (creepage * Q * V), 1, 0.15);  // elements of a sixth of a
  EXPECT_NEAR(of("worn_volume") / (1e-9 * power / f * time), 1, 1e-3);
  EXPECT_NEAR(of("worn_volume") / (of("wear_depth") * rim), 1, 1e-3);
  Counters counters;
  const auto back = ring(turns(-2 - creepage), -V, "rim"), lines = ring(turns(creepage), V, "face");
  EXPECT_NEAR(observed(*back, back->start(counters), "friction_power") / power, 1, 5e-4);  // unworn
  EXPECT_NEAR(observed(*lines, lines->start(counters), "friction_power") / power, 1, 0.02);
}

TEST_F(TurningWheel, IsGivenByOneOfBoth) {
  expect_refused(wheel(turns(0) + ", velocity = [1000.0, 0.0]"), {}, "either a rotation about");
  expect_refused(wheel("rotation = 100.0"), {}, "also motion.1.center");
  expect_refused(wheel(turns(-2)), {"motion.1.force=2.0"}, "both bodies go the same way");
}

}  // namespace
}  // namespace gnomon::turning_wheel_test
