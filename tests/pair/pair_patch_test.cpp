// Patch tests under equal pressure on all sides: interfaces that are inclined or curved carry it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "part/part_scene.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_patch_test {
namespace {

using namespace testing;

constexpr double pressure = 10;

/// Nothing but three points of the lower body and what contact leaves free of the upper one is
/// held, all at the left end of the interface, about which both bodies shrink.
template <int dim>
AssemblyParts<dim> under_pressure(TwoBodies pair) {
  pair.kinematics = Kinematics::small;
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  NodalFlags<dim>& held = parts.supports.held;
  held.setZero();
  const auto hold = [&](double x, double y, bool upper, std::initializer_list<int> directions) {
    const std::size_t nodes = block_of<dim>(pair, true).nodes.size();
    for (std::size_t node = upper ? 0 : nodes; node < (upper ? nodes : parts.mesh.nodes.size());
         ++node) {
      const Vector<dim>& at = parts.mesh.nodes[node];
      if (std::abs(at[0] - x) > 1e-9 || std::abs(at[dim - 1] - y) > 1e-9) continue;
      if (dim == 3) held(static_cast<Eigen::Index>(node), 1) = at[1] == 0;
      for (const int i : directions) held(static_cast<Eigen::Index>(node), i) = 1;
    }
  };
  const double left = pair.upper.surface(0);
  hold(0, left, false, {0, dim - 1});
  hold(0, -pair.lower.size, false, {0});
  hold(0, left, true, {0});
  hold(0, pair.upper.size, true, {});
  parts.pairs.front().along.clear();
  parts.loads.clear();
  for (const auto& [name, facets] : parts.mesh.boundary)
    if (name != "bottom" && name != "lower top")
      parts.loads.push_back({.facets = facets, .pressure = pressure});
  return parts;
}

/// The largest deviation of a pressure of the slave. Loads act on the deformed area, pressures are
/// by the undeformed one.
template <int dim>
double deviation(const TwoBodies& pair) {
  const WearModel<dim> model(under_pressure<dim>(pair));
  Counters counters;
  const ContactSurface surface = model.contact(model.start(counters)).value();
  const double compressibility = (1 - 2 * pair.upper.poisson_ratio) *
                                 (dim == 2 ? 1 + pair.upper.poisson_ratio : 1) /
                                 pair.upper.young_modulus;
  double expected = pressure;
  for (int k = 0; k < 20; ++k)
    expected = pressure * std::pow(1 - compressibility * expected, dim - 1);
  double most = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (model.assembly().carries[c])
      most = std::max(most, std::abs(surface.pressure[c] / expected - 1));
  return most;
}

TwoBodies blocks(int above, int below, const std::function<double(double)>& surface) {
  return {.upper = {.along = above, .high = above, .across = above, .surface = surface},
          .lower = {.along = below, .high = below, .across = below, .surface = surface}};
}

TEST(PairPatch, UniformPressurePassesInclinedInterfaces) {
  const auto inclined = [](double x) { return 0.3 * x; };
  for (const auto& [above, below] : {std::pair{4, 4}, {2, 6}, {6, 2}, {4, 6}, {5, 7}}) {
    SCOPED_TRACE(::testing::Message() << above << ":" << below);
    EXPECT_LT(deviation<2>(blocks(above, below, inclined)), 1e-10);
  }
  for (const auto& [above, below] : {std::pair{2, 2}, {2, 3}, {3, 2}, {1, 3}, {3, 1}}) {
    SCOPED_TRACE(::testing::Message() << above << ":" << below << " in space");
    EXPECT_LT(deviation<3>(blocks(above, below, inclined)), 1e-10);
  }
}

// Facets of unlike meshes leave gaps of the curvature times h^2, over which elements of h lie.
TEST(PairPatch, CurvedInterfacesAreOfSecondOrderWithEqualMeshesAndOfFirstWithOthers) {
  const auto curved = [](double x) { return 0.1 * x * x; };
  const auto ratio = [&](int above, int below) {
    const double coarse = deviation<2>(blocks(above, below, curved));
    EXPECT_GT(coarse, 1e-4);
    EXPECT_LT(coarse, 1e-2);
    return coarse / deviation<2>(blocks(2 * above, 2 * below, curved));
  };
  EXPECT_GT(ratio(8, 8), 3.4);
  EXPECT_GT(ratio(8, 12), 1.9);
}

/// Two blocks from x = `inner` to 6 with the interface at 4 + slope (x - 3), which rollers hold
/// below and, without a hole, at the left; equal pressure on all other sides. In space they are 6
/// wide.
struct Blocks {
  double slope = 0, inner = 0;
  std::string plane = "strain";
  bool in_space = false;
  std::array<int, 2> elements = {6, 6};  ///< of the lower and the upper one

  std::string lower() const {
    return block({0, 0, right(), left()}, {"base", "low out", "low face", "low in"}, "low");
  }
  std::string upper() const {
    return block({left(), right(), 8, 8}, {"up face", "up out", "top", "up in"}, "up");
  }
  double left() const { return 4 + slope * (inner - 3); }
  double right() const { return 4 + slope * 3; }
  /// By the heights of its corners.
  std::string block(const std::array<double, 4>& y, const std::array<std::string, 4>& sides,
                    const std::string& body) const {
    const int n = elements[body == "up"];
    std::string text;
    for (int k = 0; k < 4; ++k)
      text +=
          fmt::format("Point({}) = {{{}, {}, 0}};\n", k + 1, k == 0 || k == 3 ? inner : 6, y[k]);
    text += fmt::format(
        "Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};\n"
        "Curve Loop(1) = {{1 : 4}}; Plane Surface(1) = {{1}};\n"
        "Transfinite Curve {{1 : 4}} = {}; Transfinite Surface {{1}}; Recombine Surface {{1}};\n",
        n + 1);
    if (in_space)
      text += fmt::format(
          "e[] = Extrude {{0, 0, 6}} {{ Surface{{1}}; Layers{{{0}}}; Recombine; }};\n"
          "Physical Volume(\"{1}\") = {{e[1]}}; Physical Surface(\"{1} back\") = {{1}};\n"
          "Physical Surface(\"{1} front\") = {{e[0]}};\n",
          n, body);
    else
      text += fmt::format("Physical Surface(\"{}\") = {{1}};\n", body);
    for (int k = 0; k < 4; ++k)
      text += in_space ? fmt::format("Physical Surface(\"{}\") = {{e[{}]}};\n", sides[k], k + 2)
                       : fmt::format("Physical Curve(\"{}\") = {{{}}};\n", sides[k], k + 1);
    return text;
  }

  std::string scene() const {
    const bool ring = plane == "axisymmetric";
    std::string text = fmt::format(R"(problem = "worn_body"
model.plane = "{}"
body = [ {{ name = "low", mesh = "low.geo", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "up", mesh = "up.geo", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["up", "low"] }} ]
wear = {{ on = ["low face", "up face"], coefficient = 0.0 }}
time.end = 1.0
)",
                                   plane);
    const auto hold = [&text](const std::string& on, const std::string& direction) {
      text += fmt::format("[[support]]\non = \"{}\"\ndirections = [\"{}\"]\n", on, direction);
    };
    const auto press = [&text](const std::string& on) {
      text += fmt::format("[[load]]\non = \"{}\"\npressure = 10.0\n", on);
    };
    hold("base", ring ? "z" : "y");
    press("top");
    for (const std::string body : {"up", "low"}) {
      press(body + " out");
      if (inner > 0) press(body + " in");
      if (inner == 0 && !ring) hold(body + " in", "x");
      if (in_space) hold(body + " back", "z"), press(body + " front");
    }
    return text;
  }
};

class PatchScenes : public PartScenes {
protected:
  /// Of the pressures, by the least. `half_width`: where it is observed.
  double spread(const Blocks& blocks, double* half_width = nullptr) {
    folder_.write("low.geo", blocks.lower());
    folder_.write("up.geo", blocks.upper());
    const auto model = this->model(blocks.scene());
    Counters counters;
    const State start = model->start(counters);
    if (half_width) *half_width = observed(*model, start, "contact_half_width");
    const ContactSurface surface = model->contact(start).value();
    const auto [least, most] = std::ranges::minmax_element(surface.pressure);
    EXPECT_GT(*least, 9);
    return *most / *least - 1;
  }
};

/// Rollers at the left are no symmetry of an interface that is inclined to them.
TEST_F(PatchScenes, UniformPressurePassesInclinedInterfacesBesideRollers) {
  for (const std::array elements : {std::array{2, 6}, {6, 4}, {6, 6}})
    for (const double slope : {0.0, 0.3, -0.5}) {
      SCOPED_TRACE(slope);
      EXPECT_LT(spread({.slope = slope, .elements = elements}), 1e-9);
      const Blocks cone{.slope = slope, .plane = "axisymmetric", .elements = elements};
      EXPECT_LT(spread(cone), 1e-9);
    }
  for (const std::array elements : {std::array{2, 3}, {4, 2}})
    EXPECT_LT(spread({.slope = 0.3, .in_space = true, .elements = elements}), 1e-9);
}

/// Pressure on the sides of rings has no resultant, and does not bring them nearer.
TEST_F(PatchScenes, PressureOnTheSidesOfRingsDoesNotPressThem) {
  for (const double slope : {0.0, 0.2}) {
    const Blocks rings{.slope = slope, .inner = 2, .plane = "axisymmetric", .elements = {3, 9}};
    double half_width = 0;
    EXPECT_LT(spread(rings, &half_width), 1e-9);
    EXPECT_NEAR(half_width, 2, 1e-3);
  }
}

}  // namespace
}  // namespace gnomon::pair_patch_test
