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
  EXPECT_EQ(refusal("body.kinematics = \"finite\""), "accepted");
  EXPECT_EQ(refusal("counter_body.closed = false\ncounter_body.concave = false"), "accepted");
  EXPECT_EQ(
      refusal("shape.young_modulus = \"foo\""),
      "s.toml:8: key `shape.young_modulus`: expected none, or a number, which changes nothing");
  EXPECT_THAT(refusal("output.last = false"),
              HasSubstr("key `output.last`: expected none: the end of a run is always stored"));
}

TEST(RetiredKeys, AreReadAsThoseInTheirPlace) {
  const std::vector<std::pair<const char*, const char*>> same = {
      {"mesh.geometry = \"a.geo\"", "mesh.file = \"a.geo\""},
      {"body.plane = \"axisymmetric\"", "model.plane = \"axisymmetric\""},
      {"wear.tables.a = { x = [0.0], y = [1.0] }", "tables.a = { x = [0.0], y = [1.0] }"},
      {"cycle.tables.a = { x = [0.0], y = [1.0] }", "tables.a = { x = [0.0], y = [1.0] }"},
      {"counter_body.apex = [0.0, 1.0]", "counter_body.center = [0.0, 1.0]"},
      {"counter_body.point = [0.0, 1.0]", "counter_body.center = [0.0, 1.0]"},
      {"counter_body.minor_radius = 2.0", "counter_body.radius = 2.0"},
      {"counter_body.file = \"cam.csv\"", "counter_body.points = \"cam.csv\""},
  };
  for (const auto& [before, now] : same) {
    EXPECT_EQ(of_one_body(before).resolved(), of_one_body(now).resolved()) << before;
    EXPECT_EQ(of_one_body(before), of_one_body(now)) << before;
  }
}

TEST(RetiredKeys, MayBeOverriddenAndOverride) {
  const std::string pin = "body.plane = \"axisymmetric\"\n";
  EXPECT_EQ(of_one_body(pin, {"model.plane=strain"}).text("model.plane"), "strain");
  EXPECT_EQ(of_one_body(pin, {"body.plane=strain"}).text("model.plane"), "strain");
}

TEST(RetiredKeys, OfTheSameValueMayBeGivenTwice) {
  const std::string both = "wear.tables.a.x = [0.0]\ncycle.tables.a.x = [0.0]\ntables.a.y = [1.0]";
  EXPECT_EQ(of_one_body(both), of_one_body("tables.a = { x = [0.0], y = [1.0] }"));
}

TEST(RetiredKeys, AreRefusedWithTheKeyInTheirPlace) {
  EXPECT_EQ(refusal("mesh = { geometry = \"a.geo\", file = \"a.msh\" }"),
            "s.toml:8: key `mesh.geometry`: expected mesh.file in its place");
  EXPECT_THAT(refusal("wear.tables.a.x = [0.0]\ncycle.tables.a.x = [1.0]"),
              HasSubstr("key `cycle.tables.a.x`: expected tables.*.x in its place"));
  const std::vector<std::pair<const char*, const char*>> refused = {
      {"body.kinematics = \"small\"", "expected body.material = \"linear\""},
      {"counter_body.closed = true", "expected counter_body.side in its place: \"inside\""},
      {"counter_body.concave = true", "expected counter_body.side in its place: \"outside\""},
      {"counter_body.motion.out_of_plane = 3.0",
       "expected counter_body.motion.velocity with a third number"},
  };
  for (const auto& [before, now] : refused) EXPECT_THAT(refusal(before), HasSubstr(now));
  EXPECT_THAT(refusal("", {"body.kinematics=small"}), HasSubstr("body.material = \"linear\""));
}

TEST(RetiredKeys, OfEachBodyToo) {
  EXPECT_THROW(scene_of("body = [{ young_modulus = 1.0, poisson_ratio = 0.3, "
                        "kinematics = \"small\" }]"),
               InputError);
  EXPECT_EQ(scene_of("body = [{ young_modulus = 1.0, poisson_ratio = 0.3, "
                     "kinematics = \"finite\" }]"),
            scene_of("body = [{ young_modulus = 1.0, poisson_ratio = 0.3 }]"));
}

}  // namespace
}  // namespace gnomon::retired_keys_test
