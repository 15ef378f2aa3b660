// Bodies whose meshes overlap start as they are pressed on each other: the overlap grows.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <gnomon/model/wear_model.hpp>
#include <vector>

#include "part/part_scene.hpp"

namespace gnomon::press_fit_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A solid shaft of 10.01 mm in a hub of 10 to 20 mm, of revolution.
constexpr const char* fit = R"(
Macro Ring
 Point(b+1) = {r, z0, 0}; Point(b+2) = {s, z0, 0}; Point(b+3) = {s, z1, 0}; Point(b+4) = {r, z1, 0};
 For k In {1:4}
  Line(b+k) = {b+k, b+(k % 4)+1};
 EndFor
 Curve Loop(b) = {b+1:b+4}; Plane Surface(b) = {b};
 Transfinite Curve{b+1, b+3} = 5; Transfinite Curve{b+2, b+4} = n+1;
 Transfinite Surface{b}; Recombine Surface{b};
Return
b = 10; r = 0; s = 10.01; z0 = -20; z1 = 20; n = 14; Call Ring;
b = 20; r = 10; s = 20; z0 = -15; z1 = 15; n = 14; Call Ring;
Physical Surface("shaft") = {10}; Physical Surface("hub") = {20};
Physical Curve("seat") = {12}; Physical Curve("bore") = {24};
Physical Curve("foot") = {11}; Physical Curve("pull") = {13}; Physical Curve("back") = {21};
)";

constexpr const char* scene = R"toml(
problem = "worn_body"
mesh.file = "fit.geo"
model.plane = "axisymmetric"
body = [ { name = "shaft", young_modulus = 210e3, poisson_ratio = 0.3 },
         { name = "hub", young_modulus = 210e3, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["shaft", "hub"], surfaces = ["seat", "bore"], friction = 0.02, stick = true } ]
support = [ { on = "back", directions = ["z"] },
            { on = "foot", directions = ["z"], stiffness = 0.01 } ]
load = [ { on = "pull", force = [0.0, 1.0], cycle = "sin(2*pi*tau)" } ]
cycle = { period = 0.02, phases = 4 }
wear = { on = ["seat", "bore"], coefficient = 1e-8 }
time.cycles = 10
)toml";

class PressFit : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    folder_.write("fit.geo", fit);
  }
};

/// Newton's method alone finds neither the whole of the overlap nor, with so little friction, what
/// sticks. Pressures fall with what friction holds.
TEST_F(PressFit, StartsWithLittleFriction) {
  const double lame = 210e3 * 0.01 / 20 * 0.75;
  std::vector<double> largest;
  for (const double friction : {0.007, 0.025, 0.043}) {
    SCOPED_TRACE(friction);
    const auto model = this->model(scene, {fmt::format("pair.1.friction={}", friction)});
    Counters counters;
    const State start = model->start(counters);
    const ContactSurface surface = model->contact(start).value();
    double middle = 0;
    for (std::size_t c = 0; c < surface.node.size(); ++c)
      if (std::abs(surface.initial[c][1]) < 0.1) middle = std::max(middle, surface.pressure[c]);
    EXPECT_NEAR(middle / lame, 1, 0.04);
    largest.push_back(observed(*model, start, "max_pressure"));
  }
  // All but a node or two slip, so that pressures are linear in friction.
  EXPECT_NEAR((largest[0] - largest[1]) / (largest[1] - largest[2]), 1, 0.02);
}

/// The face of the hub that is held ends where it touches the shaft, and is no plane of symmetry.
TEST_F(PressFit, FrictionCarriesTheLoad) {
  const auto model = this->model(scene, {"pair.1.friction=0.3", "load.1.force=[0.0, 5e3]"});
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "friction_force") / 5e3, 1, 1e-3);
}

/// The overlap presses the bodies, and the loads do not.
TEST_F(PressFit, WhatFrictionDoesNotHoldIsNotToldByTheLoadsAlone) {
  EXPECT_THAT(failed_start(scene, {"load.1.force=[0.0, 5e4]"}),
              AllOf(HasSubstr("no equilibrium on the path"), Not(HasSubstr("f P ="))));
}

TEST_F(PressFit, JacobianOnTheWayEqualsFiniteDifferences) {
  const auto model = this->model(scene);
  Counters counters;
  const State start = model->start(counters);
  const auto& equations = dynamic_cast<const WearModel<2>&>(*model).equations();
  ComposedSystem<2> way(equations.composition(), equations.deformation());
  const FieldValues<2> values = ComposedSystem<2>(equations.composition()).values(0, start.y);
  way.freeze(values, 0);
  way.set_load_fraction(0.4);
  std::vector<double> y(static_cast<std::size_t>(way.structure().size));
  way.numbering().gather(values, y);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.05 * way.structure().unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  const ActiveSet branch = active_set(way, 0, y);
  EXPECT_GT(std::ranges::count(branch, 0), 4);
  EXPECT_GT(std::ranges::count(branch, 1), 4);
  check_jacobian(way, 0, y, 0, &branch, 3e-5);
}

}  // namespace
}  // namespace gnomon::press_fit_test
