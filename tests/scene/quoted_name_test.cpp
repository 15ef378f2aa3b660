// Names of any kind as parts of keys: [wear.surfaces."upper side"].

#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/toml_key.hpp>

namespace gnomon::quoted_name_test {
namespace {

std::vector<Key> table(const std::string&) {
  return {{.name = "problem", .kind = KeyKind::text},
          {.name = "law.\"*\".rate", .absent_meaning = "none"},
          {.name = "body.#.name", .kind = KeyKind::text, .absent_meaning = "none"},
          {.name = "body.#.modulus", .absent_meaning = "none"},
          {.name = "constants.*", .absent_meaning = "none"}};
}

Scene scene(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene("problem = \"p\"\n" + text, "s.toml", overrides, table);
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    scene(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

const std::vector<std::string> names = {"bare",    "upper side", "a.b", "12", "say \"so\"",
                                        "back\\s", "a = b",      "ö",   "*",  "#"};

TEST(QuotedNames, AreFoundAsTheirKey) {
  for (const std::string& name : names) {
    const std::string part = toml_key(name), key = "law." + part + ".rate";
    const Scene from_file = scene("[law." + part + "]\nrate = 3\n");
    EXPECT_EQ(from_file.chosen_names("law.\"*\".rate"), std::vector<std::string>{part});
    EXPECT_EQ(from_file.real(key), 3) << name;
    EXPECT_EQ(scene("", {key + "=3"}), from_file) << name;
    EXPECT_EQ(parse_scene(from_file.resolved(), "r.toml", {}, table), from_file) << name;
  }
}

TEST(QuotedNames, MayHaveSingleQuotes) {
  EXPECT_EQ(scene("[law.'a b']\nrate = 3\n").real("law.\"a b\".rate"), 3);
  EXPECT_EQ(scene("", {"law.'a b'.rate=3"}).real("law.\"a b\".rate"), 3);
}

TEST(QuotedNames, AreAskedForWhereTheyAreMissing) {
  EXPECT_EQ(refusal("[law.a.b]\nrate = 3\n"),
            "s.toml:3: key `law.a.b.rate`: expected quotes around the name, law.\"a.b\".rate");
  EXPECT_EQ(refusal("", {"law.a b.rate=3"}),
            "--set law.a b.rate: expected quotes around the name, law.\"a b\".rate");
  EXPECT_EQ(refusal("", {"law.\"a b.rate=3"}),
            "--set law.\"a b.rate: expected a key of TOML before \"=\"");
}

TEST(QuotedNames, OfTablesAreAskedForToo) {
  const std::string text = "[[body]]\nname = \"base plate\"\nmodulus = 1\n";
  EXPECT_EQ(refusal(text, {"body.base plate.modulus=3"}),
            "--set body.base plate.modulus: expected quotes around the name, body.\"base "
            "plate\".modulus");
  EXPECT_EQ(scene(text, {"body.\"base plate\".modulus=3"}).real("body.1.modulus"), 3);
}

TEST(QuotedNames, AreNoNamesOfConstants) {
  EXPECT_EQ(refusal("[constants]\n\"a b\" = 3\n"),
            "s.toml:3: key `constants.\"a b\"`: expected letters, digits and underscores, no digit "
            "first, in the place of * in `constants.*`");
}

}  // namespace
}  // namespace gnomon::quoted_name_test
