// Arrays of tables in a scene, [[load]], and arrays of texts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::array_of_tables_test {
namespace {

std::vector<Key> table(const std::string&) {
  return {{.name = "problem", .kind = KeyKind::text},
          {.name = "load.#.on", .kind = KeyKind::text, .absent_meaning = "none"},
          {.name = "load.#.force", .kind = KeyKind::reals, .absent_meaning = "none"},
          {.name = "constants.*", .absent_meaning = "none"},
          {.name = "names", .kind = KeyKind::texts, .default_value = std::vector<std::string>{}}};
}

Scene scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene("problem = \"p\"\n" + text, "s.toml", overrides, table);
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    scene(text, overrides);
  } catch (const InputErrors& errors) {
    return std::to_string(errors.lines.size()) + " mistakes";
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

constexpr const char* two_loads =
    "names = [\"a\", \"b c\"]\n"
    "[[load]]\non = \"top\"\nforce = [1, 2.5]\n"
    "[[load]]\non = \"side\"\n";

TEST(ArraysOfTables, HaveNumbersFromOne) {
  const Scene s = scene(two_loads);
  EXPECT_EQ(s.chosen_names("load.#.on"), (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(s.text("load.1.on"), "top");
  EXPECT_EQ(s.text("load.2.on"), "side");
  EXPECT_EQ(s.reals("load.1.force"), (std::vector<double>{1, 2.5}));
  EXPECT_FALSE(s.knows("load.2.force"));
  EXPECT_EQ(s.where("load.2.on"), "s.toml:7: key `load.2.on`");
}

TEST(ArraysOfTables, AreOverriddenByNumber) {
  EXPECT_EQ(scene(two_loads, {"load.2.on=back"}).text("load.2.on"), "back");
  EXPECT_EQ(scene(two_loads, {"load.2.force=[3.0]"}).reals("load.2.force"), std::vector<double>{3});
}

TEST(ArraysOfTables, SurviveTheResolvedScene) {
  const Scene s = scene(two_loads);
  EXPECT_EQ(parse_scene(s.resolved(), "r.toml", {}, table), s);
}

TEST(ArraysOfTables, OfUnknownKeysAreRefusedAtTheirLine) {
  EXPECT_EQ(refusal("[[load]]\nonn = \"top\"\n"),
            "s.toml:3: key `load.1.onn`: unknown key, did you mean `load.1.on`?");
  for (const char* word : {"node", "group"})
    EXPECT_EQ(
        refusal("[[load]]\n" + std::string(word) + " = 3\n"),
        "s.toml:3: key `load.1." + std::string(word) + "`: unknown key, did you mean `load.1.on`?");
}

TEST(ArraysOfTables, GivenAsATableAreRefusedOnce) {
  for (const char* text : {"[load]\non = \"top\"\nforce = [1.0]\nspeed = 3\n",
                           "load.on = \"top\"\nload.force = [1.0]\n",
                           "[load.first]\non = \"top\"\nforce = [1.0]\n", "load = 3\n"})
    EXPECT_THAT(refusal(text), testing::ContainsRegex("key `load[.a-z]*`: expected an array of "
                                                      "tables, \\[\\[load\\]\\], got (3|a table)"))
        << text;
  EXPECT_EQ(refusal("", {"load.on=top"}),
            "--set load.on: expected the number of a [[load]], as in load.1.on");
  EXPECT_EQ(refusal("", {"load.#.on=top"}),
            "--set load.#.on: expected the number of a [[load]], as in load.1.on");
  EXPECT_EQ(refusal("", {"load.0.on=top"}),
            "--set load.0.on: unknown key, did you mean `load.1.on`?");
}

TEST(ArraysOfTexts, AreReadAndChecked) {
  EXPECT_EQ(scene(two_loads).texts("names"), (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(refusal("names = [\"a\", 3]\n"),
            "s.toml:2: key `names`: expected a text or an array of texts, got 3 at place 2");
  EXPECT_EQ(scene("names = \"a\"\n").texts("names"), std::vector<std::string>{"a"});
  EXPECT_EQ(scene("", {"names=b"}).texts("names"), std::vector<std::string>{"b"});
}

}  // namespace
}  // namespace gnomon::array_of_tables_test
