// The tables of keys are consistent for all registered problems.

#include <gtest/gtest.h>

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <set>
#include <stdexcept>

#include "scene/example_table.hpp"
#include "scene/key_check.hpp"
#include "scene/toml_reader.hpp"
#include "scene/toml_text.hpp"

namespace gnomon::key_table_test {
namespace {

std::vector<Key> all_keys() {
  std::vector<Key> keys = run_keys();
  keys.insert(keys.end(), worn_body_keys(2).begin(), worn_body_keys(2).end());
  for (const std::string& problem : Problems::names())
    for (const Key& key : key_table(problem)) keys.push_back(key);
  return keys;
}

TEST(KeyTables, DefaultsAreAcceptable) {
  for (const Key& key : all_keys()) {
    if (!key.default_value) continue;
    const auto raw = read_toml_value(toml_text(*key.default_value));
    ASSERT_TRUE(raw) << key.name;
    const auto checked = check_value(key, *raw);
    ASSERT_TRUE(std::holds_alternative<SceneValue>(checked)) << key.name;
    EXPECT_TRUE(std::get<SceneValue>(checked) == key.default_value) << key.name;
  }
}

TEST(KeyTables, EveryKeyIsExplainedInOneLine) {
  for (const Key& key : all_keys()) {
    EXPECT_FALSE(key.help.empty()) << key.name;
    EXPECT_EQ(key.help.find('\n'), std::string::npos) << key.name;
    EXPECT_FALSE(key.default_value && !key.absent_meaning.empty()) << key.name;
  }
}

TEST(KeyTables, NamesAreUnique) {
  for (const std::string& problem : Problems::names()) {
    std::set<std::string> names;
    for (const Key& key : key_table(problem))
      EXPECT_TRUE(names.insert(key.name).second) << key.name << " of " << problem;
  }
}

TEST(KeyTables, IntegratorsAreChoices) {
  ASSERT_FALSE(Problems::names().empty());
  for (const Key& key : key_table(Problems::names().front())) {
    if (key.name != "integrator.name") continue;
    EXPECT_EQ(key.choices, Integrators::names());
  }
}

TEST(KeyTables, UnknownProblemNamesTheNearest) {
  try {
    key_table("pin_on_flt");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "unknown problem \"pin_on_flt\", did you mean \"pin_on_flat\"?");
  }
}

TEST(DescribeKeys, TellsTypeRangeUnitAndDefault) {
  const std::string text = describe_keys(test::example_table("example"));
  EXPECT_NE(text.find("body.young_modulus: stiffness\n    a number in (0, inf) [MPa]; required\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("mesh.elements: elements\n    an array of 2 integers in [1, inf); default "
                      "[4, 4]\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("optional, absent: none"), std::string::npos) << text;
}

TEST(Access, WrongKeyOrKindIsAProgrammingError) {
  const Scene scene = test::example_scene("problem = \"example\"\nbody.young_modulus = 1\n");
  EXPECT_EQ(scene.real("body.young_modulus"), 1.0);  // an integer widens
  EXPECT_THROW(scene.integer("body.young_modulus"), std::logic_error);
  EXPECT_THROW(scene.real("body.density"), std::logic_error);
  EXPECT_THROW(scene.real("output.limit"), std::logic_error);
  EXPECT_FALSE(scene.has("output.limit"));
  EXPECT_EQ(scene.real_if("output.limit"), std::nullopt);
}

TEST(NearestName, FindsWhatWasMeant) {
  const std::vector<std::string> names = {"backward-euler", "bdf", "forward-euler"};
  EXPECT_EQ(nearest_name("bakward-euler", names), "backward-euler");
  EXPECT_EQ(nearest_name("fricton.coefficient", {"wear.coefficient", "friction.coefficient"}),
            "friction.coefficient");
  EXPECT_EQ(nearest_name("fdb", names), "");
  EXPECT_EQ(nearest_name("bfd", names), "bdf");
  EXPECT_EQ(nearest_name("forward", names), "forward-euler");
  EXPECT_EQ(nearest_name("leapfrog", names), "");
  EXPECT_EQ(nearest_name("integrator.step.foo", {"time.end", "integrator.step"}),
            "integrator.step");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), names), "");
}

TEST(UnreadKeys, AreThoseThatAreGivenAndNotAskedFor) {
  const Scene scene = test::example_scene(
      "problem = \"example\"\nbody.young_modulus = 640\nmesh.level = 3\noutput.title = \"\"\n");
  scene.text("problem");
  EXPECT_EQ(scene.unread_keys(),  // the title is the default
            (std::vector<std::string>{"body.young_modulus", "mesh.level"}));
  scene.real("body.young_modulus");
  scene.with("body.poisson_ratio", 0.2).integer("mesh.level");  // also in a scene made of it
  EXPECT_TRUE(scene.unread_keys().empty());
}

TEST(NearestName, KnowsWhatOthersCallIt) {
  const std::vector<std::string> keys = {
      "body.young_modulus",       "body.poisson_ratio", "wear.coefficient", "friction.coefficient",
      "counter_body.press.force", "load.1.force",       "integrator.step"};
  EXPECT_EQ(nearest_name("body.E", keys), "body.young_modulus");
  EXPECT_EQ(nearest_name("E", keys), "body.young_modulus");
  EXPECT_EQ(nearest_name("body.nu", keys), "body.poisson_ratio");
  EXPECT_EQ(nearest_name("friction.mu", keys), "friction.coefficient");
  EXPECT_EQ(nearest_name("wear.k", keys), "wear.coefficient");
  EXPECT_EQ(nearest_name("load.1.F", keys), "load.1.force");
  EXPECT_EQ(nearest_name("counter_body.F", keys), "counter_body.press.force");
  EXPECT_EQ(nearest_name("time.dt", keys), "integrator.step");
  EXPECT_EQ(nearest_name("E", {"mesh.level"}), "");  // only what there is
  const std::vector<std::string> methods = {"backward-euler", "bdf", "erk-4", "theta"};
  EXPECT_EQ(nearest_name("rk4", methods), "erk-4");
  EXPECT_EQ(nearest_name("rk45", methods), "erk-4");
  EXPECT_EQ(nearest_name("implicit-euler", methods), "backward-euler");
  EXPECT_EQ(nearest_name("crank-nicolson", methods), "theta");
}

TEST(TomlText, RealsReadBackExactlyAndLookTidy) {
  EXPECT_EQ(toml_text(1e-7), "1e-7");
  EXPECT_EQ(toml_text(640.0), "640.0");
  EXPECT_EQ(toml_text(1e300), "1e+300");
  EXPECT_EQ(toml_text(-0.1), "-0.1");
  EXPECT_EQ(toml_text(std::string("a\"b\\c\n")), "\"a\\\"b\\\\c\\u000A\"");
}

}  // namespace
}  // namespace gnomon::key_table_test
