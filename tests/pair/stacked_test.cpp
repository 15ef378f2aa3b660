// Bodies that only contact holds, on each other or on slopes: forces start them as displacements
// do.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <vector>

#include "part/part_scene.hpp"

namespace gnomon::stacked_test {
namespace {

using namespace testing;

/// Of four corners, from the lower left on, with a grid of elements. Its curves are "NAME below",
/// "NAME right", "NAME above" and "NAME left".
std::string quadrilateral(int first, const std::string& name,
                          const std::array<std::array<double, 2>, 4>& corners, int across, int up) {
  std::string text;
  for (int k = 0; k < 4; ++k)
    text += fmt::format("Point({}) = {{{}, {}, 0}};\n", first + k, corners[k][0], corners[k][1]);
  constexpr std::array<const char*, 4> sides = {"below", "right", "above", "left"};
  for (int k = 0; k < 4; ++k)
    text += fmt::format(
        "Line({0}) = {{{0}, {1}}}; Transfinite Curve {{{0}}} = {2};\n"
        "Physical Curve(\"{3} {4}\") = {{{0}}};\n",
        first + k, first + (k + 1) % 4, (k % 2 == 0 ? across : up) + 1, name, sides[k]);
  return text + fmt::format(
                    "Curve Loop({0}) = {{{0} : {1}}}; Plane Surface({0}) = {{{0}}};\n"
                    "Transfinite Surface {{{0}}}; Recombine Surface {{{0}}};\n"
                    "Physical Surface(\"{2}\") = {{{0}}};\n",
                    first, first + 3, name);
}

std::string body(const std::string& name) {
  return fmt::format(
      "{{ name = \"{}\", young_modulus = 1e5, poisson_ratio = 0.3, material = \"linear\" }}", name);
}

class Stacked : public PartScenes {
protected:
  /// At the start.
  double contact_force(const std::string& scene) {
    const auto model = this->model(scene);
    Counters counters;
    return observed(*model, model->start(counters), "contact_force");
  }
};

constexpr double degree = M_PI / 180;

// Three rings, whose surfaces rise by an angle, carry F / cos of it in each contact.
TEST_F(Stacked, RingsOfRevolutionLieOnEachOther) {
  for (const double angle : {1.0, 10.0, 30.0}) {
    const double rise = std::tan(angle * degree);
    const auto ring = [&](int first, const char* name, double r, double width, double z,
                          int across) {
      const double z0 = z + r * rise, z1 = z + (r + width) * rise;
      return quadrilateral(
          first, name, {{{r, z0}, {r + width, z1}, {r + width, z1 + 4}, {r, z0 + 4}}}, across, 3);
    };
    folder_.write("rings.geo", ring(1, "low", 9, 12, 0, 8) + ring(11, "middle", 10, 10, 4, 6) +
                                   ring(21, "high", 10, 10, 8, 5));
    EXPECT_NEAR(contact_force(fmt::format(R"(
problem = "worn_body"
mesh.file = "rings.geo"
model.plane = "axisymmetric"
body = [ {}, {}, {} ]
pair = [ {{ bodies = ["low", "middle"] }}, {{ bodies = ["middle", "high"] }} ]
support = [ {{ on = "low below" }} ]
load = [ {{ on = "high above", force = [0.0, -1000.0] }} ]
motion = [ {{ body = "middle", rotation = 10.0 }} ]
wear = {{ on = ["low above", "middle below", "middle above", "high below"], coefficient = 1e-8 }}
time.end = 10.0
)",
                                          body("low"), body("middle"), body("high"))),
                2000 / std::cos(angle * degree), 0.1)
        << angle;
  }
}

// A collet between a seat and a cone: surfaces at an angle to the axis carry F / sin of it.
TEST_F(Stacked, ConesOfRevolutionLieInEachOther) {
  const double slope = std::tan(20 * degree);
  const auto cone = [&](int first, const char* name, double r0, double r1, bool inner_follows,
                        bool outer_follows, int up) {
    const double rise = 10 * slope;
    return quadrilateral(first, name,
                         {{{r0, 0},
                           {r1, 0},
                           {r1 + (outer_follows ? rise : 0), 10},
                           {r0 + (inner_follows ? rise : 0), 10}}},
                         4, up);
  };
  folder_.write("cones.geo", cone(1, "seat", 20, 32, true, false, 8) +
                                 cone(11, "collet", 14, 20, true, true, 6) +
                                 cone(21, "plug", 4, 14, false, true, 5));
  EXPECT_NEAR(contact_force(fmt::format(R"(
problem = "worn_body"
mesh.file = "cones.geo"
model.plane = "axisymmetric"
body = [ {}, {}, {} ]
pair = [ {{ bodies = ["seat", "collet"] }}, {{ bodies = ["collet", "plug"] }} ]
support = [ {{ on = "seat right" }} ]
load = [ {{ on = "plug above", force = [0.0, -1000.0] }} ]
motion = [ {{ body = "collet", rotation = 10.0 }} ]
wear = {{ on = ["seat left", "collet right", "collet left", "plug right"], coefficient = 1e-8 }}
time.end = 10.0
)",
                                        body("seat"), body("collet"), body("plug"))),
              2000 / std::sin(20 * degree), 10);
}

// A wedge that is held along x, under a block whose top only may turn.
TEST_F(Stacked, AWedgeCarriesABlock) {
  const double slope = std::tan(15 * degree);
  folder_.write(
      "wedge.geo",
      quadrilateral(1, "base", {{{-20, -6}, {20, -6}, {20, 0}, {-20, 0}}}, 30, 6) +
          quadrilateral(11, "wedge", {{{-8, 0}, {8, 0}, {8, 4 - 8 * slope}, {-8, 4 + 8 * slope}}},
                        20, 6) +
          quadrilateral(21, "top", {{{-5, 4 + 5 * slope}, {5, 4 - 5 * slope}, {5, 12}, {-5, 12}}},
                        15, 8));
  EXPECT_NEAR(contact_force(fmt::format(R"(
problem = "worn_body"
mesh.file = "wedge.geo"
body = [ {}, {}, {} ]
pair = [ {{ bodies = ["base", "wedge"] }}, {{ bodies = ["wedge", "top"] }} ]
support = [ {{ on = "base below" }}, {{ on = "top above", directions = ["x"] }}, {{ on = "wedge left", directions = ["x"] }} ]
load = [ {{ on = "top above", force = [0.0, -100.0] }} ]
motion = [ {{ body = "wedge", velocity = [0.0, 0.0, 100.0] }} ]
wear = {{ on = ["base above", "wedge below", "wedge above", "top below"], coefficient = 1e-7 }}
time.end = 10.0
)",
                                        body("base"), body("wedge"), body("top"))),
              100 + 100 / std::cos(15 * degree), 0.05);
}

/// A block on an inclined plane, whose top only may turn.
std::string on_slope(const char* material) {
  return fmt::format(R"(
problem = "worn_body"
mesh.file = "slope.geo"
body = [ {{ name = "low", young_modulus = 1e5, poisson_ratio = 0.3, material = "{0}" }},
         {{ name = "up", young_modulus = 1e5, poisson_ratio = 0.3, material = "{0}" }} ]
pair = [ {{ bodies = ["low", "up"] }} ]
support = [ {{ on = "low below" }}, {{ on = "up above", directions = ["x"] }} ]
motion = [ {{ body = "low", velocity = [0.0, 0.0, 0.1] }} ]
wear = {{ on = ["low above", "up below"], coefficient = 0.0 }}
time.end = 10.0
)",
                     material);
}

/// `unit`: as a part of mm.
std::string slope(double angle, double unit) {
  const double rise = std::tan(angle * degree) * unit, u = unit;
  return quadrilateral(
             1, "low",
             {{{-12 * u, -6 * u}, {12 * u, -6 * u}, {12 * u, -12 * rise}, {-12 * u, 12 * rise}}},
             24, 6) +
         quadrilateral(11, "up",
                       {{{-5 * u, 5 * rise}, {5 * u, -5 * rise}, {5 * u, 8 * u}, {-5 * u, 8 * u}}},
                       15, 6);
}

// The force passes the middle of the contact by half of its half length.
TEST_F(Stacked, ABlockLiesOnASlope) {
  folder_.write("slope.geo", slope(20, 1));
  EXPECT_NEAR(contact_force(on_slope("linear") + R"(
load = [ { on = "up above", force = [0.0, -100.0] }, { on = "up above", moment = 0.0 } ]
)"),
              100 / std::cos(20 * degree), 0.01);
}

// In metres as in millimetres, with the same pressures.
TEST_F(Stacked, TheUnitOfLengthDoesNotMatter) {
  std::vector<long> iterations;
  for (const double unit : {1.0, 0x1p-10}) {
    folder_.write("slope.geo", slope(10, unit));
    const auto model = this->model(
        on_slope("neo-hookean") +
        fmt::format("load = [ {{ on = \"up above\", force = [0.0, {}] }} ]", -100 * unit));
    Counters counters;
    EXPECT_NEAR(observed(*model, model->start(counters), "contact_force") / unit,
                100 / std::cos(10 * degree), 0.2);
    iterations.push_back(counters.newton_iterations);
  }
  EXPECT_EQ(iterations[0], iterations[1]);
}

}  // namespace
}  // namespace gnomon::stacked_test
