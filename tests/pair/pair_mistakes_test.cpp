// What is wrong with two bodies is told in a line: where it is, and what was expected.

#include <fstream>
#include <gnomon/base/error.hpp>
#include <iterator>

#include "support/problem_run.hpp"

namespace gnomon::pair_mistakes_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// A change of the scene of a cylinder on a plate: a text for another one, or a key.
struct Mistake {
  std::string kind;
  std::string from, to;
  Overrides keys;
  std::string message;
};

Mistake text(const char* kind, const char* from, const char* to, const char* message) {
  return {kind, from, to, {}, message};
}
Mistake key(const char* kind, const char* value, const char* message) {
  return {kind, "", "", {value}, message};
}
Mistake history(const char* kind, const char* times, const char* factors, const char* message) {
  return {kind,
          "",
          "",
          {std::string("load.1.times=") + times, std::string("load.1.factors=") + factors},
          message};
}

const std::string folder = GNOMON_SOURCE_DIR "/problems/worn_body/";

/// The message, or the remarks where the scene is accepted.
std::string said(const Mistake& mistake) {
  std::ifstream stream(folder + "cylinder_on_plate.toml");
  std::string scene{std::istreambuf_iterator<char>(stream), {}};
  if (!mistake.from.empty()) {
    const std::size_t at = scene.find(mistake.from);
    EXPECT_NE(at, std::string::npos) << mistake.from;
    scene.replace(at, mistake.from.size(), mistake.to);
  }
  Overrides keys = mistake.keys;
  keys.push_back("mesh.factor=2");
  try {
    const Scene parsed = parse_scene(scene, folder + "scene.toml", keys, key_table);
    const std::unique_ptr<Model> model = Problems::find("worn_body", "problem").make(parsed);
    std::string remarks;
    for (const std::string& remark : model->remarks) remarks += remark + "\n";
    return remarks;
  } catch (const InputError& error) {
    return error.what();
  }
}

void expect_told(const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes) {
    SCOPED_TRACE(mistake.kind);
    EXPECT_THAT(said(mistake), HasSubstr(mistake.message));
  }
}

constexpr const char* motion = "velocity = [100.0, 0.0]";

TEST(PairMistakes, OfPairs) {
  expect_told({
      text("none", "bodies = [\"cylinder\", \"plate\"]\n", "",
           "expected a [[pair]] with the bodies that touch each other"),
      key("one body", R"(pair.1.bodies=["plate"])", "the names of two bodies"),
      key("numbers", "pair.1.bodies=[0.0, 0.0]", "expected a text or an array of texts"),
      key("a body with itself", R"(pair.1.bodies=["plate", "plate"])",
          "the names of two bodies, or pair.surfaces"),
      {"one body of two",
       "",
       "",
       {R"(pair.1.bodies=["plate", "plate"])", R"(pair.1.surfaces=["round", "face"])"},
       "pair.1.bodies: expected two bodies, or \"cylinder\" bonded to \"plate\": "},
      key("three bodies", R"(pair.1.bodies=["plate", "cylinder", "plate"])",
          "the names of two bodies"),
      key("an unknown body", R"(pair.1.bodies=["plate", "disc"])",
          "expected names of [[body]], \"cylinder\", \"plate\", got \"disc\""),
      key("a surface of one body", R"(pair.1.surfaces=["round"])", "surfaces of both bodies"),
      key("an unknown surface", R"(pair.1.surfaces=["round", "faze"])", "did you mean \"face\"?"),
      key("a body for a surface", R"(pair.1.surfaces=["cylinder", "plate"])",
          "\"cylinder\" is a group of surfaces, expected one of curves"),
      text("twice", "[[motion]]", "[[pair]]\nbodies = [\"cylinder\", \"plate\"]\n[[motion]]",
           "key `pair.2.bodies`: expected each pair of bodies once"),
      text("twice, reversed", "[[motion]]",
           "[[pair]]\nbodies = [\"plate\", \"cylinder\"]\n[[motion]]",
           "key `pair.2.bodies`: expected each pair of bodies once"),
      key("negative friction", "pair.1.friction=-0.1", "expected a number in [0, 1e+30], got -0.1"),
      key("friction as text", R"(pair.1.friction="high")", "expected a number"),
      key("backs of the bodies", R"(pair.1.surfaces=["top", "base"])",
          "no boundary of \"cylinder\" faces \"plate\""),
      key("sides of the bodies", R"(pair.1.surfaces=["cylinder_axis", "plate_axis"])",
          "no boundary of \"cylinder\" faces \"plate\""),
      key("a back", R"(pair.1.surfaces=["round", "base"])",
          "no boundary of \"cylinder\" faces \"plate\""),
      key("a side that wears, up to whose edges contact is looked for",
          R"(wear.on=["cylinder_axis"])",
          "wear.on: expected surfaces of \"cylinder\" and \"plate\" that face each other, but "
          "\"cylinder_axis\" faces none"),
      key("a rigid partner, too", "counter_body.shape=plane", "expected none beside [[pair]]"),
      key("a gap between meshes", "contact.initial_gap=0.1", "the meshes say where the bodies are"),
  });
}

TEST(PairMistakes, OfMotions) {
  expect_told({
      key("an unknown body", "motion.1.body=disc", "expected a body of a [[pair]]"),
      text("no body", "[[motion]]\nbody = \"plate\"", "[[motion]]",
           "[[motion]] number 1: missing key `body`"),
      text("two of a body", "[[support]]",
           "[[motion]]\nbody = \"plate\"\nvelocity = [1.0, 0.0]\n[[support]]",
           "expected one [[motion]] for each body, got two for \"plate\""),
      key("no centre", "motion.1.rotation=1.0", "expected also motion.1.center"),
      key("along the normal", "motion.1.velocity=[0.0, 1.0]",
          "move towards each other, and hardly slide"),
      key("none", "motion.1.velocity=[0.0, 0.0]", "do not slide on each other"),
      text("a cycle without a period", motion, "cycle = { x = \"0.1*sin(2*pi*tau)\" }",
           "expected also [cycle] period"),
      text("an unknown direction", motion, "cycle = { q = \"0.1*tau\" }",
           "did you mean `motion.1.cycle.x`?"),
      text("a force over the cycle", "[time]",
           "[cycle]\nperiod = 1.0\nphases = 4\nforce = \"1\"\n[time]",
           "expected cycle.load beside [[pair]]"),
      text("a path that ends elsewhere", motion,
           "cycle = { x = \"0.01*tau\" }\n[cycle]\nperiod = 1.0\nphases = 2",
           "[[motion]] of \"plate\": cycle.x ends 0.01 mm from where it begins"),
      text("a cycle of nothing", "[time]", "[cycle]\nperiod = 1.0\nphases = 2\n[time]",
           "key `cycle.period`: expected what changes over the cycle: motion.#.cycle of a body"),
  });
}

TEST(PairMistakes, OfBodies) {
  expect_told({
      text("no name", "name = \"plate\"\n", "", "expected names of [[body]]"),
      key("an unknown group", "body.1.name=brass", "expected names of [[body]]"),
      text("one", "[[body]]\nname = \"plate\"\nyoung_modulus = 210e3\npoisson_ratio = 0.3\n", "",
           "expected names of [[body]], \"cylinder\", got \"plate\""),
      text("[body], too", "[[pair]]", "[body]\nyoung_modulus = 1e3\n[[pair]]",
           "expected [[body]] for each of several tables"),
      key("a negative modulus", "body.plate.young_modulus=-1.0", "expected a number in"),
      text("no modulus", "young_modulus = 210e3\n", "", "missing key `young_modulus`"),
      key("no volume", "body.plate.poisson_ratio=0.5", "expected a number in [0, 0.5)"),
      key("two meshes", R"(body.plate.mesh="cylinder_on_plate.geo")",
          "expected none beside body.#.mesh"),
      text("no mesh", "file = \"cylinder_on_plate.geo\"", "", "section [mesh]: expected `file`"),
  });
}

TEST(PairMistakes, OfWhatHoldsAndPressesThem) {
  expect_told({
      text("nothing holds the plate", "[[support]]\non = \"base\"\n", "",
           "expected loads that press \"plate\""),
      text("the cylinder may turn over",
           "[[support]]\non = \"cylinder_axis\"\ndirections = [\"x\"]\n", "",
           "\"cylinder\" can turn"),
      key("a load that pulls", "load.1.force=[0.0, 50.0]",
          "\"cylinder\" can move along y, and its loads pull it off there"),
      history("a load that ends", "[0.0, 1000.0]", "[1.0, 0.0]",
              "at t = 1000 s \"cylinder\" can move along y, and no load acts on it in this way"),
      history("a load that never acts", "[0.0, 1000.0]", "[0.0, 0.0]",
              "\"cylinder\" can move along y, and no load acts on it in this way"),
      history("a load that begins", "[0.0, 1000.0]", "[0.0, 1.0]",
              "at t = 0 s \"cylinder\" can move along y, and no load acts on it in this way"),
      history("a load that pulls before a jump", "[0.0, 500.0, 500.0]", "[1.0, -1.0, 1.0]",
              "at t = 500 s \"cylinder\" can move along y, and its loads pull it off there"),
      text("a load that pulls in a cycle", "[time]",
           "[cycle]\nperiod = 1.0\nphases = 4\nload = \"1 + 1.5*cos(2*pi*tau)\"\n[time]",
           "of the cycle \"cylinder\" can move along y, and its loads pull it off there"),
      {"moduli in GPa",
       "",
       "",
       {"body.cylinder.young_modulus=110.0", "body.plate.young_modulus=210.0"},
       "are moduli given in MPa, and loads in N?"},
      key("no load", "load.1.force=[0.0, 0.0]", "a [[load]] against the other body"),
      key("a load on what is held", R"(load.1.on="base")", "expected loads that press"),
      key("a load on a body", R"(load.1.on="cylinder")",
          "\"cylinder\" is a group of surfaces, expected one of curves"),
  });
}

TEST(PairMistakes, OfWear) {
  expect_told({
      key("a surface that meets nothing", R"(wear.on=["base"])", "touch another body"),
      key("an unknown surface", R"(wear.on=["round", "faze"])", "did you mean \"face\"?"),
      key("a law of no surface", "wear.surfaces.base.coefficient=1e-8", "expected one of wear.on"),
      text("a coefficient of no surface alone", "[wear.surfaces.round]", "[wear.surfaces.base]",
           "key `wear.surfaces.base.coefficient`: expected one of"),
      key("a negative coefficient", "wear.surfaces.round.coefficient=-1e-8",
          "expected a number in [0, 1e+30]"),
      text("no coefficient", "coefficient = 1e-8", "rate = \"k*p*v\"",
           "key `wear.coefficient`: missing, expected a number [1/MPa]: the wear law reads it, as "
           "k, of \"round\"; wear.surfaces.round.coefficient"),
      key("no track", "wear.surfaces.face.path=0.0",
          "expected the length of the whole track, of which the mesh is a part, got 0 mm"),
      key("a negative track", "wear.surfaces.face.path=-5.0", "of the whole track"),
      key("a track of a body at rest", "wear.surfaces.round.path=100.0",
          "expected a [[motion]] with body = \"cylinder\", which has none"),
      {"a track across the motion",
       "",
       "",
       {"wear.surfaces.face.path=100.0", "motion.1.velocity=[0.0, 100.0]"},
       "expected a [[motion]] along the surface"},
  });
  // It is meant.
  EXPECT_THAT(said(key("zero", "wear.surfaces.face.coefficient=0.0", "")),
              Not(HasSubstr("the wear law is 0")));
}

}  // namespace
}  // namespace gnomon::pair_mistakes_test
