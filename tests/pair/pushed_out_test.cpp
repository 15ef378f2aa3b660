// A start at which contact has pushed a body out of its partner is none.

#include <gmock/gmock.h>

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::pushed_out_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A shaft of 5 to 10 mm in a hub of 9.98 to 20 mm.
constexpr const char* press_fit = R"(
Macro Ring
 Point(b+1) = {ri,0,0}; Point(b+2) = {0,ri,0}; Point(b+3) = {-ri,0,0}; Point(b+4) = {0,-ri,0};
 Point(b+5) = {ro,0,0}; Point(b+6) = {0,ro,0}; Point(b+7) = {-ro,0,0}; Point(b+8) = {0,-ro,0};
 For k In {1:4}
  kk = (k % 4) + 1;
  Circle(b+k) = {b+k, 1000, b+kk}; Circle(b+10+k) = {b+4+k, 1000, b+4+kk};
  Line(b+20+k) = {b+k, b+4+k};
 EndFor
 For k In {1:4}
  kk = (k % 4) + 1;
  Curve Loop(b+k) = {b+k, b+20+kk, -(b+10+k), -(b+20+k)}; Plane Surface(b+k) = {b+k};
  Transfinite Curve{b+k, b+10+k} = 25; Transfinite Curve{b+20+k} = nr + 1;
  Transfinite Surface{b+k}; Recombine Surface{b+k};
 EndFor
Return
Point(1000) = {0, 0, 0};
b = 0; ri = 5; ro = 10; nr = 10; Call Ring;
b = 100; ri = 9.98; ro = 20; nr = 16; Call Ring;
Physical Surface("shaft") = {1:4}; Physical Surface("hub") = {101:104};
Physical Curve("bore") = {1:4}; Physical Curve("seat") = {11:14};
Physical Curve("eye") = {101:104}; Physical Curve("rim") = {111:114};
)";

constexpr const char* scene = R"scene(
problem = "worn_body"
mesh.file = "fit.geo"
body = [ { name = "shaft", young_modulus = 200e3, poisson_ratio = 0.3 },
         { name = "hub", young_modulus = 100e3, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["shaft", "hub"], friction = 0.1 } ]
motion = [ { body = "shaft", center = [0.0, 0.0], cycle = { rotation = "0.5*sin(2*pi*tau)" } } ]
support = [ { on = "bore", stiffness = 1e4 }, { on = "rim", stiffness = 1e-3 } ]
wear = { on = ["seat", "eye"], coefficient = 1e-8 }
cycle = { period = 1.0, phases = 4 }
time.cycles = 200
)scene";

class PushedOut : public PartScenes {};

// Springs of the rim bear far less than the torque of friction, 0.1 of the press fit.
TEST_F(PushedOut, AHubOnWeakSpringsHasNoStart) {
  folder_.write("fit.geo", press_fit);
  EXPECT_THAT(failed_start(scene), HasSubstr("at the start, at tau"));
}

/// The hub is held at its rim, the shaft by weak springs alone, and nothing but the fit presses
/// them on each other, all around by Lame's pressure. A facet of 96 is 5e-4 nearer than its circle.
TEST_F(PushedOut, AShaftOnWeakSpringsStaysInItsHub) {
  folder_.write("fit.geo", press_fit);
  constexpr double a = 10, shaft = 200e3, hub = 100e3, nu = 0.3;
  // In plane strain u = A r + B / r, with no stress at 5 mm, or u = 0 at 20 mm.
  const auto compliance = [](double young, double by_B) {  // u(a) / sigma_r(a), A = 1
    const double mu = young / 2 / (1 + nu), lambda = 2 * mu * nu / (1 - 2 * nu);
    return (a + by_B / a) / (2 * lambda + 2 * mu * (1 - by_B / a / a));
  };
  const double free = 5 * 5 / (1 - 2 * nu), held = -20 * 20;
  const double p = 0.02 / (compliance(shaft, free) - compliance(hub, held));
  for (const std::string load : {"", "load = [ { on = \"bore\", force = [1.0, 0.5] } ]\n"}) {
    const auto model = this->model(R"(problem = "worn_body"
mesh.file = "fit.geo"
body = [ { name = "shaft", young_modulus = 200e3, poisson_ratio = 0.3, material = "linear" },
         { name = "hub", young_modulus = 100e3, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["shaft", "hub"] } ]
support = [ { on = "bore", stiffness = 1.0 }, { on = "rim" } ]
wear = { on = ["seat", "eye"], coefficient = 1e-9 }
time.end = 1.0
)" + load);
    Counters counters;
    const State start = model->start(counters);
    EXPECT_EQ(observed(*model, start, "contact_nodes"), 96);
    EXPECT_NEAR(observed(*model, start, "contact_force") / (2 * M_PI * a * std::abs(p)), 1, 0.01);
    EXPECT_NEAR(observed(*model, start, "max_pressure") / std::abs(p), 1, 0.02);
  }
}

}  // namespace
}  // namespace gnomon::pushed_out_test
