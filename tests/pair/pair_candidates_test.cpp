// Which facets of a master a slave may meet, as bodies move.
#include <fmt/format.h>

#include <cmath>
#include <gnomon/run/run.hpp>
#include <utility>

#include "part/part_scene.hpp"

namespace gnomon::pair_candidates_test {
namespace {

using namespace testing;

class PairCandidates : public PartScenes {
protected:
  /// The model with which a run goes on from its start, or null: the same.
  static std::shared_ptr<const Model> after_epochs(const Model& model, const State& start) {
    return model.overdue(start) ? model.succeed(start)->model : nullptr;
  }
  Counters counters_;
};

/// A stiff cap of a cylinder that does not wear sinks into a flat one over many fine facets, which
/// it then meets beside those that it faced at first: a segment of a circle wears off.
TEST_F(PairCandidates, WhatSinksMeetsOtherFacets) {
  folder_.write("cap.geo", R"(R = 6; w = 1.5; e = R - Sqrt(R * R - w * w); n = 150;
Point(1) = {0, 0, 0}; Point(2) = {0, R, 0}; Point(3) = {w, e, 0};
Point(4) = {w, 1.5, 0}; Point(5) = {0, 1.5, 0};
Circle(1) = {1, 2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 1};
Point(11) = {0, 0, 0}; Point(12) = {w, 0, 0}; Point(13) = {w, -1.5, 0}; Point(14) = {0, -1.5, 0};
Line(11) = {12, 11}; Line(12) = {11, 14}; Line(13) = {14, 13}; Line(14) = {13, 12};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {11, 13} = n + 3;
Transfinite Curve {2, 4, 12, 14} = 5;
Transfinite Surface {1}; Transfinite Surface {11}; Recombine Surface {1, 11};
Physical Surface("cap") = {1}; Physical Surface("flat") = {11};
Physical Curve("round") = {1}; Physical Curve("top") = {3}; Physical Curve("middle") = {4, 12};
Physical Curve("face") = {11}; Physical Curve("base") = {13};
)");
  constexpr double a = 1.2, R = 6, rate = 2e-8 * 50 * 100;
  const double segment = R * R * std::asin(a / R) - a * std::sqrt(R * R - a * a);
  const auto model = this->model(fmt::format(R"(problem = "worn_body"
mesh.file = "cap.geo"
body = [ {{ name = "cap", young_modulus = 1e7, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "flat", young_modulus = 4e3, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["cap", "flat"] }} ]
motion = [ {{ body = "flat", velocity = [0.0, 0.0, 100.0] }} ]
support = [ {{ on = "base" }}, {{ on = "middle", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -25.0] }} ]
wear = {{ on = ["face"], coefficient = 2e-8 }}
shape.motion = "gap"
time.end = {}
)",
                                             segment / rate));
  IntegratorSettings settings = controlled_settings(*model, 1e-3, segment / rate);
  settings.settled = {segment / rate};
  const RunOutcome end =
      run(*model, Integrators::find("esdirk-3", "integrator"), settings, {}, nullptr, {});
  ASSERT_EQ(end.status, RunOutcome::Status::finished) << end.diagnosis;
  EXPECT_GT(end.epochs, 1);
  const auto last = [&](const char* name) { return value_of(end.last->scalars, name).value(); };
  EXPECT_NEAR(2 * last("worn_volume") / segment, 1, 0.01);
  EXPECT_NEAR(2 * last("contact_half_width"), a, 0.02);
  EXPECT_LT(last("max_pressure") * 2 * a / 50, 1.1);
}

constexpr const char* pin_and_plate = R"(Mesh.MeshSizeMin = 0.5; Mesh.MeshSizeMax = 0.5;
Point(1) = {-2, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 3, 0}; Point(4) = {-2, 3, 0};
Point(11) = {-8, 0, 0}; Point(12) = {8, 0, 0}; Point(13) = {8, -3, 0}; Point(14) = {-8, -3, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(11) = {12, 11}; Line(12) = {11, 14}; Line(13) = {14, 13}; Line(14) = {13, 12};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Physical Surface("pin") = {1}; Physical Surface("plate") = {11};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Curve("base") = {13};
)";

/// The support of the pin's top along x is at `carried`.
std::string on_plate(const std::string& carried, const std::string& motion) {
  return R"(problem = "worn_body"
mesh.file = "pin.geo"
body = [ { name = "pin", young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" },
         { name = "plate", young_modulus = 2e4, poisson_ratio = 0.3, material = "linear" } ]
support = [ { on = "base" }, { on = "top", directions = ["x"], value = [)" +
         carried + R"(] } ]
load = [ { on = "top", force = [0.0, -100.0] } ]
wear = { on = "foot", coefficient = 1e-8 }
)" + motion;
}

// By five facets, before it is pressed.
TEST_F(PairCandidates, ASupportCarriesABodyToOtherFacets) {
  folder_.write("pin.geo", pin_and_plate);
  for (const std::string carried : {"0.0", "2.5"}) {
    const auto model = this->model(on_plate(carried, R"(pair = [ { bodies = ["pin", "plate"] } ]
motion = [ { body = "plate", velocity = [10.0, 0.0] } ]
time.end = 1.0
)"));
    const State start = model->start(counters_);
    const auto present = after_epochs(*model, start);
    EXPECT_EQ(present != nullptr, carried != "0.0");
    const Model& there = present ? *present : *model;
    EXPECT_NEAR(*value_of(there.observe(start), "contact_force"), 100, 0.1) << carried;
    EXPECT_NEAR(*value_of(there.observe(start), "max_pressure"), 30.2, 0.2) << carried;
    EXPECT_NEAR(there.examine(start).pairs.front().force[1], 100, 1e-6) << carried;
    EXPECT_FALSE(there.examine(start).intrusion) << carried;
  }
}

// While it is pressed, so that it slides all the way, and friction still acts.
TEST_F(PairCandidates, ASupportDragsABodyThatMaySlipToOtherFacets) {
  folder_.write("pin.geo", pin_and_plate);
  const auto model = this->model(
      on_plate("2.5", R"toml(pair = [ { bodies = ["pin", "plate"], friction = 0.05, stick = true } ]
motion = [ { body = "plate", cycle = { x = "1e-5*sin(2*pi*tau)" } } ]
cycle = { period = 1.0, phases = 8 }
time.cycles = 10
)toml"));
  const State start = model->start(counters_);
  const auto present = after_epochs(*model, start);
  ASSERT_TRUE(present);
  const auto force = present->examine(start).pairs.front().force;
  EXPECT_NEAR(std::abs(force[1]), 100, 1e-6);
  EXPECT_NEAR(std::abs(force[0]), 5, 0.05);
}

/// A block of 3 mm on a ring of 5 mm that turns; `held` says what its top does along x.
std::string on_ring(const std::string& held, double friction, const std::string& load = "") {
  return fmt::format(R"(problem = "worn_body"
mesh.file = "ring_and_block.geo"
body = [ {{ name = "ring", young_modulus = 1e4, poisson_ratio = 0.3 }},
         {{ name = "block", young_modulus = 2e4, poisson_ratio = 0.3 }} ]
pair = [ {{ bodies = ["ring", "block"], friction = {} }} ]
motion = [ {{ body = "ring", rotation = 1.0, center = [0.0, 0.0] }} ]
support = [ {{ on = "bore" }}, {{ on = "top", directions = ["x"]{} }} ]
load = [ {{ on = "top", force = [0.0, -100.0]{} }} ]
wear = {{ on = ["face", "rim"], coefficient = 1e-7 }}
time.end = 1.0
)",
                     friction, held, load);
}

constexpr const char* ring_and_block = R"(c1 = Cos(130*Pi/180); s1 = Sin(130*Pi/180);
Point(1) = {0, 0, 0}; Point(2) = {2*c1, 2*s1, 0}; Point(3) = {-2*c1, 2*s1, 0};
Point(4) = {-5*c1, 5*s1, 0}; Point(5) = {5*c1, 5*s1, 0};
Circle(1) = {2, 1, 3}; Line(2) = {3, 4}; Circle(3) = {4, 1, 5}; Line(4) = {5, 2};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {-2, 5, 0}; Point(12) = {2, 5, 0}; Point(13) = {2, 8, 0}; Point(14) = {-2, 8, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(2) = {11 : 14}; Plane Surface(2) = {2};
Transfinite Curve {1, 3} = 61; Transfinite Curve {2, 4} = 7;
Transfinite Curve {11, 13} = 25; Transfinite Curve {12, 14} = 9;
Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Physical Surface("ring") = {1}; Physical Surface("block") = {2}; Physical Curve("bore") = {1};
Physical Curve("rim") = {3}; Physical Curve("face") = {11}; Physical Curve("top") = {13};
)";

// Springs and friction bring the block, which may turn, to other facets of the ring: there the
// pressures, N by their sum, and friction, f N, are the force of the load and of the springs.
TEST_F(PairCandidates, FrictionCarriesABodyToOtherFacets) {
  folder_.write("ring_and_block.geo", ring_and_block);
  for (const auto& [stiffness, friction] : {std::pair(5.0, 0.05), std::pair(8.0, 0.2)}) {
    const auto model = this->model(on_ring(fmt::format(", stiffness = {}", stiffness), friction));
    const State start = model->start(counters_);
    const auto present = after_epochs(*model, start);
    ASSERT_TRUE(present);
    const auto force = present->examine(start).pairs.front().force;
    EXPECT_NEAR(force[1], -100, 1e-6);
    const double pressed = *value_of(present->observe(start), "contact_force");
    EXPECT_NEAR(pressed * std::hypot(1, friction) / std::hypot(force[0], force[1]), 1, 2e-3);
  }
}

// Behind a jump by a factor of 20 Newton's method alone does not find the equilibrium.
TEST_F(PairCandidates, ALoadMayJumpByFar) {
  folder_.write("ring_and_block.geo", ring_and_block);
  const auto model =
      this->model(on_ring("", 0.2, ", times = [0.0, 0.5, 0.5], factors = [0.05, 0.05, 1.0]"));
  const RunOutcome end = run(*model, Integrators::find("esdirk-3", "integrator"),
                             controlled_settings(*model, 1e-3, 1.0), {}, nullptr, {});
  ASSERT_EQ(end.status, RunOutcome::Status::finished) << end.diagnosis;
  EXPECT_NEAR(end.examination.pairs.front().force[1], -100, 1e-6);
}

}  // namespace
}  // namespace gnomon::pair_candidates_test
