// Two surfaces of one body, or of bonded bodies, that touch.

#include <gmock/gmock.h>

#include "part/part_scene.hpp"
#include "support/fretting_loop.hpp"

namespace gnomon::self_contact_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// The upper half of a fork, whose arms are 0.1 apart.
constexpr const char* half = R"(
Point(1) = {0, 0.05, 0}; Point(2) = {20, 0.05, 0}; Point(3) = {20, 3, 0}; Point(4) = {0, 3, 0};
Point(5) = {-4, 3, 0}; Point(6) = {-4, 0.05, 0}; Point(7) = {-4, 0, 0}; Point(8) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {4, 5}; Line(6) = {5, 6}; Line(7) = {6, 1}; Line(8) = {6, 7}; Line(9) = {7, 8};
Line(10) = {8, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -4}; Plane Surface(2) = {2};
Curve Loop(3) = {8, 9, 10, -7}; Plane Surface(3) = {3};
Transfinite Curve {1, 3} = 25; Transfinite Curve {2, 4, 6} = 5; Transfinite Curve {5, 7, 9} = 5;
Transfinite Curve {8, 10} = 2; Transfinite Surface {1 : 3}; Recombine Surface {1 : 3};
Physical Curve("upper") = {1}; Physical Curve("top") = {3};
)";

/// Mirrors it.
constexpr const char* other_half = R"(
s() = Symmetry {0, 1, 0, 0} { Duplicata { Surface{1, 2, 3}; } };
Coherence;
b() = Boundary { Surface{s(0)}; }; c() = Boundary { Surface{s(1)}; };
e() = Boundary { Surface{s(2)}; };
Transfinite Curve {b(0), b(2)} = 25; Transfinite Curve {b(1), b(3), c(1)} = 5;
Transfinite Curve {c(0), c(2)} = 5; Transfinite Curve {e(0), e(2)} = 2;
Transfinite Surface {s()}; Recombine Surface {s()};
Physical Curve("lower") = {b(0)}; Physical Curve("bottom") = {b(2)};
Physical Curve("back") = {6, 8, c(1), e(0)}; Physical Curve("slit") = {10, e(2)};
)";

constexpr const char* body = R"([[body]]
name = "fork"
young_modulus = 1000.0
poisson_ratio = 0.3
)";

constexpr const char* scene = R"(
problem = "worn_body"
[mesh]
file = "fork.geo"
[model]
plane = "strain"
[[pair]]
bodies = ["fork", "fork"]
surfaces = ["upper", "lower"]
[[support]]
on = "back"
[[load]]
on = "top"
pressure = 0.05
[[load]]
on = "bottom"
pressure = 0.05
[wear]
on = ["upper", "lower"]
coefficient = 1e-5
[time]
end = 1.0
)";

/// The upper arm bends more, then less, than the lower one, so that they slide on each other.
constexpr const char* swinging = R"toml(
[cycle]
period = 1.0
phases = 8
[[load]]
on = "top"
pressure = 0.05
cycle = "cos(2*pi*tau)"
)toml";

class SelfContact : public PartScenes {
protected:
  std::string fork() const {
    folder_.write("fork.geo",
                  std::string(half) + other_half + "Physical Surface(\"fork\") = {1 : 3, s()};\n");
    return std::string(scene) + body;
  }
  /// Of two bodies that are bonded at the back.
  std::string halves() const {
    folder_.write("fork.geo", std::string(half) + other_half +
                                  "Physical Surface(\"above\") = {1 : 3};"
                                  "Physical Surface(\"below\") = {s()};\n");
    const std::string above = with(body, "\"fork\"", "\"above\"");
    return with(scene, "[\"fork\", \"fork\"]", "[\"above\", \"below\"]") + above +
           with(above, "above", "below");
  }

  static std::string with(std::string text, const std::string& old, const std::string& now) {
    return text.replace(text.find(old), old.size(), now);
  }
};

// Each arm of a fork that loads close meets the plane of symmetry.
TEST_F(SelfContact, TheArmsOfAForkMeetInTheMiddle) {
  const auto whole = this->model(fork());
  Counters counters;
  const double between = observed(*whole, whole->start(counters), "contact_force");

  folder_.write("half.geo", std::string(half) +
                                "Physical Surface(\"fork\") = {1 : 3};"
                                "Physical Curve(\"back\") = {6, 8};"
                                "Physical Curve(\"middle\") = {9};\n");
  const auto part = this->model(R"(
problem = "worn_body"
[mesh]
file = "half.geo"
[model]
plane = "strain"
[body]
young_modulus = 1000.0
poisson_ratio = 0.3
[counter_body]
shape = "plane"
normal = [0.0, 1.0]
motion = { velocity = [1.0, 0.0] }
press = { direction = [0.0, 1.0], approach = 0.0 }
[[support]]
on = "back"
[[support]]
on = "middle"
directions = ["y"]
[[load]]
on = "top"
pressure = 0.05
[wear]
on = ["upper"]
coefficient = 1e-5
[time]
end = 1.0
)");
  const double on_plane = observed(*part, part->start(counters), "contact_force");
  EXPECT_GT(on_plane, 0.3);
  EXPECT_NEAR(between / on_plane, 1, 1e-5);
}

// What wears is k times the work of friction by its coefficient, and of both arms the same.
TEST_F(SelfContact, TheArmsOfAForkFretOnEachOther) {
  const Overrides overrides = {"pair.1.friction=0.2", "pair.1.stick=true", "time.cycles=1000",
                               "integrator.rtol=1e-4"};
  const auto worn = [&](const std::string& text, const std::string& name) {
    const auto model =
        this->model(with(text + swinging, "[time]\nend = 1.0\n", "[time]\n"), overrides);
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1000);
    const double work = observed(*model, run.last(), "friction_work"),
                 flux = observed(*model, run.last(), "wear_flux");
    EXPECT_NEAR(flux / (2 * 1e-5 * work / 0.2), 1, 1e-6);
    EXPECT_NEAR(enclosed_by_loop(model->contact(run.last()).value()) / work, 1, 0.06);
    return observed(*model, run.last(), name);
  };
  const double whole = worn(fork(), "worn_volume");
  EXPECT_GT(whole, 1e-3);
  const std::string two = halves();
  for (const char* name : {"worn_volume_above", "worn_volume_below"})
    EXPECT_NEAR(2 * worn(two, name) / whole, 1, 1e-4) << name;
}

TEST_F(SelfContact, WhatCannotTouchIsRefused) {
  EXPECT_THAT(refusal(with(fork(), "surfaces = [\"upper\", \"lower\"]\n", "")),
              HasSubstr("or pair.surfaces, two groups of the one body"));
  EXPECT_THAT(refusal(fork(), {R"(pair.1.surfaces=["upper", "lower", "top"])"}),
              HasSubstr("expected two groups, one for each of the surfaces that touch"));
  EXPECT_THAT(refusal(fork(), {R"(pair.1.surfaces=["upper", "slit"])"}),
              HasSubstr("expected surfaces that share no node"));
  EXPECT_THAT(refusal(with(halves(), "surfaces = [\"upper\", \"lower\"]\n", "")),
              HasSubstr("or name the two groups that touch in pair.surfaces"));
}

}  // namespace
}  // namespace gnomon::self_contact_test
