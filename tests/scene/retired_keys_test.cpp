// Scenes with keys of earlier versions are those with the keys of today, or are refused in one line
// that names them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>

namespace gnomon::retired_keys_test {
namespace {

using Overrides = std::vector<std::string>;
using ::testing::HasSubstr;

Scene scene_of(const std::string& text, const Overrides& overrides = {}) {
  return parse_scene(
      "problem = \"worn_body\"\ntime.end = 1.0\nintegrator.name = \"bdf\"\n"
      "wear.on = [\"a\"]\ncounter_body.shape = \"ball\"\n" +
          text,
      "s.toml", overrides, key_table);
}

Scene of_one_body(const std::string& text, const Overrides& overrides = {}) {
  return scene_of("body.young_modulus = 1.0\nbody.poisson_ratio = 0.3\n" + text, overrides);
}

std::string refusal(const std::string& text, const Overrides& overrides = {}) {
  try {
    of_one_body(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RetiredKeys, AreAcceptedWhereTheyChangeNothing) {
  EXPECT_EQ(refusal("output.last = true"), "accepted");
  EXPECT_EQ(refusal("output.checkpoints = 200"), "accepted");
  EXPECT_EQ(refusal("shape.augmentation = 2.0"), "accepted");
  EXPECT_EQ(refusal("shape.young_modulus = 20.0"), "accepted");
  EXPECT_THAT(refusal("output.last = false"),
              HasSubstr("key `output.last`: expected none: the end of a run is always stored"));
}

TEST(RetiredKeys, AreReadAsThoseInTheirPlace) {
  const std::vector<std::pair<const char*, const char*>> same = {
      {"mesh.geometry = \"a.geo\"", "mesh.file = \"a.geo\""},
      {"body.plane = \"axisymmetric\"", "model.plane = \"axisymmetric\""},
      {"body.kinematics = \"small\"", "body.material = \"linear\""},
      {"body.kinematics = \"small\"\nbody.material = \"blatz-ko\"", "body.material = \"linear\""},
      {"body.kinematics = \"finite\"\nbody.material = \"blatz-ko\"",
       "body.material = \"blatz-ko\""},
      {"wear.tables.a = { x = [0.0], y = [1.0] }", "tables.a = { x = [0.0], y = [1.0] }"},
      {"cycle.tables.a = { x = [0.0], y = [1.0] }", "tables.a = { x = [0.0], y = [1.0] }"},
      {"counter_body.apex = [0.0, 1.0]", "counter_body.center = [0.0, 1.0]"},
      {"counter_body.point = [0.0, 1.0]", "counter_body.center = [0.0, 1.0]"},
      {"counter_body.minor_radius = 2.0", "counter_body.radius = 2.0"},
      {"counter_body.file = \"cam.csv\"", "counter_body.points = \"cam.csv\""},
      {"counter_body.closed = true", "counter_body.side = \"inside\""},
      {"counter_body.closed = false\ncounter_body.side = \"right\"",
       "counter_body.side = \"right\""},
      {"counter_body.closed = false\ncounter_body.concave = false", ""},
      {"counter_body.concave = true", "counter_body.side = \"outside\""},
      {"counter_body.closed = true\ncounter_body.concave = true",
       "counter_body.side = \"outside\""},
      {"counter_body.concave = true\ncounter_body.closed = true",
       "counter_body.side = \"outside\""},
      {"counter_body.motion.out_of_plane = 3.0", "counter_body.motion.velocity = [0.0, 0.0, 3.0]"},
      {"counter_body.motion = { out_of_plane = 3, velocity = [1.0, 2.0] }",
       "counter_body.motion.velocity = [1.0, 2.0, 3.0]"},
  };
  for (const auto& [before, now] : same) {
    EXPECT_EQ(of_one_body(before).resolved(), of_one_body(now).resolved()) << before;
    EXPECT_EQ(of_one_body(before), of_one_body(now)) << before;
  }
}

TEST(RetiredKeys, OfEachBodyToo) {
  const std::string bodies = "body = [{ young_modulus = 1.0, poisson_ratio = 0.3, ";
  EXPECT_EQ(scene_of(bodies + "kinematics = \"small\" }]"),
            scene_of(bodies + "material = \"linear\" }]"));
}

TEST(RetiredKeys, MayBeOverriddenAndOverride) {
  const std::string pin = "body.plane = \"axisymmetric\"\ncounter_body.concave = true\n";
  EXPECT_EQ(of_one_body(pin, {"model.plane=strain"}).text("model.plane"), "strain");
  EXPECT_EQ(of_one_body(pin, {"body.plane=strain"}).text("model.plane"), "strain");
  EXPECT_EQ(of_one_body(pin, {"counter_body.concave=false"}).text("counter_body.side"), "inside");
  const Scene sliding = of_one_body("counter_body.motion.velocity = [1.0, 2.0]",
                                    {"counter_body.motion.out_of_plane=3.0"});
  EXPECT_EQ(sliding.reals("counter_body.motion.velocity"), (std::vector<double>{1, 2, 3}));
  const Scene linear = of_one_body("body.kinematics = \"small\"", {"body.kinematics=finite"});
  EXPECT_EQ(linear.text("body.material"), "neo-hookean");
}

TEST(RetiredKeys, AreRefusedWithTheKeyInTheirPlace) {
  EXPECT_EQ(refusal("mesh = { geometry = \"a.geo\", file = \"a.msh\" }"),
            "s.toml:8: key `mesh.geometry`: expected mesh.file in its place");
  EXPECT_THAT(refusal("wear.tables.a.x = [0.0]\ncycle.tables.a.x = [1.0]"),
              HasSubstr("key `cycle.tables.a.x`: expected tables.*.x in its place"));
  EXPECT_THAT(refusal("counter_body.side = \"left\"\ncounter_body.closed = true"),
              HasSubstr("key `counter_body.closed`: expected counter_body.side in its place"));
  EXPECT_THAT(refusal("counter_body.side = \"left\"\ncounter_body.concave = true"),
              HasSubstr("key `counter_body.concave`: expected counter_body.side in its place"));
  EXPECT_THAT(refusal("body.kinematics = \"tiny\""),
              HasSubstr("expected body.material = \"linear\""));
  // The override would lose a part of what the file says.
  EXPECT_THAT(refusal("counter_body.motion.out_of_plane = 3.0",
                      {"counter_body.motion.velocity=[1.0, 2.0]"}),
              HasSubstr("expected counter_body.motion.velocity with a third number"));
}

}  // namespace
}  // namespace gnomon::retired_keys_test
