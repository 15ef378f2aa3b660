// Wearing surfaces that end at oblique planes: tapered pins whose shape under a plane is a cut, and
// parts that are turned as a whole.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "part/part_scene.hpp"

namespace gnomon {
namespace {

using namespace testing;

using Point2 = std::array<double, 2>;

Point2 turned(const Point2& x, double angle) {
  return {std::cos(angle) * x[0] - std::sin(angle) * x[1],
          std::sin(angle) * x[0] + std::cos(angle) * x[1]};
}

std::string direction(double x, double y, double angle) {
  const auto [u, v] = turned({x, y}, angle);
  return fmt::format("[{}, {}]", u, v);
}

/// A quadrangle of n x n elements; its corners follow each other from the lower left one. The right
/// side has no name.
std::string quadrangle(const std::array<Point2, 4>& corners, double angle = 0, int n = 6) {
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
std::string frustum(double a, double taper, double height, int n) {
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

constexpr double k = 1e-6, speed = 100, force = 40, end = 1000;
constexpr double worn = k * speed * force * end;

/// Held at its top, a plane rubs its face; so stiff that the face stays plane to 1e-6.
std::string scene(const std::string& further) {
  return fmt::format(R"(
problem = "worn_body"
mesh.geometry = "pin.geo"
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

std::string support(const std::string& on, const std::string& directions = "") {
  return fmt::format("[[support]]\non = \"{}\"\n{}\n", on,
                     directions.empty() ? "" : "directions = " + directions);
}

std::string plane(const std::string& normal, const std::string& motion) {
  return fmt::format(R"(
[counter_body]
shape = "plane"
normal = {}
motion = {{ {} }}
press = {{ direction = {}, force = {} }}
)",
                     normal, motion, normal, force);
}

constexpr double taper = 0.4, a = 2, height = 4;

class ObliqueSides : public ::testing::Test {
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
        scene(support("top") + plane("[0, 1]", "velocity = [100.0, 0.0]")), overrides);
  }
  std::unique_ptr<Model> cone(const Overrides& overrides = {}) {
    return part(quadrangle({{{0, 0}, {a, 0}, {a + taper * height, height}, {0, height}}}),
                scene("body.plane = \"axisymmetric\"\n" + support("top") +
                      plane("[0, 1]", "out_of_plane = 100.0")),
                overrides);
  }
  std::unique_ptr<Model> pyramid(const Overrides& overrides = {}, int n = 3) {
    return part(frustum(a, taper, height, n),
                scene(support("top") + support("front", "[\"y\"]") + support("side", "[\"x\"]") +
                      plane("[0, 0, 1]", "velocity = [100.0, 0.0, 0.0]")),
                overrides);
  }

private:
  SceneFolder folder_;
};

/// Solves volume(depth) = worn for an ascending volume.
double depth_of(const std::function<double(double)>& volume) {
  double low = 0, high = height;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (volume(middle) < worn ? low : high) = middle;
  }
  return low;
}

/// The face is the cut at `depth`, up to elastic displacements, and its edge lies on the initial
/// sides: those that are `a` away along one of these directions.
void expect_cut(const Model& model, const State& state, double depth,
                const std::vector<int>& directions) {
  const ContactSurface face = model.contact(state).value();
  const std::size_t up = model.grid()->cell == Grid::Cell::hexahedron ? 2 : 1;
  int edge = 0;
  for (std::size_t c = 0; c < face.node.size(); ++c) {
    EXPECT_NEAR(face.worn[c][up], depth, 1e-5 * depth) << "node " << face.node[c];
    for (int i : directions)
      if (std::abs(std::abs(face.initial[c][i]) - a) < 1e-9) {
        ++edge;
        EXPECT_NEAR(std::abs(face.worn[c][i]), a + taper * face.worn[c][up], 1e-12);
      }
  }
  EXPECT_GE(edge, 1);
  EXPECT_NEAR(observed(model, state, "worn_volume") / worn, 1, 1e-7);
}

TEST_F(ObliqueSides, ATaperedPinIsCut) {
  const double depth = depth_of([](double h) { return 2 * a * h + taper * h * h; });
  for (const Overrides& solver :
       {Overrides{}, Overrides{"solver.method=block"}, Overrides{"shape.constraint=multiplier"}})
    for (const char* method : {"esdirk-4", "bdf"}) {
      SCOPED_TRACE(fmt::format("{} {}", method, fmt::join(solver, "")));
      const auto pin = tapered(solver);
      expect_cut(*pin, run_model(*pin, method, 0, 1e-8, end).last(), depth, {0});
    }
}

TEST_F(ObliqueSides, ATruncatedConeIsCut) {
  using std::numbers::pi;
  const double depth = depth_of(
      [](double h) { return pi / (3 * taper) * (std::pow(a + taper * h, 3) - std::pow(a, 3)); });
  const auto pin = cone();
  expect_cut(*pin, run_model(*pin, "esdirk-4", 0, 1e-7, end).last(), depth, {0});
}

// Its edges slide in the oblique sides, its corner along the line in which they meet.
TEST_F(ObliqueSides, ATruncatedPyramidIsCut) {
  const double depth = depth_of(
      [](double h) { return (std::pow(a + taper * h, 3) - std::pow(a, 3)) / (3 * taper); });
  for (const char* method : {"direct", "block"}) {
    const auto pin = pyramid({fmt::format("solver.method={}", method)});
    expect_cut(*pin, run_model(*pin, "esdirk-4", 0, 1e-7, end).last(), depth, {0, 1});
  }
}

/// At every instant: the derivative of the worn volume along ydot is the flux, whatever the state.
void expect_balance(const Model& model) {
  const State state = run_model(model, "esdirk-3", 0, 1e-3, end).last();
  const auto volume = [&](double time) {
    State moved = state;
    for (std::size_t i = 0; i < moved.y.size(); ++i) moved.y[i] += time * moved.ydot[i];
    return observed(model, moved, "worn_volume");
  };
  // Exact for cubic polynomials in the time, which the volume is.
  const double h = 100;
  const double rate = (8 * (volume(h) - volume(-h)) - (volume(2 * h) - volume(-2 * h))) / (12 * h);
  EXPECT_NEAR(rate / observed(model, state, "wear_flux"), 1, 1e-11);
}

TEST_F(ObliqueSides, WhatWearsIsLostAtEveryInstant) {
  const std::string soft = "body.young_modulus=1e3", rubs = "friction.coefficient=0.3";
  expect_balance(*tapered({soft, rubs}));
  expect_balance(*cone({soft}));
  expect_balance(*pyramid({soft, rubs}));
}

/// At a state that the equations of the sides do not hold either.
void expect_jacobian(const Model& model) {
  Counters counters;
  std::vector<double> y = model.start(counters).y;
  const Structure& structure = model.system().structure();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.02 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  check_jacobian(model.system(), 0, y, 0.2, nullptr, 1e-4);
  for (const AlgebraicStage& stage : model.system().algebraic_stages()) {
    stage.freeze(0, y);
    std::vector<double> part;
    for (int unknown : stage.unknowns) part.push_back(y[unknown]);
    check_jacobian(*stage.system, 0, part, 0, nullptr, 1e-4);
  }
}

TEST_F(ObliqueSides, JacobianEqualsFiniteDifferences) {
  for (const char* constraint : {"eliminated", "multiplier"}) {
    const Overrides form = {fmt::format("shape.constraint={}", constraint),
                            "body.young_modulus=1e3"};
    expect_jacobian(*tapered(form));
    expect_jacobian(*cone(form));
    expect_jacobian(*pyramid(form, 2));
  }
}

std::vector<double> shape_of(const Model& model, const State& state) {
  const std::vector<GridField> fields = model.fields(state);
  return std::ranges::find(fields, std::string("shape"), &GridField::name)->values;
}

// One side is upright, the other one oblique; turned, all are oblique. A roller wears the face
// unevenly.
TEST_F(ObliqueSides, APartTurnedAsAWholeWearsTheSame) {
  const auto at = [&](double angle) {
    const std::string counter_body = fmt::format(
        "[counter_body]\nshape = \"cylinder\"\nradius = 8.0\ncenter = {}\nmotion = {{ velocity = "
        "{} }}\npress = {{ direction = {}, force = 40.0 }}\n",
        direction(0.3, -8, angle), direction(100, 0, angle), direction(0, 1, angle));
    return part(quadrangle({{{-a, 0}, {a, 0}, {a + taper * height, height}, {-a, height}}}, angle),
                scene("friction.coefficient = 0.2\n" + support("top") + counter_body),
                {"body.young_modulus=2e3"});
  };
  const double angle = 30 * std::numbers::pi / 180;
  const auto upright = at(0), oblique = at(angle);
  const State expected = run_model(*upright, "esdirk-3", 20, 1e-4, end).last(),
              actual = run_model(*oblique, "esdirk-3", 20, 1e-4, end).last();
  EXPECT_NEAR(observed(*oblique, actual, "worn_volume"),
              observed(*upright, expected, "worn_volume"), 1e-9 * worn);
  EXPECT_GT(observed(*upright, expected, "contact_nodes"), 5);
  const std::vector<double> shape = shape_of(*upright, expected), same = shape_of(*oblique, actual);
  ASSERT_EQ(shape.size(), same.size());
  for (std::size_t i = 0; i < shape.size(); i += 3) {
    const Point2 back = turned({same[i], same[i + 1]}, -angle);
    EXPECT_NEAR(back[0], shape[i], 1e-9) << "node " << i / 3;
    EXPECT_NEAR(back[1], shape[i + 1], 1e-9) << "node " << i / 3;
  }
  const ContactSurface face = upright->contact(expected).value();
  for (std::size_t c = 0; c < face.node.size(); ++c)
    EXPECT_NEAR(oblique->contact(actual)->pressure[c], face.pressure[c],
                1e-8 * std::ranges::max(face.pressure));
}

// Off the face too the sides stay what they were, and the mesh behind them moves.
TEST_F(ObliqueSides, NodesOfASideStayOnIt) {
  const auto pin = tapered();
  const State state = run_model(*pin, "esdirk-3", 0, 1e-4, end).last();
  const std::vector<double> shape = shape_of(*pin, state);
  const Grid grid = pin->grid().value();
  int on_side = 0;
  for (std::size_t node = 0; node < grid.points.size(); ++node) {
    const auto [x, y, z] = grid.points[node];
    if (std::abs(std::abs(x) - a - taper * y) > 1e-9) continue;
    ++on_side;
    const double along = shape[3 * node + 1];
    EXPECT_NEAR(shape[3 * node], std::copysign(taper * along, x), 1e-12);
    EXPECT_GE(along, 0.05 * (1 - y / height));
  }
  EXPECT_EQ(on_side, 14);
}

// What a resumed run does: the model is made again from the mesh in the result.
TEST_F(ObliqueSides, SlideInAModelMadeAgain) {
  const std::string text = scene(support("top") + plane("[0, 1]", "velocity = [100.0, 0.0]"));
  const auto first = tapered();
  const SceneFolder folder;
  const Scene again = load_scene(folder.write("pin.toml", text), {}, key_table);
  const auto second = remake_model(again, first->grid());
  const State state = run_model(*first, "esdirk-3", 0, 1e-3, end).last();
  std::vector<double> F(state.y.size()), same(state.y.size());
  ASSERT_EQ(first->system().structure().size, second->system().structure().size);
  first->system().residual({end, state.y, state.ydot}, F);
  second->system().residual({end, state.y, state.ydot}, same);
  EXPECT_EQ(F, same);
}

// A side of two parts with a blunt edge of 14 degrees between them may be one that is curved:
// without names it holds the edge of the face, as a named part does not.
TEST_F(ObliqueSides, AFacetOfACurveIsHeld) {
  const auto edge = [&](const std::string& names) {
    const std::string geometry = R"(
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2.5, 2, 0}; Point(4) = {4, 4, 0};
Point(5) = {0, 4, 0};
For k In {1:5}
  Line(k) = {k, k % 5 + 1};
EndFor
Curve Loop(1) = {1:5}; Plane Surface(1) = {1};
Transfinite Curve {1, 4} = 5; Transfinite Curve {2, 3} = 3; Transfinite Curve {5} = 5;
Transfinite Surface {1} = {1, 2, 4, 5}; Recombine Surface {1};
Physical Curve("face") = {1}; Physical Curve("top") = {4}; Physical Surface("pin") = {1};
)" + names;
    const auto pin = part(geometry, scene(support("top") + support("mirror", "[\"x\"]") +
                                          plane("[0, 1]", "velocity = [100.0, 0.0]")));
    const ContactSurface face =
        pin->contact(run_model(*pin, "esdirk-3", 0, 1e-2, 1).last()).value();
    return face
        .wear_depth[std::ranges::find(face.initial, 2.0, [](const auto& x) { return x[0]; }) -
                    face.initial.begin()];
  };
  const std::string mirror = "Physical Curve(\"mirror\") = {5};\n";
  EXPECT_EQ(edge(mirror), 0);
  EXPECT_GT(edge(mirror + "Physical Curve(\"lower flank\") = {2};\n"), 1e-4);
}

}  // namespace
}  // namespace gnomon
