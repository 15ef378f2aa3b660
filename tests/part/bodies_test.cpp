// Bodies of several materials that are bonded: layers under pressure and a beam against closed
// forms, and a coating that gets thinner on a substrate that does not.
#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>

#include "part/part_scene.hpp"

namespace gnomon {
namespace bodies_test {

using namespace testing;

constexpr double coating = 0.5, substrate = 1.5;  // mm, thicknesses

/// Two rectangles on each other, from y = -2 to 0, with elements of height h; groups: substrate,
/// coating; bottom, surface.
std::string layers(double width, double h, int across) {
  return fmt::format(R"(Point(1) = {{0, {0}, 0}}; Point(2) = {{{1}, {0}, 0}};
Point(3) = {{0, {2}, 0}}; Point(4) = {{{1}, {2}, 0}}; Point(5) = {{0, 0, 0}}; Point(6) = {{{1}, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 4}}; Line(3) = {{4, 3}}; Line(4) = {{3, 1}};
Line(5) = {{4, 6}}; Line(6) = {{6, 5}}; Line(7) = {{5, 3}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Curve Loop(2) = {{-3, 5, 6, 7}}; Plane Surface(2) = {{2}};
Transfinite Curve {{1, 3, 6}} = {3}; Transfinite Curve {{2, 4}} = {4}; Transfinite Curve {{5, 7}} = {5};
Transfinite Surface {{1, 2}}; Recombine Surface {{1, 2}};
)",
                     -coating - substrate, width, -coating, across + 1,
                     std::lround(substrate / h) + 1, std::lround(coating / h) + 1);
}

const std::string groups_in_plane =
    "Physical Curve(\"bottom\") = {1}; Physical Curve(\"surface\") = {6};\n"
    "Physical Surface(\"substrate\") = {1}; Physical Surface(\"coating\") = {2};\n";

/// The same with a depth along z.
const std::string groups_in_space =
    "out[] = Extrude {0, 0, 1} { Surface{1, 2}; Layers{2}; Recombine; };\n"
    "Physical Surface(\"bottom\") = {out[2]}; Physical Surface(\"surface\") = {out[10]};\n"
    "Physical Volume(\"substrate\") = {out[1]}; Physical Volume(\"coating\") = {out[7]};\n";

class Bodies : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    folder_.write("plane.geo", layers(2, 0.25, 4) + groups_in_plane);
    folder_.write("space.geo", layers(2, 0.5, 2) + groups_in_space);
  }

  /// A plane that comes from above; nothing moves sideways, because nu = 0.
  std::string scene(const std::string& geometry, const std::string& press, double hard, double soft,
                    const std::string& more = "") const {
    const bool in_space = geometry == "space.geo";
    return fmt::format(R"(problem = "worn_body"
mesh.file = "{0}"
support = [ {{ on = "bottom" }} ]
friction.coefficient = 0.0
wear = {{ on = ["surface"], coefficient = 1e-6 }}
time.end = 100.0
integrator = {{ name = "esdirk-4", rtol = 1e-5 }}
[[body]]
name = "substrate"
young_modulus = {1}
poisson_ratio = 0.0
material = "linear"
[[body]]
name = "coating"
young_modulus = {2}
poisson_ratio = 0.0
material = "linear"
[counter_body]
shape = "plane"
center = {3}
normal = {4}
motion = {{ velocity = {5} }}
press = {{ direction = {4}, {6} }}
{7}
)",
                       geometry, hard, soft, in_space ? "[0.0, 0.0, 0.0]" : "[0.0, 0.0]",
                       in_space ? "[0.0, -1.0, 0.0]" : "[0.0, -1.0]",
                       in_space ? "[1.0, 0.0, 0.0]" : "[1.0, 0.0]", press, more);
  }

  Counters counters_;
};

// A pressure p shortens the layers by p (h1/E1 + h2/E2), whatever the contrast of the moduli, in
// the plane, of revolution and in space, by the block solver with factors and with multigrid.
TEST_F(Bodies, LayersUnderPressureAreSpringsInSeries) {
  constexpr double approach = 1e-3;
  for (const double contrast : {1.0, 10.0, 1e5})
    for (const double soft : {2e3, 2e3 * contrast})
      for (const std::string kind : {"strain", "axisymmetric", "space", "multigrid"}) {
        if (kind == "multigrid" && !has_multigrid()) continue;
        SCOPED_TRACE(kind + fmt::format(" {} {}", contrast, soft));
        const double hard = soft == 2e3 ? 2e3 * contrast : 2e3;
        const std::string plane = kind == "axisymmetric" ? "model.plane = \"axisymmetric\"\n" : "";
        const bool in_space = kind == "space" || kind == "multigrid";
        std::string text = plane + scene(in_space ? "space.geo" : "plane.geo",
                                         fmt::format("approach = [{}]", approach), hard, soft);
        if (kind == "axisymmetric")  // slides to the circumference
          text.replace(text.find("{ velocity = [1.0, 0.0] }"), 25,
                       "{ velocity = [0.0, 0.0, 1.0] }");
        const std::string inner = kind == "multigrid" ? "multigrid" : "factor";
        const auto layered = model(text, {"solver.preconditioner=" + inner});
        const double pressure = approach / (coating / soft + substrate / hard);
        const ContactSurface surface = layered->contact(layered->start(counters_)).value();
        for (const double p : surface.pressure) EXPECT_NEAR(p / pressure, 1, 1e-7);
      }
}

// The coating wears by k p v; the bond stays, and the approach is the wear and the compliance of
// what is left of the coating.
TEST_F(Bodies, ACoatingGetsThinnerOnASubstrateThatDoesNot) {
  constexpr double force = 20, width = 2, hard = 2e4, soft = 1e3, p = force / width;
  const auto coated = model(scene("plane.geo", fmt::format("force = {}", force), hard, soft),
                            {"wear.coefficient=2e-4"});
  const ModelRun run = run_model(*coated, "esdirk-4", 0, 1e-6, 100);
  const double worn = 2e-4 * p * 100;
  EXPECT_NEAR(worn, 0.2, 1e-12);
  EXPECT_NEAR(observed(*coated, run.last(), "worn_volume"), worn * width, 1e-7);
  const double first = p * (coating / soft + substrate / hard);
  EXPECT_NEAR(observed(*coated, run.states.front(), "approach"), first, 1e-7);
  EXPECT_NEAR(observed(*coated, run.last(), "approach"), worn + first - p * worn / soft, 1e-6);
  EXPECT_NEAR(observed(*coated, run.last(), "element_volume"), 1 - worn / coating, 1e-6);
  const GridField shape = coated->fields(run.last())[1];
  const Grid grid = coated->grid.value();
  for (std::size_t n = 0; n < grid.points.size(); ++n)
    if (grid.points[n][1] < -coating + 1e-9) {
      EXPECT_NEAR(shape.values[3 * n + 1], 0, 1e-14);
    }
}

// A cantilever of two layers under a round tip bends by F L^3 / (3 EI), EI about its own neutral
// axis.
TEST_F(Bodies, ABondedBeamBendsByItsCompositeStiffness) {
  constexpr double length = 60, deflection = 0.05, hard = 2e5, soft = 2e4;
  folder_.write("beam.geo", layers(length, 0.125, 240) +
                                "Physical Curve(\"end\") = {4, 7}; Physical Curve(\"surface\") = "
                                "{6};\nPhysical Surface(\"substrate\") = {1}; Physical "
                                "Surface(\"coating\") = {2};\n");
  std::string text = scene("beam.geo", fmt::format("approach = [{}]", deflection), hard, soft);
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("on = \"bottom\"", "on = \"end\"");
  replace("shape = \"plane\"\ncenter = [0.0, 0.0]\nnormal = [0.0, -1.0]",
          fmt::format("shape = \"cylinder\"\nradius = 5.0\ncenter = [{}, 5.0]", length));
  const auto beam = model(text, {"shape.reach=1.0"});
  const double force = observed(*beam, beam->start(counters_), "contact_force");
  const double axis =
      (hard * substrate * substrate / 2 + soft * coating * (substrate + coating / 2)) /
      (hard * substrate + soft * coating);
  const auto part = [&](double modulus, double h, double middle) {
    return modulus * (h * h * h / 12 + h * (middle - axis) * (middle - axis));
  };
  const double stiffness =
      part(hard, substrate, substrate / 2) + part(soft, coating, substrate + coating / 2);
  EXPECT_NEAR(force / (3 * stiffness * deflection / std::pow(length, 3)), 1, 0.01);
}

TEST_F(Bodies, AreMeantByTheirNames) {
  const std::string text = scene("plane.geo", "approach = [1e-3]", 2e3, 2e3);
  const auto layered = model(text, {"body.coating.young_modulus=1e3"});
  const double pressure = 1e-3 / (coating / 1e3 + substrate / 2e3);
  EXPECT_NEAR(layered->contact(layered->start(counters_)).value().pressure.front(), pressure,
              1e-7 * pressure);
  EXPECT_THAT(refusal(text, {"body.coting.young_modulus=1e3"}),
              ::testing::HasSubstr("--set body.coting.young_modulus: unknown key"));
}

TEST_F(Bodies, AreAllElementsEachOnce) {
  const std::string text = scene("plane.geo", "approach = [1e-3]", 2e3, 2e3);
  const auto with = [&](const std::string& old, const std::string& by) {
    std::string other = text;
    return other.replace(other.find(old), old.size(), by);
  };
  EXPECT_THAT(refusal(with("name = \"coating\"", "name = \"coting\"")),
              ::testing::HasSubstr("did you mean \"coating\""));
  EXPECT_THAT(refusal(with("name = \"coating\"", "name = \"paint\"")),
              ::testing::HasSubstr("elements called \"paint\", it has \"coating\", \"substrate\""));
  EXPECT_THAT(refusal(with("name = \"coating\"", "name = \"substrate\"")),
              ::testing::HasSubstr("share no element"));
  EXPECT_THAT(refusal(with("name = \"coating\"\n", "")),
              ::testing::HasSubstr("missing key `name`"));
}

// One material for several groups is said, not silent.
TEST_F(Bodies, GroupsOfOneMaterialAreRemarked) {
  std::string text = scene("plane.geo", "approach = [1e-3]", 2e3, 2e3);
  const std::size_t begin = text.find("[[body]]"), end = text.find("[counter_body]");
  text.replace(begin, end - begin, "[body]\nyoung_modulus = 2e3\npoisson_ratio = 0.0\n");
  EXPECT_THAT(model(text)->remarks,
              ::testing::Contains(::testing::HasSubstr("\"coating\", \"substrate\" are one body")));
}

// Finite strains of those that have small ones; small ones of all, where none gives a material.
TEST_F(Bodies, HaveOneChoiceOfSmallStrains) {
  const Scene linear =
      load_scene(folder_.write("scene.toml", scene("plane.geo", "approach = [1e-3]", 2e4, 2e3)), {},
                 key_table);
  const std::vector<Key> keys = linear.controlling_keys();
  const auto material = std::ranges::find(keys, "body.material", &Key::name);
  ASSERT_NE(material, keys.end());
  const auto scaled = material->controls->scaled;
  EXPECT_FALSE(scaled(linear, 2));
  const auto large = scaled(linear, 0.5);
  ASSERT_TRUE(large);
  EXPECT_FALSE(large->given("body.1.material") || large->given("body.2.material"));
  EXPECT_FALSE(scaled(*large, 0.5));
  const auto small = scaled(*large, 2);
  ASSERT_TRUE(small);
  EXPECT_EQ(small->text("body.1.material"), "linear");
  EXPECT_EQ(small->text("body.2.material"), "linear");
  const Scene one = small->without("body.2.material");
  EXPECT_FALSE(scaled(one, 2));
  EXPECT_FALSE(scaled(one, 0.5)->given("body.1.material"));
}

// So that it can be resumed.
TEST_F(Bodies, AreMadeAgainFromTheirScene) {
  const Scene scene_of =
      load_scene(folder_.write("scene.toml", scene("plane.geo", "approach = [1e-3]", 2e4, 2e3)), {},
                 key_table);
  const std::string text = scene_of.resolved();
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\n[body]\n")));
  const Scene again = parse_scene(text, "resolved", {}, key_table);
  EXPECT_TRUE(again == scene_of);
  const Grid grid = make_model(scene_of)->grid.value();
  const auto remade = remake_model(again, grid);
  EXPECT_NEAR(remade->contact(remade->start(counters_)).value().pressure.front(),
              1e-3 / (coating / 2e3 + substrate / 2e4), 1e-9);
}

TEST_F(Bodies, ASingleOneIsMadeAgain) {
  folder_.write("one.geo",
                layers(2, 0.25, 4) +
                    "Physical Curve(\"bottom\") = {1}; Physical Curve(\"surface\") = {6};\n"
                    "Physical Surface(\"block\") = {1, 2};\n");
  const Scene scene_of = load_scene(folder_.write("scene.toml", R"(
problem = "worn_body"
mesh.file = "one.geo"
model.plane = "strain"
body = [ { name = "block", young_modulus = 1e3, poisson_ratio = 0.0 } ]
support = [ { on = "bottom" } ]
counter_body = { shape = "plane", center = [0, 0], normal = [0, -1], press = { direction = [0, -1], approach = [2e-3] } }
wear = { on = ["surface"], coefficient = 1e-6, velocity = 1.0 }
time.end = 1.0
)"),
                                    {}, key_table);
  const auto remade = remake_model(scene_of, make_model(scene_of)->grid.value());
  EXPECT_NEAR(remade->contact(remade->start(counters_)).value().pressure.front(), 1, 1e-2);
}

}  // namespace bodies_test
}  // namespace gnomon
