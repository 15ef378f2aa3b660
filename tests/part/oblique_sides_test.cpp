// Wearing surfaces that end at oblique planes: tapered pins whose shape under a plane is a cut, and
// parts that are turned as a whole.

#include <functional>
#include <gnomon/system/system.hpp>
#include <numbers>

#include "part/tapered_parts.hpp"

namespace gnomon::oblique_sides_test {
namespace {

using namespace testing;

using ObliqueSides = TaperedParts;

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
  const std::size_t up = model.grid->cell == Grid::Cell::hexahedron ? 2 : 1;
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
      expect_cut(*pin, run_model(*pin, method, 0, 1e-8, end, false, to_rounding).last(), depth,
                 {0});
    }
}

TEST_F(ObliqueSides, ATruncatedConeIsCut) {
  using std::numbers::pi;
  const double depth = depth_of(
      [](double h) { return pi / (3 * taper) * (std::pow(a + taper * h, 3) - std::pow(a, 3)); });
  const auto pin = cone();
  expect_cut(*pin, run_model(*pin, "esdirk-4", 0, 1e-7, end, false, to_rounding).last(), depth,
             {0});
}

// Its edges slide in the oblique sides, its corner along the line in which they meet.
TEST_F(ObliqueSides, ATruncatedPyramidIsCut) {
  const double depth = depth_of(
      [](double h) { return (std::pow(a + taper * h, 3) - std::pow(a, 3)) / (3 * taper); });
  for (const char* method : {"direct", "block"}) {
    const auto pin = pyramid({fmt::format("solver.method={}", method)});
    expect_cut(*pin, run_model(*pin, "esdirk-4", 0, 1e-7, end, false, to_rounding).last(), depth,
               {0, 1});
  }
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
                tapered_scene("friction.coefficient = 0.2\n" + support("top") + counter_body),
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
  const auto pin = tapered({"body.young_modulus=1e3"});
  const Grid grid = pin->grid.value();
  for (const char* method : {"esdirk-3", "erk-3"}) {
    SCOPED_TRACE(method);
    const std::vector<double> shape = shape_of(*pin, run_model(*pin, method, 0, 1e-3, end).last());
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
}

// The upper side falls to the axis as a cone: its nodes slide in it, but for those on the axis and
// at the upright side.
TEST_F(ObliqueSides, AConeIsHeldOnItsAxis) {
  const auto pin = part(quadrangle({{{0, 0}, {a, 0}, {a, height}, {0, height + 1}}}),
                        tapered_scene("model.plane = \"axisymmetric\"\n" + support("top") +
                                      plane("[0, 1]", "velocity = [0.0, 0.0, 100.0]")));
  const std::vector<double> shape =
      shape_of(*pin, run_model(*pin, "esdirk-3", 0, 1e-4, end).last());
  const Grid grid = pin->grid.value();
  int slides = 0;
  for (std::size_t node = 0; node < grid.points.size(); ++node) {
    const auto [r, z, none] = grid.points[node];
    if (std::abs(z - height - 1 + r / a) > 1e-9) continue;
    EXPECT_NEAR(shape[3 * node + 1], -shape[3 * node] / a, 1e-13);
    if (std::abs(shape[3 * node]) > 1e-4)
      ++slides;
    else
      EXPECT_TRUE(r == 0 || r == a) << r;
  }
  EXPECT_EQ(slides, 5);
}

// What a resumed run does: the model is made again from the mesh in the result.
TEST_F(ObliqueSides, SlideInAModelMadeAgain) {
  const std::string text =
      tapered_scene(support("top") + plane("[0, 1]", "velocity = [100.0, 0.0]"));
  const auto first = tapered();
  const SceneFolder folder;
  const Scene again = load_scene(folder.write("pin.toml", text), {}, key_table);
  const auto second = remake_model(again, first->grid);
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
    const auto pin = part(geometry, tapered_scene(support("top") + support("mirror", "[\"x\"]") +
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
}  // namespace gnomon::oblique_sides_test
