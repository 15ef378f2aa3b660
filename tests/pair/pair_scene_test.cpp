// Scenes of two bodies: what wears, who is the slave, what is refused.

#include <cmath>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <iterator>

#include "part/part_scene.hpp"
#include "support/problem_run.hpp"

namespace gnomon::pair_scene_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* scene = "worn_body/cylinder_on_plate.toml";

TEST(PairScene, BothBodiesLoseWhatTheirLawsSay) {
  const auto model = model_of(scene, {"mesh.factor=2"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  const double power = 50 * 100 * 1000;  // of half of the cylinder
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cylinder") / (1e-8 * power), 1, 2e-5);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_plate") / (1e-9 * power), 1, 2e-5);
  const Examination facts = model->examine(run.last());
  EXPECT_LT(facts.lost_wear, 1e-12);
  Vector<3> sum = Vector<3>::Zero();
  for (const ResultantForce& force : facts.forces) sum += Vector<3>::Map(force.force.data());
  EXPECT_LT(sum.norm(), 1e-5 * 50);
}

// In a law, f is the friction of the pair: f p v and q are the same.
TEST(PairScene, LawsReadTheFrictionOfTheirPair) {
  const auto rate = [](const char* law) {
    const auto model = model_of(scene, {"mesh.factor=2", "pair.1.friction=0.3",
                                        std::string("wear.rate=\"k * ") + law + "\""});
    Counters counters;
    return observed(*model, model->start(counters), "wear_flux_cylinder");
  };
  EXPECT_NEAR(rate("f * p * v") / rate("q"), 1, 1e-9);
  EXPECT_NEAR(rate("f * p * v") / (0.3 * 1e-8 * 50 * 100), 1, 5e-3);
}

TEST(PairScene, TheOrderOfTheBodiesDoesNotMatter) {
  const auto one = model_of(scene, {"mesh.factor=2"}),
             other = model_of(scene, {"mesh.factor=2", R"(pair.1.bodies=["plate", "cylinder"])"});
  Counters counters;
  const State start = one->start(counters), same = other->start(counters);
  EXPECT_NEAR(observed(*one, start, "max_pressure") / observed(*other, same, "max_pressure"), 1,
              1e-9);
  EXPECT_THAT(one->remarks, Contains(HasSubstr("\"cylinder\" may touch \"plate\"")));
  EXPECT_THAT(other->remarks, Contains(HasSubstr("\"cylinder\" may touch \"plate\"")));
}

// A block pressed on a ramp that rubs it, which lies under the block for a part of its end nodes:
// an overlap by the whole load would open the contact before a small part of it is carried.
TEST(PairScene, ABlockOnARampIsPressedFromASmallLoadOn) {
  SceneFolder folder;
  folder.write("ramp.geo", R"(al = Pi / 6; L = 10; h = L * Tan(al);
Point(1) = {-3, -6, 0}; Point(2) = {L+3, -6, 0}; Point(3) = {L+3, (L+3)*Tan(al), 0};
Point(4) = {-3, -3*Tan(al), 0};
Point(11) = {0, 0, 0}; Point(12) = {L, h, 0}; Point(13) = {L, h+5, 0}; Point(14) = {0, h+5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(2) = {11, 12, 13, 14}; Plane Surface(2) = {2};
Transfinite Curve {1, 3} = 27; Transfinite Curve {11, 13} = 17;
Transfinite Curve {2, 4, 12, 14} = 9;
Transfinite Surface {1, 2}; Recombine Surface {1, 2};
Physical Surface("ramp") = {1}; Physical Surface("block") = {2};
Physical Curve("base") = {1}; Physical Curve("slope") = {3};
Physical Curve("sole") = {11}; Physical Curve("top") = {13};
)");
  const auto model = make_model(load_scene(folder.write("scene.toml", R"(problem = "worn_body"
mesh.file = "ramp.geo"
body = [ { name = "ramp", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" },
         { name = "block", young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["ramp", "block"], friction = 0.2 } ]
motion = [ { body = "ramp", velocity = [86.60254037844386, 50.0] } ]
support = [ { on = "base" }, { on = "top", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -300.0] } ]
wear = { on = ["slope", "sole"], coefficient = 1e-8 }
time.end = 100.0
integrator = { name = "esdirk-3", rtol = 1e-3 }
)"),
                                           {}, key_table));
  Counters counters;
  const State start = model->start(counters);
  // Friction pulls the block up the ramp.
  const double force = observed(*model, start, "contact_force"), c = std::sqrt(0.75), s = 0.5;
  EXPECT_NEAR(force * (c + 0.2 * s) / 300, 1, 2e-3);
  EXPECT_NEAR(observed(*model, start, "wear_flux_block") / (1e-8 * force * 100), 1, 1e-2);
}

// A cylinder above its plate, or a little below the surface, is brought to where it touches.
TEST(PairScene, ABodyThatOnlyContactHoldsIsBroughtToItsPartner) {
  const auto model = model_of(scene, {"mesh.factor=2"});
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 50, 0.1);
}

// Bodies that heavy loads press deep into each other keep the facets in the middle.
TEST(PairScene, AHeavyLoadLeavesNoHole) {
  const std::string folder = GNOMON_SOURCE_DIR "/problems/";
  std::ifstream stream(folder + scene);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string both = "on = [\"round\", \"face\"]", next = "[wear.surfaces.face]";
  const std::size_t begin = text.find(both), end = text.find(next);
  ASSERT_TRUE(begin < end && end < text.size());
  text.replace(begin, end - begin, "on = [\"face\"]\n");
  const auto model =
      Problems::find("worn_body", "problem")
          .make(parse_scene(text, folder + scene,
                            {"body.plate.material=linear", "body.cylinder.material=linear",
                             "load.1.force=[0.0, -16000.0]", "mesh.factor=2"},
                            key_table));
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  double inner = 0, outer = 0;  // largest pressures
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    double& largest = surface.initial[c][0] < 0.3 ? inner : outer;
    largest = std::max(largest, surface.pressure[c]);
  }
  EXPECT_GT(inner, 0.9 * outer);
}

/// Two blocks on a plate with coarser elements, which carries the pressures of one or of both.
constexpr const char* two_blocks = R"(
Point(1) = {-4, -2, 0}; Point(2) = {4, -2, 0}; Point(3) = {4, 0, 0}; Point(4) = {-4, 0, 0};
Point(11) = {-3, 0, 0}; Point(12) = {-0.1, 0, 0}; Point(13) = {-0.1, 2, 0}; Point(14) = {-3, 2, 0};
Point(21) = {0.1, 0, 0}; Point(22) = {3, 0, 0}; Point(23) = {3, 2, 0}; Point(24) = {0.1, 2, 0};
For k In {0 : 2}
  Line(10 * k + 1) = {10 * k + 1, 10 * k + 2}; Line(10 * k + 2) = {10 * k + 2, 10 * k + 3};
  Line(10 * k + 3) = {10 * k + 3, 10 * k + 4}; Line(10 * k + 4) = {10 * k + 4, 10 * k + 1};
  Curve Loop(k + 1) = {10 * k + 1 : 10 * k + 4}; Plane Surface(k + 1) = {k + 1};
EndFor
Transfinite Curve {1, 3} = 9; Transfinite Curve {2, 4, 12, 14, 22, 24} = 4;
Transfinite Curve {11, 13, 21, 23} = 10;
Transfinite Surface {1, 2, 3}; Recombine Surface {1, 2, 3};
Physical Surface("plate") = {1}; Physical Surface("left") = {2}; Physical Surface("right") = {3};
Physical Curve("base") = {1}; Physical Curve("face") = {3};
Physical Curve("left_foot") = {11}; Physical Curve("left_top") = {13};
Physical Curve("left_sides") = {12, 14};
Physical Curve("right_foot") = {21}; Physical Curve("right_top") = {23};
Physical Curve("right_sides") = {22, 24};
)";

std::string with_two_blocks(const std::string& wear) {
  return R"(problem = "worn_body"
mesh.file = "blocks.geo"
body = [ { name = "plate", young_modulus = 1e5, poisson_ratio = 0.3 },
         { name = "left", young_modulus = 8e4, poisson_ratio = 0.3 },
         { name = "right", young_modulus = 5e4, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["plate", "left"] }, { bodies = ["right", "plate"] } ]
motion = [ { body = "plate", velocity = [100.0, 0.0] } ]
support = [ { on = "base" }, { on = "left_sides", directions = ["x"] },
            { on = "right_sides", directions = ["x"] } ]
load = [ { on = "left_top", force = [0.0, -100.0] }, { on = "right_top", force = [0.0, -50.0] } ]
time.end = 1.0
)" + wear;
}

// Nodes of the plate are slaves of one block and masters of the other.
TEST(PairScene, ForcesOfNeighbouringPairsAreToldApart) {
  SceneFolder folder;
  folder.write("blocks.geo", two_blocks);
  const auto model = make_model(load_scene(
      folder.write("scene.toml",
                   with_two_blocks("wear = { on = [\"left_foot\"], coefficient = 1e-7 }\n")),
      {}, key_table));
  Counters counters;
  const auto pairs = model->examine(model->start(counters)).pairs;
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_NEAR(std::abs(pairs[0].force[1]), 100, 1e-6) << pairs[0].name;
  EXPECT_NEAR(std::abs(pairs[1].force[1]), 50, 1e-6) << pairs[1].name;
}

// Where the foot of the other block is, the root has no value.
TEST(PairScene, ALawNeedsARateOnItsOwnSurfaceAlone) {
  SceneFolder folder;
  folder.write("blocks.geo", two_blocks);
  const std::string wear = R"toml(
[wear]
on = ["left_foot", "right_foot"]
coefficient = 1e-7
[wear.surfaces.left_foot]
rate = "k * p * v * sqrt(0.01 - x0)"
[wear.surfaces.right_foot]
rate = "k * p * v * sqrt(0.01 + x0)"
)toml";
  const auto load = [&](const std::string& text) {
    return make_model(load_scene(folder.write("scene.toml", with_two_blocks(text)), {}, key_table));
  };
  EXPECT_NO_THROW(load(wear));
  std::string wrong = wear;
  wrong.replace(wrong.find("0.01 - x0"), 9, "0.01 + x0");
  EXPECT_THROW(load(wrong), InputError);
}

TEST(PairScene, BodiesThatTurnAboutTheirContactAreToldOf) {
  const auto model =
      model_of("worn_body/ball_on_block.toml",
               {"motion.1.rotation=1.0", "motion.1.axis=[0.0, 0.0, 1.0]",
                "motion.1.velocity=[0.0, 0.0, 0.0]", "motion.1.center=[0.0, 0.0, 0.0]"});
  EXPECT_THAT(model->remarks, Contains(HasSubstr("turn on each other about a point")));
  EXPECT_THAT(model_of("worn_body/ball_on_block.toml")->remarks,
              Not(Contains(HasSubstr("turn on each other"))));
}

}  // namespace
}  // namespace gnomon::pair_scene_test
