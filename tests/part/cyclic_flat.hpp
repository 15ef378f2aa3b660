// A flat that a cylinder wears, which moves to and fro in a cycle.
#pragma once

#include <fmt/format.h>

#include "part/part_scene.hpp"

namespace gnomon::testing {

/// Of 24 elements along its surface, and `high` below it; groups: bottom, surface.
inline std::string flat_geometry(int high) {
  return fmt::format(R"(Point(1) = {{-0.4, -0.4, 0}};
Point(2) = {{ 0.4, -0.4, 0}};
Point(3) = {{ 0.4, 0, 0}};
Point(4) = {{-0.4, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = 25;
Transfinite Curve {{2, 4}} = {};
Transfinite Surface {{1}};
Recombine Surface {{1}};
Physical Curve("bottom") = {{1}};
Physical Curve("surface") = {{3}};
Physical Surface("flat") = {{1}};
)",
                     high + 1);
}

class Cycles : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    folder_.write("flat.geo", flat_geometry(6));
  }

  /// `motion`: what [cycle] or [counter_body.motion] gives.
  std::string text(const std::string& motion, const std::string& press = "force = 18.5") const {
    return fmt::format(R"(problem = "worn_body"
mesh.file = "flat.geo"
body = {{ young_modulus = 1e4, poisson_ratio = 0.3 }}
support = [ {{ on = "bottom" }} ]
wear = {{ on = ["surface"], coefficient = 2.9e-6 }}
time.end = 100.0
integrator = {{ name = "esdirk-3", rtol = 1e-4 }}
[counter_body]
shape = "cylinder"
radius = 6.0
center = [0.0, 6.0]
press = {{ direction = [0.0, -1.0]{}{} }}
{}
)",
                       press.empty() ? "" : ", ", press, motion);
  }

  Counters unused_;
};

inline const std::string reciprocating =
    "[cycle]\nperiod = 1.0\nphases = 6\nx = \"0.1 * sin(2*pi*tau)\"\n";

}  // namespace gnomon::testing
