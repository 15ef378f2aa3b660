// A wheel that turns about its axle and rolls: its material passes the contact along circles.
#include "stick/rolling_scenes.hpp"

namespace gnomon::turning_wheel_test {
namespace {

using namespace testing;

class TurningWheel : public PairRolling {
protected:
  /// The block of two_half_planes() below a ring, held and pressed at its inner circle. "tread" is
  /// a fifth of a radian to both sides of the contact, "rim" the whole circle.
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
EndFor
Transfinite Curve {102, 112} = 2 * n + 1;
Transfinite Curve {103, 113, -101, -111} = 14 Using Progression 1.35;
Transfinite Curve {104, 114, -105, -115} = 8 Using Progression 1.3;
For i In {101:105} Transfinite Surface {i}; Recombine Surface {i}; EndFor
Physical Surface("cap") = {101:105};
Physical Curve("tread") = {101, 102, 103}; Physical Curve("rim") = {101:105};
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

/// Of a closed circle nothing has an end; where nothing touches it only wears along.
TEST_F(TurningWheel, OfAWholeRingRollsAsAPieceOfIt) {
  constexpr double creepage = 5e-4, time = 1000;
  const auto run = [&](const std::string& moves, const std::string& surface) {
    std::string text = wheel(moves) + fmt::format("[wear.surfaces.{}]\npath = {:.17g}\n", surface,
                                                  2 * M_PI * Mindlin::R);
    text.replace(text.find("on = \"sides\""), 12, "on = \"hub\"");
    text.replace(text.find("on = \"top\""), 10, "on = \"hub\"");
    const auto model = this->model(text, {"mesh.file=wheel.geo", "wear.coefficient=1e-7",
                                          fmt::format("wear.on=[\"{}\"]", surface)});
    const ModelRun made = run_model(*model, "esdirk-3", 0, 1e-3, time);
    const auto of = [&](const char* name) { return observed(*model, made.last(), name); };
    return std::array{of("friction_power"), of("wear_depth"), of("worn_volume")};
  };
  const auto whole = run(turns(creepage), "rim"), piece = run(passes(creepage), "tread");
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(whole[k] / piece[k], 1, 1e-4) << k;
  EXPECT_NEAR(whole[2] / (whole[1] * 2 * M_PI * Mindlin::R), 1, 1e-3);
}

TEST_F(TurningWheel, IsGivenByOneOfBoth) {
  expect_refused(wheel(turns(0) + ", velocity = [1000.0, 0.0]"), {}, "either a rotation about");
  expect_refused(wheel("rotation = 100.0"), {}, "also motion.1.center");
}

}  // namespace
}  // namespace gnomon::turning_wheel_test
