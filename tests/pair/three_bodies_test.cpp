// A body between two others, and one whose track passes below two others.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "part/part_scene.hpp"

namespace gnomon::three_bodies_test {
namespace {

using namespace testing;

/// Half of a roller of radius 5 between two plates, symmetric about x = 0.
constexpr const char* geometry = R"(
f = 0.03;
Point(1) = {0, 0, 0, f}; Point(2) = {0, 5, 0, 1}; Point(3) = {5, 5, 0, 1}; Point(4) = {0, 10, 0, f};
Circle(1) = {1, 2, 3}; Circle(2) = {3, 2, 4}; Line(3) = {4, 2}; Line(4) = {2, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, f}; Point(12) = {6, 0, 0, 1}; Point(13) = {6, -4, 0, 1};
Point(14) = {0, -4, 0, 1};
Line(11) = {11, 14}; Line(12) = {14, 13}; Line(13) = {13, 12}; Line(14) = {12, 11};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Point(21) = {0, 10, 0, f}; Point(22) = {6, 10, 0, 1}; Point(23) = {6, 14, 0, 1};
Point(24) = {0, 14, 0, 1};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(21) = {21 : 24}; Plane Surface(21) = {21};
Physical Surface("roller") = {1}; Physical Surface("lower") = {11};
Physical Surface("upper") = {21}; Physical Curve("round") = {1, 2}; Physical Curve("face") = {14};
Physical Curve("ceiling") = {21}; Physical Curve("base") = {12}; Physical Curve("top") = {23};
Physical Curve("axes") = {3, 4, 11, 24};
)";

constexpr const char* scene = R"(
problem = "worn_body"
[mesh]
file = "three.geo"
[[body]]
name = "roller"
young_modulus = 2e5
poisson_ratio = 0.3
[[body]]
name = "lower"
young_modulus = 2e5
poisson_ratio = 0.3
[[body]]
name = "upper"
young_modulus = 2e5
poisson_ratio = 0.3
[[pair]]
bodies = ["roller", "lower"]
[[pair]]
bodies = ["roller", "upper"]
[[motion]]
body = "roller"
velocity = [0.0, 0.0, 100.0]
[[support]]
on = "base"
[[support]]
on = "axes"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -100.0]
[wear]
on = ["round", "face", "ceiling"]
coefficient = 1e-9
[time]
end = 100.0
)";

class ThreeBodies : public PartScenes {};

// The roller rubs on both plates; each contact is that of Hertz. Two contacts have no common width.
TEST_F(ThreeBodies, ARollerWearsOnBothSides) {
  folder_.write("three.geo", geometry);
  const auto model = this->model(scene, {});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 100);
  const double work = 100 * 100 * 100;  // of half of the roller
  for (const auto& [body, part] :
       std::map<std::string, double>{{"roller", 2}, {"lower", 1}, {"upper", 1}})
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume_" + body) / (part * 1e-9 * work), 1,
                5e-3);
  const double a = std::sqrt(4 * 200 * 5 * 2 * (1 - 0.09) / (M_PI * 2e5));
  EXPECT_NEAR(observed(*model, run.states.front(), "max_pressure") * M_PI * a / (2 * 200), 1, 0.1);
  EXPECT_FALSE(value_of(model->observe(run.last()), "contact_half_width"));
}

/// A ring of radius 20 below a shoe, and above a narrower one.
constexpr const char* drum_geometry = R"(
f = 1;
Point(1) = {0, 0, 0};
Point(2) = {20, 0, 0, f}; Point(3) = {0, 20, 0, f}; Point(4) = {-20, 0, 0, f};
Point(5) = {0, -20, 0, f};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Point(6) = {14, 0, 0, 3}; Point(7) = {0, 14, 0, 3}; Point(8) = {-14, 0, 0, 3};
Point(9) = {0, -14, 0, 3};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Curve Loop(1) = {1 : 4}; Curve Loop(2) = {5 : 8}; Plane Surface(1) = {1, 2};
Point(10) = {-5, 20, 0, f}; Point(11) = {5, 20, 0, f}; Point(12) = {5, 26, 0, f};
Point(13) = {-5, 26, 0, f};
Line(10) = {10, 11}; Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 10};
Curve Loop(3) = {10 : 13}; Plane Surface(2) = {3};
Point(20) = {-4, -20, 0, f}; Point(21) = {4, -20, 0, f}; Point(22) = {4, -26, 0, f};
Point(23) = {-4, -26, 0, f};
Line(20) = {20, 21}; Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 20};
Curve Loop(4) = {20 : 23}; Plane Surface(3) = {4};
Physical Surface("drum") = {1}; Physical Surface("upper") = {2}; Physical Surface("lower") = {3};
Physical Curve("rim") = {1 : 4}; Physical Curve("hub") = {5 : 8};
Physical Curve("upper pad") = {10}; Physical Curve("top") = {12};
Physical Curve("lower pad") = {20}; Physical Curve("bottom") = {22};
Physical Curve("sides") = {11, 13, 21, 23};
)";

constexpr const char* drum_scene = R"(
problem = "worn_body"
[mesh]
file = "drum.geo"
[[body]]
name = "drum"
young_modulus = 2e6
poisson_ratio = 0.3
[[body]]
name = "upper"
young_modulus = 3e5
poisson_ratio = 0.3
[[body]]
name = "lower"
young_modulus = 3e5
poisson_ratio = 0.3
[[pair]]
bodies = ["upper", "drum"]
[[pair]]
bodies = ["lower", "drum"]
[[motion]]
body = "drum"
rotation = 20.0
center = [0.0, 0.0]
[[support]]
on = "hub"
[[support]]
on = "sides"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -100.0]
[[load]]
on = "bottom"
force = [0.0, 150.0]
[wear]
on = ["upper pad", "lower pad", "rim"]
[wear.surfaces."upper pad"]
coefficient = 1e-8
[wear.surfaces."lower pad"]
coefficient = 2e-8
[wear.surfaces.rim]
coefficient = 1e-7
path = 125.6637
[time]
end = 1e4
)";

/// A rectangle with a grid of this many elements. `names`: of its curves first, ..., first + 3,
/// from the lower one on.
std::string block(int first, std::array<double, 2> x, std::array<double, 2> y, int across, int up,
                  const std::string& names) {
  return fmt::format(R"(Point({0}) = {{{4}, {6}, 0}}; Point({1}) = {{{5}, {6}, 0}};
Point({2}) = {{{5}, {7}, 0}}; Point({3}) = {{{4}, {7}, 0}};
Line({0}) = {{{0}, {1}}}; Line({1}) = {{{1}, {2}}}; Line({2}) = {{{2}, {3}}}; Line({3}) = {{{3}, {0}}};
Curve Loop({0}) = {{{0} : {3}}}; Plane Surface({0}) = {{{0}}};
Transfinite Curve {{{0}, {2}}} = {8}; Transfinite Curve {{{1}, {3}}} = {9};
Transfinite Surface {{{0}}}; Recombine Surface {{{0}}};
{10}
)",
                     first, first + 1, first + 2, first + 3, x[0], x[1], y[0], y[1], across + 1,
                     up + 1, names);
}

constexpr const char* three_blocks = R"toml(problem = "worn_body"
body = [ { name = "one", young_modulus = 3e3, poisson_ratio = 0.3, material = "linear" },
         { name = "plate", young_modulus = 7e4, poisson_ratio = 0.3, material = "linear" },
         { name = "two", young_modulus = 2e3, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["one", "plate"], friction = 0.1 }, { bodies = ["plate", "two"], friction = 0.2 } ]
motion = [ { body = "plate", velocity = [50.0, 0.0] } ]
time.end = 1000
)toml";

class ThreeBlocks : public ThreeBodies {
protected:
  /// What each wears, by k N v t.
  void expect_worn(const std::string& scene, double one, double plate, double two) {
    const auto model = this->model(three_blocks + scene, {});
    const State end = run_model(*model, "esdirk-3", 0, 1e-3, 1000).last();
    for (const auto& [body, k_N] : {std::pair{"one", one}, {"plate", plate}, {"two", two}})
      EXPECT_NEAR(observed(*model, end, std::string("worn_volume_") + body) / (k_N * 50 * 1000), 1,
                  1e-3)
          << body;
  }
};

/// Edges of the blocks lie on nodes of the plate, and move over them as the blocks shear.
TEST_F(ThreeBlocks, APlateWearsBetweenTwo) {
  folder_.write(
      "stack.geo",
      block(1, {-6, 6}, {-5, 0}, 24, 6,
            "Physical Surface(\"one\") = {1}; Physical Curve(\"base\") = {1};\n"
            "Physical Curve(\"below\") = {3};") +
          block(11, {-15, 15}, {0, 3}, 75, 4,
                "Physical Surface(\"plate\") = {11}; Physical Curve(\"lower\") = {11};\n"
                "Physical Curve(\"upper\") = {13}; Physical Curve(\"ends\") = {12, 14};") +
          block(21, {-5, 5}, {3, 7}, 20, 5,
                "Physical Surface(\"two\") = {21}; Physical Curve(\"above\") = {21};\n"
                "Physical Curve(\"press\") = {23};"));
  expect_worn(R"(mesh.file = "stack.geo"
support = [ { on = "base" }, { on = "ends", directions = ["x"] }, { on = "press", directions = ["x"] } ]
load = [ { on = "press", force = [0.0, -20.0] } ]
wear.on = ["below", "lower", "upper", "above"]
wear.surfaces = { below = { coefficient = 1e-8 }, lower = { coefficient = 2e-8 }, upper = { coefficient = 3e-8 }, above = { coefficient = 5e-8 } }
)",
              1e-8 * 20, 5e-8 * 20, 5e-8 * 20);
}

/// A surface below two blocks is divided between them.
TEST_F(ThreeBlocks, APlateWearsBelowTwo) {
  const std::string blocks =
      block(1, {-9, -3}, {0, 4}, 12, 5,
            "Physical Surface(\"one\") = {1}; Physical Curve(\"sole 1\") = {1};\n"
            "Physical Curve(\"top 1\") = {3};") +
      block(21, {3, 9}, {0, 4}, 12, 5,
            "Physical Surface(\"two\") = {21}; Physical Curve(\"sole 2\") = {21};\n"
            "Physical Curve(\"top 2\") = {23};");
  for (const int across : {75, 40}) {  // the plate's mesh is the finer one, or the coarser
    folder_.write("pads.geo", blocks + block(11, {-15, 15}, {-3, 0}, across, 4,
                                             "Physical Surface(\"plate\") = {11};\n"
                                             "Physical Curve(\"base\") = {11};\n"
                                             "Physical Curve(\"face\") = {13};"));
    expect_worn(R"(mesh.file = "pads.geo"
support = [ { on = "base" }, { on = "top 1", directions = ["x"] }, { on = "top 2", directions = ["x"] } ]
load = [ { on = "top 1", force = [0.0, -20.0] }, { on = "top 2", force = [0.0, -40.0] } ]
wear.on = ["face", "sole 1", "sole 2"]
wear.surfaces = { face = { coefficient = 1e-8 }, "sole 1" = { coefficient = 2e-8 }, "sole 2" = { coefficient = 3e-8 } }
)",
                2e-8 * 20, 1e-8 * 60, 3e-8 * 40);
  }
}

// By k F v t, and what the rim loses under each shoe is what this loses by the ratio of their k.
TEST_F(ThreeBodies, TwoShoesWearOneDrum) {
  folder_.write("drum.geo", drum_geometry);
  const auto model = this->model(drum_scene, {});
  const State end = run_model(*model, "esdirk-3", 0, 1e-3, 1e4).last();
  const double drum = observed(*model, end, "worn_volume_drum"),
               upper = observed(*model, end, "worn_volume_upper"),
               lower = observed(*model, end, "worn_volume_lower");
  EXPECT_NEAR(drum / (10 * upper + 5 * lower), 1, 5e-5);
  // Pressures on the arcs of the pads sum up to more than the forces, by 1 % at the end.
  const double time = 1e4, radius = 20 - 1e-7 * 250 * 20 * time / (2 * M_PI),
               speed = 20 * (20 + radius) / 2;
  EXPECT_NEAR(drum / (M_PI * (400 - radius * radius)), 1, 0.01);
  EXPECT_NEAR(upper / (1e-8 * 100 * speed * time), 1, 0.01);
  EXPECT_NEAR(lower / (2e-8 * 150 * speed * time), 1, 0.01);
  EXPECT_LT(model->examine(end).lost_wear, 1e-12);
}

}  // namespace
}  // namespace gnomon::three_bodies_test
