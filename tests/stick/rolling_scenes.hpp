// Scenes of steady rolling for tests: a rigid cylinder on a half-plane, and two bodies.
#pragma once

#include <fmt/format.h>

#include <string>

#include "stick/two_half_planes.hpp"

namespace gnomon::testing {

/// A rigid cylinder that rolls on an incompressible half-plane, driven by a force: F. W. Carter
/// (1926); K. L. Johnson, Contact Mechanics, sec. 8.3.
struct Carter : Cattaneo {
  static constexpr double V = 1000, path = 100, Q = ratio * f * P;
  static double creepage() { return f * (a() - c()) / R; }
  /// On the counter-body; material enters at -a, and sticks from there.
  static double traction(double x) { return f * (elliptic(a(), x) - elliptic(c(), x + a() - c())); }
};

class RollingScenes : public Fretting {
protected:
  void SetUp() override {
    Fretting::SetUp();
    if (IsSkipped()) return;
    write_rail("flat.geo", 18, 16, 1.28);
    write_rail("coarse.geo", 8, 5, 2.4);
    folder_.write("box.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-0.4, -0.4, -0.4, 0.8, 0.8, 0.4};
Transfinite Curve "*" = 9; Transfinite Surface "*"; Transfinite Volume {1}; Recombine Surface "*";
Physical Surface("bottom") = {5}; Physical Surface("surface") = {6}; Physical Volume("box") = {1};
)");
  }
  /// What rolls wears from end to end.
  void write_rail(const std::string& name, int half, int layers, double growth) {
    std::string text = half_plane(half, layers, growth);
    const std::string middle = "\"surface\") = {4}";
    text.replace(text.find(middle), middle.size(), "\"surface\") = {4, 5, 8}");
    folder_.write(name, text);
  }
  /// Driven by the force, or by what `rolling` says.
  static std::string cylinder(const std::string& rolling = "", double nu = Carter::nu) {
    std::string text = Fretting::cylinder("", nu);
    text.erase(text.find("[cycle]"));
    const auto replace = [&text](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("time.cycles = 1000", "time.end = 1000.0");
    replace(", stick = true", "");
    replace("2.9e-8 }",
            fmt::format("2.9e-8, surfaces = {{ surface = {{ path = {} }} }} }}", Carter::path));
    replace("cycle = \"sin(2*pi*tau)\"\n", "");
    replace("direction = [1.0, 0.0]", "direction = [-1.0, 0.0]");
    if (!rolling.empty()) text.erase(text.rfind("[[counter_body.press]]"));
    return text + fmt::format("[rolling]\nvelocity = [{}, 0.0]\n{}\n", Carter::V, rolling);
  }

  /// A rigid ball on a block in space, which passes as `rolling` says.
  static std::string ball(const std::string& rolling, double x = 0,
                          const std::string& presses = "") {
    return fmt::format(R"toml(problem = "worn_body"
mesh.file = "box.geo"
body = {{ young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }}
support = [ {{ on = "bottom" }} ]
friction = {{ coefficient = 0.3 }}
wear = {{ on = ["surface"], coefficient = 2.9e-8, surfaces = {{ surface = {{ path = 100.0 }} }} }}
time.end = 1000.0
counter_body = {{ shape = "ball", radius = 5.0, center = [{}, 0.0, 5.0], press = [ {{ direction = [0.0, 0.0, -1.0], force = 400.0 }}{} ] }}
rolling = {{ velocity = [1000.0, 0.0, 0.0]{} }}
)toml",
                       x, presses, rolling.empty() ? "" : ", " + rolling);
  }

  struct Found {
    double creepage, force, power, flux, stick;
  };
  Found found(const std::string& text, const Overrides& overrides = {}) {
    const auto model = this->model(text, overrides);
    Counters counters;
    const State start = model->start(counters);
    const auto of = [&](const char* name) { return observed(*model, start, name); };
    iterations_ = counters.newton_iterations;
    return {of("creepage_x"), -of("guide_x"), of("friction_power"), of("wear_flux"),
            of("stick_area")};
  }
  long iterations_ = 0;
};

/// A cap that rolls on a block, whose material passes at 1000 mm/s.
inline std::string rolling_cap(double velocity_of_cap) {
  return fmt::format(R"(problem = "worn_body"
mesh.file = "rail.geo"
body = [ {{ name = "cap", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "flat", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["cap", "flat"], friction = 0.3, stick = true }} ]
motion = [ {{ body = "cap", velocity = [{}, 0.0] }}, {{ body = "flat", velocity = [1000.0, 0.0] }} ]
support = [ {{ on = "bottom" }}, {{ on = "ends", directions = ["x"] }},
            {{ on = "sides", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -18.5] }} ]
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
time.end = 1000
[wear]
on = ["face"]
coefficient = 1e-9
[wear.surfaces.face]
path = 100.0
)",
                     velocity_of_cap);
}

class PairRolling : public Fretting {
protected:
  void SetUp() override {
    Fretting::SetUp();
    if (IsSkipped()) return;
    folder_.write("rail.geo", rail(two_half_planes(16, 14, 1.32)));
  }
  /// With a surface from end to end of the block.
  static std::string rail(std::string bodies) {
    const std::string face = "Physical Curve(\"face\") = {4};", round = "Physical Curve(\"round\")";
    bodies.replace(bodies.find(face), face.size(),
                   "Physical Curve(\"face\") = {4, 5, 8}; Physical Curve(\"ends\") = {9, 11};");
    bodies.erase(bodies.find(round), round.size() + 8);
    return bodies;
  }
  /// With that of the cap, too.
  static std::string rail_and_tread(const std::string& bodies) {
    return rail(bodies) + "Physical Curve(\"tread\") = {24, 25, 28};\n";
  }
};

}  // namespace gnomon::testing
