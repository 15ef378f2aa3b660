// KEY=VALUE overrides: TOML syntax, bare words as texts, and possible mistakes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/example_table.hpp"

namespace gnomon::override_test {
namespace {

using test::complaint;
using test::example_scene;

const std::string text = "problem = \"example\"\nbody.young_modulus = 640\n";

TEST(Override, ReplacesValuesOfEveryKind) {
  const Scene scene =
      example_scene(text, {"body.young_modulus=2e5", "body.element=plain", "mesh.elements=[8,16]",
                           " mesh.level = 3 ", "output.last=false", "output.times=[1, 2.5]",
                           "output.title=\"a = b\"", "output.limit=7"});
  EXPECT_EQ(scene.real("body.young_modulus"), 2e5);
  EXPECT_EQ(scene.text("body.element"), "plain");
  EXPECT_EQ(scene.integers("mesh.elements"), (std::vector<long>{8, 16}));
  EXPECT_EQ(scene.integer("mesh.level"), 3);
  EXPECT_FALSE(scene.flag("output.last"));
  EXPECT_EQ(scene.reals("output.times"), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(scene.text("output.title"), "a = b");
  EXPECT_EQ(scene.real_if("output.limit"), 7.0);
}

TEST(Override, CanGiveWhatTheFileLacks) {
  EXPECT_EQ(example_scene("", {"problem=example", "body.young_modulus=1"}).text("problem"),
            "example");
}

TEST(Override, IsNamedAsTheOrigin) {
  const Scene scene = example_scene(text, {"mesh.level=3"});
  EXPECT_EQ(scene.where("mesh.level"), "--set mesh.level");
  EXPECT_EQ(scene.where("body.young_modulus"), "example.toml:2: key `body.young_modulus`");
  EXPECT_EQ(scene.where("body.element"), "example.toml: key `body.element`");
}

TEST(BadOverride, IsRefused) {
  EXPECT_EQ(complaint(text, {"mesh.level"}), "--set mesh.level: expected KEY=VALUE");
  EXPECT_EQ(complaint(text, {"=3"}), "--set =3: expected KEY=VALUE");
  EXPECT_EQ(complaint(text, {"mesh.level="}), "--set mesh.level: expected a value after \"=\"");
  EXPECT_EQ(complaint(text, {"mesh.levl=3"}),
            "--set mesh.levl: unknown key, did you mean `mesh.level`?");
  EXPECT_EQ(complaint(text, {"mesh.level=3", "mesh.level=4"}),
            "--set mesh.level: given twice, expected once");
  EXPECT_EQ(complaint(text, {"mesh.elements=[1,"}), "--set mesh.elements: not a TOML value: [1,");
  EXPECT_EQ(complaint(text, {"output.title=max(a, b)"}),
            "--set output.title: not a TOML value: max(a, b), expected quotes around a text: --set "
            "'output.title=\"max(a, b)\"'");
  EXPECT_EQ(complaint(text, {"output.title=a\"b"}), "--set output.title: not a TOML value: a\"b");
  EXPECT_EQ(complaint(text, {"body.young_modulus=-3"}),
            "--set body.young_modulus: expected a number in (0, inf) [MPa], got -3");
  EXPECT_EQ(complaint(text, {"body.young_modulus=stiff"}),
            "--set body.young_modulus: expected a number in (0, inf) [MPa], got \"stiff\"");
  for (const std::string number : {".2", "2."})
    EXPECT_THAT(complaint(text, {"body.young_modulus=" + number}),
                testing::HasSubstr("a digit before and after the point"));
  EXPECT_THAT(complaint(text, {"body.young_modulus=1.2.3"}), testing::EndsWith("\"1.2.3\""));
  for (const std::string table : {"{}", "{level=3}", "{levl=3}"})
    EXPECT_EQ(complaint(text, {"mesh=" + table}),
              "--set mesh: expected one value, as in --set mesh.KEY=VALUE, got a table");
  EXPECT_THAT(complaint(text, {"mesh.level={}"}), testing::EndsWith("got a table"));
  EXPECT_THAT(complaint(text, {"mesh.level={}"}), testing::Not(testing::HasSubstr("KEY=VALUE")));
  EXPECT_EQ(complaint(text, {"mesh.levl={}"}),
            "--set mesh.levl: unknown key, did you mean `mesh.level`?");
  EXPECT_EQ(complaint(text, {"problem=exmple"}), "--set problem: unknown problem \"exmple\"");
}

TEST(BadOverride, MayNotNestAbsurdly) {
  std::string key, brackets;
  for (int i = 0; i < 50000; ++i) key += "a.", brackets += '[';
  EXPECT_EQ(complaint(text, {key + "a=1"}),
            "--set " + key.substr(0, 40) + "...: a key of more than 32 parts, expected at most 32");
  EXPECT_EQ(complaint(text, {"mesh.level={" + key + "a=1}"}),
            "--set mesh.level: a key of more than 32 parts, expected at most 32");
  EXPECT_EQ(complaint(text, {"mesh.level=" + brackets}),
            "--set mesh.level: arrays or tables nested more than 32 deep, expected at most 32");
}

TEST(BadOverride, CannotSmuggleInASecondKey) {
  EXPECT_NE(complaint(text, {"mesh.level=3\nmesh.elements=[1,1]"}), "");
}

}  // namespace
}  // namespace gnomon::override_test
