// Parts from geometry files: the built-in pin again, the block on a ring against the rigid limit,
// and the model that a result's mesh gives.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "part/part_scene.hpp"
#include "support/pin.hpp"

namespace gnomon::worn_body_test {
namespace {

using namespace testing;

class Parts : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
};

Scene scene_of(const std::filesystem::path& file, const Overrides& overrides = {}) {
  return load_scene(file, overrides, key_table);
}

std::unique_ptr<Model> part_of(const std::filesystem::path& file, const Overrides& overrides = {}) {
  return make_model(scene_of(file, overrides));
}

// The same nodes, supports and loads give the same results, whatever file they come from.
TEST_F(Parts, ThePinFromItsGeometryIsTheBuiltInOne) {
  const SceneFolder folder;
  folder.write("pin.geo", "n = 10;\n" + text_of(shipped("pin.geo")));
  const auto scene = folder.write("pin.toml", text_of(shipped("pin.toml")));
  const auto part = part_of(scene);
  const auto pin = pin_model({elements(10)});
  const ModelRun expected = run_model(*pin, "backward-euler", 50, 1e-4, 300),
                 actual = run_model(*part, "backward-euler", 50, 1e-4, 300);
  const ContactSurface built_in = pin->contact(expected.last()).value(),
                       from_file = part->contact(actual.last()).value();
  ASSERT_EQ(from_file.node.size(), built_in.node.size());
  EXPECT_GT(observed(*pin, expected.last(), "worn_volume"), 0.5);
  const double peak = std::ranges::max(built_in.pressure);
  for (std::size_t c = 0; c < built_in.node.size(); ++c) {
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(from_file.worn[c][i], built_in.worn[c][i], 1e-9) << "node " << c;
    EXPECT_NEAR(from_file.pressure[c], built_in.pressure[c], 1e-9 * peak) << "node " << c;
  }
}

// The published runs lose up to 1.25 % of the worn area (Cruzado 2010, by two other programs).
TEST_F(Parts, BlockOnRingLosesWhatWearsAndFollowsTheRigidLimit) {
  const auto block = part_of(shipped("block_on_ring.toml"), {"mesh.factor=2"});
  const double end = 7200, worn = 2e-9 * 10.8333 * 500 * end, R = 20;
  const ModelRun run = run_model(*block, "esdirk-3", 0, 1e-3, end);
  EXPECT_NEAR(observed(*block, run.last(), "worn_volume") / worn, 1, 5e-6);
  const double half_width = std::cbrt(1.5 * R * worn), depth = half_width * half_width / (2 * R);
  double deepest = 0;
  const ContactSurface surface = block->contact(run.last()).value();
  for (const auto& X : surface.worn) deepest = std::max(deepest, -X[1]);
  EXPECT_NEAR(deepest / depth, 1, 3e-3);
  EXPECT_NEAR(observed(*block, run.last(), "contact_half_width") / half_width, 1, 1e-2);
}

// The surface of a turning ring moves with omega times the distance from its axis: what slides at
// the bottom of the scar, nearer to the ring's level, is slower by its depth over the radius alone.
TEST_F(Parts, ATurningRingWearsByTheSpeedOfItsSurface) {
  const auto worn = [](const std::string& motion) {
    const auto block = part_of(shipped("block_on_ring.toml"), {"mesh.factor=3", motion});
    const ModelRun run = run_model(*block, "esdirk-3", 0, 1e-3, 720);
    return observed(*block, run.last(), "worn_volume");
  };
  const double sliding = worn("counter_body.motion.velocity=[500.0, 0.0]");
  const SceneFolder folder;
  std::string text = text_of(shipped("block_on_ring.toml"));
  const std::string straight = "motion = { velocity = [500.0, 0.0] }";
  ASSERT_NE(text.find(straight), std::string::npos);
  text.replace(text.find(straight), straight.size(), "motion = { rotation = 25.0 }");
  folder.write("block_on_ring.geo", text_of(shipped("block_on_ring.geo")));
  const auto block = part_of(folder.write("turning.toml", text), {"mesh.factor=3"});
  const ModelRun run = run_model(*block, "esdirk-3", 0, 1e-3, 720);
  EXPECT_NEAR(observed(*block, run.last(), "worn_volume") / sliding, 1, 1e-4);
}

// The counter-body's force has a history of its own: wear follows its integral.
TEST_F(Parts, WearFollowsTheHistoryOfTheForce) {
  const double end = 300;
  const auto block =
      part_of(shipped("block_on_ring.toml"), {"mesh.factor=3", "time.end=300", "output.times=[]",
                                              "counter_body.press.times=[0.0, 100.0, 300.0]",
                                              "counter_body.press.factors=[1.0, 1.0, 3.0]"});
  const ModelRun run = run_model(*block, "esdirk-3", 0, 1e-3, end);
  const double impulse = 10.8333 * (100 + 2 * 200);
  EXPECT_NEAR(observed(*block, run.last(), "worn_volume") / (2e-9 * 500 * impulse), 1, 1e-5);
  EXPECT_NEAR(observed(*block, run.last(), "contact_force") / (3 * 10.8333), 1, 1e-2);
}

// A ring on a plane from four sides: wherever the seams of its wearing surfaces are, and the node
// with which their numbers begin, the contact is as wide.
TEST_F(Parts, TheWidthOfContactDoesNotDependOnSeams) {
  const SceneFolder folder;
  folder.write("ring.geo", R"(n = 48; R = 10; r = 6;
Point(1) = {0, 0, 0};
For k In {0:3}
  Point(10 + k) = {R * Cos(k * Pi / 2), R * Sin(k * Pi / 2), 0};
  Point(20 + k) = {r * Cos(k * Pi / 2), r * Sin(k * Pi / 2), 0};
EndFor
For k In {0:3}
  j = (k < 3) ? k + 1 : 0;
  Circle(10 + k) = {10 + k, 1, 10 + j};
  Circle(20 + k) = {20 + k, 1, 20 + j};
  Line(30 + k) = {20 + k, 10 + k};
EndFor
For k In {0:3}
  j = (k < 3) ? k + 1 : 0;
  Curve Loop(k + 1) = {30 + k, 10 + k, -(30 + j), -(20 + k)};
  Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {10, 11, 12, 13, 20, 21, 22, 23} = n + 1;
Transfinite Curve {30, 31, 32, 33} = 9;
Transfinite Surface {1, 2, 3, 4};
Recombine Surface {1, 2, 3, 4};
Physical Curve("inner") = {20, 21, 22, 23};
Physical Curve("a") = {10};
Physical Curve("b") = {11};
Physical Curve("c") = {12};
Physical Curve("d") = {13};
Physical Surface("ring") = {1, 2, 3, 4};
)");
  const auto half_width = [&](double x, double y, const std::string& surfaces) {
    const auto scene = folder.write(
        "ring.toml",
        fmt::format("problem = \"worn_body\"\n[mesh]\nfile = \"ring.geo\"\n[body]\n"
                    "young_modulus = 1000.0\npoisson_ratio = 0.3\n[[support]]\non = \"inner\"\n"
                    "[counter_body]\nshape = \"plane\"\ncenter = [{0}, {1}]\nnormal = [{2}, {3}]\n"
                    "press = {{ direction = [{2}, {3}], force = 100.0 }}\n[wear]\non = [{4}]\n"
                    "coefficient = 0.0\n[time]\nend = 1.0\n[integrator]\n"
                    "name = \"backward-euler\"\n",
                    10 * x, 10 * y, -x, -y, surfaces));
    const auto model = part_of(scene);
    Counters counters;
    return observed(*model, model->start(counters), "contact_half_width");
  };
  const std::string all = R"("a", "b", "c", "d")";
  const double at_seam = half_width(1, 0, all);
  EXPECT_NEAR(at_seam, std::sqrt(4 * 100 * 10 * (1 - 0.09) / (std::numbers::pi * 1000)), 0.1);
  for (const auto& [x, y] : {std::pair(0.0, 1.0), {-1.0, 0.0}, {0.0, -1.0}})
    EXPECT_NEAR(half_width(x, y, all), at_seam, 1e-6) << x << ", " << y;
  EXPECT_NEAR(half_width(1, 0, R"("d", "a")"), at_seam, 1e-6);
  EXPECT_NEAR(half_width(1, 0, R"("a", "d")"), at_seam, 1e-6);
}

TEST_F(Parts, InSpaceAreNotOfRevolution) {
  const Scene scene =
      load_scene(shipped("pin_on_disc.toml"), {"model.plane=axisymmetric"}, key_table);
  EXPECT_THAT(
      [&] { make_model(scene); },
      ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("expected a mesh in the plane")));
}

// What a result keeps is enough to make the same equations again.
TEST_F(Parts, AreMadeAgainFromTheMeshOfTheirResult) {
  const Scene scene = scene_of(shipped("block_on_ring.toml"), {"mesh.factor=4"});
  const auto first = make_model(scene);
  const auto second = remake_model(scene, first->grid);
  Counters counters;
  const State start = first->start(counters);
  std::vector<double> F(start.y.size()), again(start.y.size());
  ASSERT_EQ(first->system().structure().size, second->system().structure().size);
  first->system().residual({0, start.y, start.ydot}, F);
  second->system().residual({0, start.y, start.ydot}, again);
  EXPECT_EQ(F, again);
}

// A flat ring, 2 mm to 4 mm, that stands on springs of 10 MPa/mm: they carry by the area of the
// whole circumference, 12 pi mm^2, beside which the body is rigid.
TEST_F(Parts, SpringsOfABodyOfRevolutionCarryByItsCircumference) {
  const SceneFolder folder;
  folder.write("ring.geo", R"(
Point(1) = {2, 0, 0, 0.5}; Point(2) = {4, 0, 0, 0.5}; Point(3) = {4, 1, 0, 0.5};
Point(4) = {2, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Surface("ring") = {1};
)");
  const auto ring = part_of(folder.write("ring.toml", R"(
problem = "worn_body"
mesh.file = "ring.geo"
model.plane = "axisymmetric"
body = { young_modulus = 1e7, poisson_ratio = 0.3 }
support = [{ on = "top", directions = ["z"], stiffness = 10.0 }]
[counter_body]
shape = "plane"
motion = { velocity = [0.0, 0.0, 1.0] }
press = { direction = [0.0, 1.0], force = 100.0 }
[wear]
on = ["bottom"]
coefficient = 0.0
[time]
end = 1.0
[integrator]
name = "bdf"
)"),
                            {});
  const ModelRun run = run_model(*ring, "bdf", 0, 1e-3, 1);
  EXPECT_NEAR(observed(*ring, run.last(), "approach"), 100 / (10 * 12 * std::numbers::pi), 1e-5);
}

// A column of 2 mm on springs whose other ends move towards a rigid plane that it touches: springs
// and column are in series, p = u / (1 / k + H / E) without lateral strain.
TEST_F(Parts, SpringsThatAreMovedPress) {
  const SceneFolder folder;
  folder.write("column.geo", R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 2, 0, 0.5};
Point(4) = {0, 2, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Curve("side") = {4};
Physical Surface("column") = {1};
)");
  const auto column = part_of(folder.write("column.toml", R"(
problem = "worn_body"
mesh.file = "column.geo"
body = { young_modulus = 1000.0, poisson_ratio = 0.0, material = "linear" }
[[support]]
on = "top"
directions = ["y"]
stiffness = 250.0
value = [-0.01]
times = [0.0, 1.0]
factors = [1.0, 3.0]
[[support]]
on = "side"
directions = ["x"]
[counter_body]
shape = "plane"
center = [0.0, 0.0]
normal = [0.0, 1.0]
motion = { velocity = [1.0, 0.0] }
press = { direction = [0.0, 1.0] }
[wear]
on = ["bottom"]
coefficient = 0.0
[time]
end = 1.0
[integrator]
name = "bdf"
)"),
                              {});
  const ModelRun run = run_model(*column, "bdf", 0, 1e-3, 1);
  const double expected = 0.03 / (1 / 250.0 + 2 / 1000.0);
  EXPECT_NEAR(observed(*column, run.last(), "max_pressure"), expected, 1e-6 * expected);
}

// A disc that turns about the middle of a square block, where there is a node that does not slide.
// The pressure is uniform at the start, and c / (k omega r) when all of the surface wears by c.
TEST_F(Parts, ADiscThatTurnsAboutANodeWearsAsElsewhere) {
  const SceneFolder folder;
  folder.write("block.geo", R"(
Point(1) = {-1, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 1, 0}; Point(4) = {-1, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 2, 3, 4} = 9; Transfinite Surface {1}; Recombine Surface {1};
out[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; Recombine; };
Physical Surface("bottom") = {1}; Physical Surface("top") = {out[0]};
Physical Volume("block") = {out[1]};
)");
  const auto block = part_of(folder.write("block.toml", R"(
problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 1e3, poisson_ratio = 0.3 }
support = [{ on = "top" }]
[counter_body]
shape = "plane"
motion = { rotation = 2.0, center = [0.0, 0.0, 0.0], axis = [0.0, 0.0, 1.0] }
press = { direction = [0.0, 0.0, 1.0], force = 50.0 }
[wear]
on = ["bottom"]
coefficient = 1e-7
rate = "k * p * v"
[time]
end = 100.0
[integrator]
name = "esdirk-3"
)"),
                             {});
  EXPECT_THAT(block->remarks, ::testing::Contains(::testing::HasSubstr("turns about a point")));
  constexpr double F = 50, area = 4, k_omega = 2e-7;
  const double integral_of_r = 4.0 / 3 * (std::sqrt(2) + std::asinh(1.0)),
               integral_of_1_by_r = 8 * std::asinh(1.0);
  const ModelRun start = run_model(*block, "esdirk-3", 0, 1e-2, 100);
  EXPECT_NEAR(
      observed(*block, start.last(), "worn_volume") / (k_omega * F / area * integral_of_r * 100), 1,
      0.02);
  const ModelRun end = run_model(*block, "esdirk-3", 0, 1e-2, 5e4);
  EXPECT_NEAR(observed(*block, end.last(), "wear_flux") / (k_omega * F * area / integral_of_1_by_r),
              1, 0.7 / 8);  // test_terms TurningCounterBody.*
}

}  // namespace
}  // namespace gnomon::worn_body_test
