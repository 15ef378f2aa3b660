// Scenes of fretting for tests: a cylinder on a half-plane, and a block on a bed of springs.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "part/part_scene.hpp"

namespace gnomon::testing {

/// A square of equal elements where a cylinder touches, 2 * `half` along the surface, and graded
/// layers around it.
inline std::string half_plane(int half, int layers, double growth) {
  return fmt::format(R"(b = 0.045; w = 2; n = {}; m = {}; r = {};
Point(1) = {{-b, 0, 0}}; Point(2) = {{-b, -b, 0}}; Point(3) = {{b, -b, 0}}; Point(4) = {{b, 0, 0}};
Point(5) = {{-w, 0, 0}}; Point(6) = {{-w, -w, 0}}; Point(7) = {{w, -w, 0}}; Point(8) = {{w, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Line(5) = {{1, 5}}; Line(6) = {{2, 6}}; Line(7) = {{3, 7}}; Line(8) = {{4, 8}};
Line(9) = {{5, 6}}; Line(10) = {{6, 7}}; Line(11) = {{7, 8}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Curve Loop(2) = {{5, 9, -6, -1}}; Plane Surface(2) = {{2}};
Curve Loop(3) = {{6, 10, -7, -2}}; Plane Surface(3) = {{3}};
Curve Loop(4) = {{7, 11, -8, -3}}; Plane Surface(4) = {{4}};
Transfinite Curve {{2, 4, 10}} = 2 * n + 1;
Transfinite Curve {{1, 3, 9, 11}} = n + 1;
Transfinite Curve {{5, 6, 7, 8}} = m + 1 Using Progression r;
Transfinite Surface {{1}}; Transfinite Surface {{2}};
Transfinite Surface {{3}}; Transfinite Surface {{4}};
Recombine Surface {{1, 2, 3, 4}};
Physical Curve("bottom") = {{10}}; Physical Curve("surface") = {{4}};
Physical Surface("flat") = {{1, 2, 3, 4}};
)",
                     half, layers, growth);
}

/// Of a rigid cylinder on an incompressible half-plane: normal and tangential displacements are
/// uncoupled, as those of similar bodies (K. L. Johnson, Contact Mechanics, sec. 7.2).
struct Cattaneo {
  static constexpr double E = 1e5, nu = 0.4999, R = 6, P = 18.5, f = 0.6, ratio = 0.6, k = 2.9e-8;
  static double modulus() { return E / (1 - nu * nu); }
  static double a() { return std::sqrt(4 * P * R / (M_PI * modulus())); }
  static double p0() { return 2 * P / (M_PI * a()); }
  static double c() { return a() * std::sqrt(1 - ratio); }  ///< half width of stick
  static double elliptic(double half, double x) {
    return p0() / a() * std::sqrt(std::max(0.0, half * half - x * x));
  }
  /// At the largest force.
  static double traction(double x) { return f * (elliptic(a(), x) - elliptic(c(), x)); }
  /// Gap under the load P (1 - ratio).
  static double gap(double x) {
    const double xi = std::max(1.0, std::abs(x) / c());
    return c() * c() / (2 * R) * (xi * std::sqrt(xi * xi - 1) - std::acosh(xi));
  }
  /// Worn area per cycle, the integral of 4 k f p g.
  static double worn_per_cycle() {
    constexpr int parts = 20000;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
      const double x = c() + (a() - c()) * (i + 0.5) / parts;
      sum += 4 * k * f * elliptic(a(), x) * gap(x);
    }
    return 2 * sum * (a() - c()) / parts;
  }
};

/// A block in space, cut at its plane of symmetry y = 0.
inline constexpr const char* half_block = R"(SetFactory("OpenCASCADE");
Box(1) = {-0.2, 0, -0.2, 0.4, 0.2, 0.2};
Transfinite Curve {1, 2, 3, 4, 5, 6, 7, 8} = 4; Transfinite Curve {9, 10, 11, 12} = 7;
Transfinite Surface "*"; Transfinite Volume {1}; Recombine Surface "*";
Physical Surface("symmetry") = {3}; Physical Surface("bottom") = {5};
Physical Surface("surface") = {6}; Physical Volume("block") = {1};
)";

class Fretting : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    if (IsSkipped()) return;
    folder_.write("flat.geo", half_plane(18, 16, 1.28));
    folder_.write("coarse.geo", half_plane(4, 4, 3));
    folder_.write("block.geo", R"(Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0};
Point(3) = {1, 0.1, 0}; Point(4) = {0, 0.1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 5; Transfinite Curve {2, 4} = 3;
Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Surface("block") = {1};
)");
  }

  void expect_refused(const std::string& text, const Overrides& overrides,
                      const std::string& part) const {
    EXPECT_THAT(refusal(text, overrides), ::testing::HasSubstr(part));
  }
  /// Elastic slip takes away its part of the stroke, of first order in their ratio. `kept`: the
  /// wear with an amplitude by that of gross sliding.
  static void expect_loss_of_first_order(const std::function<double(double amplitude)>& kept) {
    const double lost = 1 - kept(0.004), of_twice = 1 - kept(0.008);
    EXPECT_GT(of_twice, 0.01);
    EXPECT_NEAR(lost / of_twice, 2, 0.1);
  }
  /// Driven by a tangential force, or by what `cycle` says instead.
  static std::string cylinder(const std::string& drive = "", double nu = Cattaneo::nu) {
    const std::string force = fmt::format(
        "[[counter_body.press]]\ndirection = [1.0, 0.0]\nforce = {}\ncycle = \"sin(2*pi*tau)\"\n",
        Cattaneo::ratio * Cattaneo::f * Cattaneo::P);
    return fmt::format(R"(problem = "worn_body"
mesh.file = "flat.geo"
body = {{ young_modulus = 1e5, poisson_ratio = {}, material = "linear" }}
support = [ {{ on = "bottom" }} ]
friction = {{ coefficient = 0.6, stick = true }}
wear = {{ on = ["surface"], coefficient = 2.9e-8 }}
time.cycles = 1000
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
[counter_body]
shape = "cylinder"
radius = 6.0
center = [0.0, 6.0]
[[counter_body.press]]
direction = [0.0, -1.0]
force = 18.5
{}
[cycle]
period = 1.0
phases = 4
{}
)",
                       nu, drive.empty() ? force : "", drive);
  }

  /// A plane that moves by 0.01 mm to and fro on a stiff block, which springs hold: per area
  /// 1e4 MPa/mm; pressed by 20 N/mm on 1 mm.
  static std::string bed(const std::string& drive = "x = \"0.01 * sin(2*pi*tau)\"") {
    return fmt::format(R"(problem = "worn_body"
mesh.file = "block.geo"
body = {{ young_modulus = 1e9, poisson_ratio = 0.0, material = "linear" }}
support = [ {{ on = "bottom", stiffness = 1e4 }} ]
friction = {{ coefficient = 0.5, stick = true }}
wear = {{ on = ["top"], coefficient = 1e-9 }}
time.cycles = 1e6
integrator = {{ name = "esdirk-3", rtol = 1e-4 }}
[counter_body]
shape = "plane"
center = [0.0, 0.1]
normal = [0.0, -1.0]
press = {{ direction = [0.0, -1.0], force = 20.0 }}
[cycle]
period = 1.0
phases = 4
{}
)",
                       drive);
  }
};

/// A state beside the start of a path, with its branches, of which some are open and some closed.
inline std::pair<std::vector<double>, ActiveSet> near_the_start(const Model& model) {
  Counters counters;
  std::vector<double> y = model.start(counters).y;
  const Structure& structure = model.system().structure();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.05 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  const ActiveSet branch = active_set(model.system(), 0, y);
  EXPECT_GT(std::ranges::count(branch, 1), 4);
  EXPECT_GT(std::ranges::count(branch, 0), 4);
  return {y, branch};
}

/// Of a contact surface, the row of a phase: one component at each node.
inline std::vector<double> of_phase(const ContactSurface& surface,
                                    const std::vector<double>& values, std::size_t phase,
                                    std::size_t component) {
  const std::size_t nodes = surface.node.size(), dim = static_cast<std::size_t>(surface.dim);
  std::vector<double> result;
  for (std::size_t c = 0; c < nodes; ++c)
    result.push_back(values[(phase * nodes + c) * dim + component]);
  return result;
}

}  // namespace gnomon::testing
