// Parts with oblique sides: tapered pins, whole or turned, that a plane wears.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::testing {

using Point2 = std::array<double, 2>;

inline Point2 turned(const Point2& x, double angle) {
  return {std::cos(angle) * x[0] - std::sin(angle) * x[1],
          std::sin(angle) * x[0] + std::cos(angle) * x[1]};
}

inline std::string direction(double x, double y, double angle) {
  const auto [u, v] = turned({x, y}, angle);
  return fmt::format("[{}, {}]", u, v);
}

/// A quadrangle of n x n elements; its corners follow each other from the lower left one. The right
/// side has no name.
inline std::string quadrangle(const std::array<Point2, 4>& corners, double angle = 0, int n = 6) {
  std::string text = fmt::format("n = {};\n", n);
  for (int k = 0; k < 4; ++k) {
    const auto [x, y] = turned(corners[k], angle);
    text += fmt::format("Point({}) = {{{}, {}, 0}};\n", k + 1, x, y);
  }
  return text + R"(
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = n + 1;
Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("face") = {1}; Physical Curve("top") = {3}; Physical Curve("flank") = {4};
Physical Surface("pin") = {1};
)";
}

/// A quarter of a pyramid's frustum with the symmetry planes x = 0 and y = 0; two sides are
/// oblique.
inline std::string frustum(double a, double taper, double height, int n) {
  std::string text = fmt::format("n = {};\n", n);
  int point = 0;
  for (double z : {0.0, height})
    for (const Point2& at : {Point2{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      text += fmt::format("Point({}) = {{{}, {}, {}}};\n", ++point, at[0] * (a + taper * z),
                          at[1] * (a + taper * z), z);
  return text + R"(
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {1, 5}; Line(10) = {2, 6}; Line(11) = {3, 7}; Line(12) = {4, 8};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8};
Curve Loop(3) = {1, 10, -5, -9}; Curve Loop(4) = {2, 11, -6, -10};
Curve Loop(5) = {3, 12, -7, -11}; Curve Loop(6) = {4, 9, -8, -12};
For k In {1:6}
  Plane Surface(k) = {k};
EndFor
Surface Loop(1) = {1:6}; Volume(1) = {1};
Transfinite Curve {1:12} = n + 1;
Transfinite Surface {1:6}; Recombine Surface {1:6}; Transfinite Volume {1};
Physical Surface("face") = {1}; Physical Surface("top") = {2};
Physical Surface("front") = {3}; Physical Surface("side") = {6};
Physical Volume("pin") = {1};
)";
}

inline constexpr double k = 1e-6, speed = 100, force = 40, end = 1000;
inline constexpr double worn = k * speed * force * end;

/// Held at its top, a plane rubs its face; so stiff that the face stays plane to 1e-6.
inline std::string tapered_scene(const std::string& further) {
  return fmt::format(R"(
problem = "worn_body"
mesh.file = "pin.geo"
body.young_modulus = 1e7
body.poisson_ratio = 0.3
wear.on = ["face"]
wear.coefficient = {}
wear.rate = "k * p * v"
time.end = {}
integrator.name = "esdirk-3"
{}
)",
                     k, end, further);
}

inline std::string support(const std::string& on, const std::string& directions = "") {
  return fmt::format("[[support]]\non = \"{}\"\n{}\n", on,
                     directions.empty() ? "" : "directions = " + directions);
}

inline std::string plane(const std::string& normal, const std::string& motion) {
  return fmt::format(R"(
[counter_body]
shape = "plane"
normal = {}
motion = {{ {} }}
press = {{ direction = {}, force = {} }}
)",
                     normal, motion, normal, force);
}

inline constexpr double taper = 0.4, a = 2, height = 4;

class TaperedParts : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }

  std::unique_ptr<Model> part(const std::string& geometry, const std::string& text,
                              const Overrides& overrides = {}) {
    folder_.write("pin.geo", geometry);
    return make_model(load_scene(folder_.write("pin.toml", text), overrides, key_table));
  }
  std::unique_ptr<Model> tapered(const Overrides& overrides = {}) {
    return part(
        quadrangle(
            {{{-a, 0}, {a, 0}, {a + taper * height, height}, {-a - taper * height, height}}}),
        tapered_scene(support("top") + plane("[0, 1]", "velocity = [100.0, 0.0]")), overrides);
  }
  std::unique_ptr<Model> cone(const Overrides& overrides = {}) {
    return part(quadrangle({{{0, 0}, {a, 0}, {a + taper * height, height}, {0, height}}}),
                tapered_scene("model.plane = \"axisymmetric\"\n" + support("top") +
                              plane("[0, 1]", "velocity = [0.0, 0.0, 100.0]")),
                overrides);
  }
  std::unique_ptr<Model> pyramid(const Overrides& overrides = {}, int n = 3) {
    return part(
        frustum(a, taper, height, n),
        tapered_scene(support("top") + support("front", "[\"y\"]") + support("side", "[\"x\"]") +
                      plane("[0, 0, 1]", "velocity = [100.0, 0.0, 0.0]")),
        overrides);
  }

private:
  SceneFolder folder_;
};

inline std::vector<double> shape_of(const Model& model, const State& state) {
  const std::vector<GridField> fields = model.fields(state);
  return std::ranges::find(fields, std::string("shape"), &GridField::name)->values;
}

}  // namespace gnomon::testing
