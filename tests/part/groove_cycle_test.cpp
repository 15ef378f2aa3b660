// A ball that passes over a block again and again, as the positions of a cycle, against the groove
// of ball_on_half_space, which is uniform along the path (the paper, sec. 4.3).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::groove_cycle_test {
namespace {

using namespace testing;

constexpr double element = 0.1;  // along the path, and between two positions [mm]
constexpr double wear_per_force = 1e-7, force = 100, passes = 200;

class PassingBall : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }

  /// The part beyond the ends of the path is as long as half of the block of the built-in groove.
  std::string block(int positions) const {
    const int along = positions - 1 + 14;
    return fmt::format(R"(Point(1) = {{{0}, 0, -0.6}};
Point(2) = {{{0}, 0.6, -0.6}};
Point(3) = {{{0}, 0.6, 0}};
Point(4) = {{{0}, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = 7;
Transfinite Curve {{2, 4}} = 4;
Transfinite Surface {{1}};
Recombine Surface {{1}};
part[] = Extrude {{{1}, 0, 0}} {{ Surface{{1}}; Layers{{{2}}}; Recombine; }};
Physical Surface("ends") = {{1, part[0]}};
Physical Surface("bottom") = {{part[2]}};
Physical Surface("side") = {{part[3]}};
Physical Surface("top") = {{part[4]}};
Physical Surface("symmetry") = {{part[5]}};
Physical Volume("block") = {{part[1]}};
)",
                       -along * element / 2, along * element, along);
  }

  std::unique_ptr<Model> cycle(int positions) const {
    folder_.write("block.geo", block(positions));
    std::string phases;
    for (int p = 0; p < positions; ++p) phases += fmt::format("{:.15f}, ", (p + 0.5) / positions);
    return make(fmt::format(R"toml(problem = "worn_body"
mesh.file = "block.geo"
body = {{ young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }}
support = [ {{ on = "bottom" }}, {{ on = "ends" }}, {{ on = "side" }},
            {{ on = "symmetry", directions = ["y"] }} ]
wear = {{ on = ["top"], coefficient = {}, rate = "k * p * v" }}
time.end = {}
integrator.name = "esdirk-3"
[counter_body]
shape = "ball"
radius = 5.0
center = [0.0, 0.0, 5.0]
press = {{ direction = [0.0, 0.0, -1.0], force = {} }}
[cycle]
period = 1.0
phases = [{}]
x = "{} * (tau - 0.5)"
)toml",
                            wear_per_force, passes, force / 2, phases, positions * element));
  }

  /// One pass per second over a path of 1 mm.
  std::unique_ptr<Model> uniform() const {
    return make(fmt::format(R"(problem = "ball_on_half_space"
ball.radius = 5.0
block = {{ length = 1.4, half_width = 0.6, depth = 0.6 }}
path.length = 1.0
mesh = {{ elements = [14, 6, 3], size = [{0}, 0.1, 0.2], fine = [0.0, 0.0, 0.0] }}
body = {{ young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }}
load.force = {1}
friction.coefficient = 0.0
wear = {{ coefficient = {2}, velocity = 1.0, rate = "k * p * v" }}
time.end = {3}
integrator.name = "esdirk-3"
)",
                            element, force, wear_per_force, passes));
  }

private:
  std::unique_ptr<Model> make(const std::string& text) const {
    return make_model(load_scene(folder_.write("scene.toml", text), {}, key_table));
  }

  SceneFolder folder_;
};

/// Heights of the surface where x = 0, from the plane of symmetry outwards.
std::vector<double> middle_section(const Model& model, const State& state) {
  const ContactSurface surface = model.contact(state).value();
  std::vector<std::pair<double, double>> found;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (std::abs(surface.initial[c][0]) < 1e-9)
      found.emplace_back(surface.initial[c][1], surface.worn[c][2]);
  std::ranges::sort(found);
  std::vector<double> heights;
  for (const auto& [y, z] : found) heights.push_back(z);
  return heights;
}

/// Positions that are one element apart load the middle of the path exactly as the built-in groove
/// is: a node there meets the ball in all the places in which a ball at rest meets the nodes of its
/// line. What is left is the effect of the ends, over which the ball passes less often: it decays
/// exponentially with the length of the path.
TEST_F(PassingBall, WearsTheBuiltInGrooveInTheMiddleOfItsPath) {
  constexpr double tolerance = 1e-4;
  const auto groove = uniform();
  const State worn = run_model(*groove, "esdirk-3", 0, tolerance, passes).last();
  const std::vector<double> expected = middle_section(*groove, worn);
  const double deepest = -*std::ranges::min_element(expected);
  EXPECT_NEAR(observed(*groove, worn, "groove_section") / (wear_per_force * force * passes), 1,
              2e-3);
  std::vector<double> differences;
  for (const int positions : {9, 13}) {
    const auto block = cycle(positions);
    const State end = run_model(*block, "esdirk-3", 0, tolerance, passes).last();
    // n_z <= |v_T|/v <= 1: the slope of the groove across the path inclines the pressure, whose
    // integral is then more than the force, and ever more as the groove deepens.
    const double path = positions * element;
    const double worn_by_force =
        observed(*block, end, "worn_volume") / (wear_per_force * force / 2 * path * passes);
    EXPECT_GE(worn_by_force, 1 - 1e-6);
    EXPECT_LE(worn_by_force, observed(*block, end, "contact_force") / (force / 2));
    EXPECT_LT(observed(*block, end, "contact_force") / (force / 2), 1.002);
    const std::vector<double> section = middle_section(*block, end);
    ASSERT_EQ(section.size(), expected.size());
    double difference = 0;
    for (std::size_t i = 0; i < section.size(); ++i)
      difference = std::max(difference, std::abs(section[i] - expected[i]));
    differences.push_back(difference / deepest);
  }
  EXPECT_LT(differences[1], 2e-3);
  EXPECT_GT(differences[0], 5 * differences[1]);
}

}  // namespace
}  // namespace gnomon::groove_cycle_test
