// A moment on a group of facets: forces without a resultant that grow linearly from their centroid.
#include <gmock/gmock.h>

#include "part/part_scene.hpp"

namespace gnomon {
namespace {

using namespace testing;
using ::testing::HasSubstr;

class MomentLoad : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    if (IsSkipped()) return;
    folder_.write("block.geo", block("-2"));
    folder_.write("box.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-2, -1, 0, 4, 2, 1};
Transfinite Curve {1:12} = 5; Transfinite Surface {1:6}; Recombine Surface {1:6};
Transfinite Volume {1};
Physical Surface("sole") = {5}; Physical Surface("back") = {6}; Physical Surface("sides") = {1:4};
Physical Volume("body") = {1};
)");
  }
  static std::string block(const std::string& left) {
    return "SetFactory(\"OpenCASCADE\");\nRectangle(1) = {" + left + R"(, 0, 0, 4, 2};
Transfinite Curve {1, 3} = 17; Transfinite Curve {2, 4} = 9; Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("sole") = {1}; Physical Curve("sides") = {2, 4}; Physical Curve("back") = {3};
Physical Surface("body") = {1};
)";
  }
  /// Pressed on a plane by 30 N in all, and turned.
  static std::string text(int dim, const std::string& moment) {
    const char* down = dim == 2 ? "[0.0, -30.0]" : "[0.0, 0.0, -30.0]";
    return fmt::format(R"(problem = "worn_body"
mesh.file = "{}.geo"
body = {{ young_modulus = 1000.0, poisson_ratio = 0.3, material = "linear" }}
wear = {{ on = "sole", coefficient = 1e-7 }}
time.end = 10.0
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
support = [ {{ on = "sides", stiffness = 1e-6 }} ]
load = [ {{ on = "back", force = {} }}, {{ on = "back", {} }} ]
[counter_body]
shape = "plane"
normal = {}
motion.velocity = {}
)",
                       dim == 2 ? "block" : "box", down, moment,
                       dim == 2 ? "[0.0, 1.0]" : "[0.0, 0.0, 1.0]",
                       dim == 2 ? "[1.0, 0.0]" : "[1.0, 0.0, 0.0]");
  }
};

TEST_F(MomentLoad, ShiftsTheContactForceByItsLever) {
  const auto model = this->model(text(2, "moment = 12.0"));
  Counters counters;
  const State start = model->start(counters);
  const auto now = [&](const char* name) { return observed(*model, start, name); };
  EXPECT_NEAR(now("force_loads_x"), 0, 1e-12);
  EXPECT_NEAR(now("force_loads_y"), -30, 1e-9);
  EXPECT_NEAR(now("torque_loads_z"), 12, 1e-2);  // by the rotation of the block less than 1e-3
  EXPECT_NEAR(now("torque_contact_z"), -12, 1e-2);
  const ContactSurface surface = model->contact(start).value();
  double force = 0, torque = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double x = surface.initial[c][0], width = std::abs(x) == 2 ? 0.125 : 0.25;
    force += width * surface.pressure[c];
    torque += width * surface.pressure[c] * x;
  }
  EXPECT_NEAR(torque / force, -12.0 / 30, 1e-3);  // what turns from x to y presses on the left
}

TEST_F(MomentLoad, HasAnAxisInSpace) {
  const auto model = this->model(text(3, "moment = 5.0, axis = [3.0, 4.0, 0.0]"));
  Counters counters;
  const State start = model->start(counters);
  const auto now = [&](const char* name) { return observed(*model, start, name); };
  EXPECT_NEAR(now("force_loads_z"), -30, 1e-9);
  EXPECT_NEAR(now("torque_loads_x"), 3, 1e-2);
  EXPECT_NEAR(now("torque_loads_y"), 4, 1e-2);
  EXPECT_NEAR(now("torque_loads_z"), 0, 1e-2);
  EXPECT_NEAR(now("torque_contact_x"), -3, 1e-2);
  EXPECT_NEAR(now("torque_contact_y"), -4, 1e-2);
}

TEST_F(MomentLoad, WhatDoesNotGoTogetherIsRefused) {
  EXPECT_THAT(refusal(text(3, "moment = 5.0")), HasSubstr("expected also load.2.axis"));
  EXPECT_THAT(refusal(text(2, "moment = 5.0, axis = [0.0, 0.0, 1.0]")),
              HasSubstr("expected none in the plane"));
  EXPECT_THAT(refusal(text(3, "force = [1.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0]")),
              HasSubstr("expected none without load.2.moment"));
  EXPECT_THAT(refusal(text(2, "moment = 5.0, force = [1.0, 0.0]")),
              HasSubstr("expected one kind of load, got also"));
  folder_.write("block.geo", block("0"));
  EXPECT_THAT(refusal(text(2, "moment = 5.0"),
                      {"body.plane=axisymmetric", "counter_body.motion.velocity=[0, 0]"}),
              HasSubstr("moment`: expected none in an axisymmetric scene"));
}

}  // namespace
}  // namespace gnomon
