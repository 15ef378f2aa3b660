// One case for every kind of mistake in a scene: file, line, key and what was expected are named.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "scene/example_table.hpp"

namespace gnomon::bad_scene_test {
namespace {

using test::complaint;

/// A scene that is right except for its line 4.
std::string with_line_4(const std::string& line) {
  return "problem = \"example\"\n[body]\nyoung_modulus = 1\n" + line + "\n";
}

struct Mistake {
  const char* name;
  std::string text;
  std::string message;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) {
  *stream << mistake.name;
}

class BadScene : public testing::TestWithParam<Mistake> {};

TEST_P(BadScene, IsRefusedInOneLine) {
  const std::string message = complaint(GetParam().text);
  EXPECT_EQ(message, GetParam().message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, BadScene,
    testing::Values(
        Mistake{"UnknownKey", with_line_4("elemnt = \"plain\""),
                "example.toml:4: key `body.elemnt`: unknown key, did you mean `body.element`?"},
        Mistake{"UnknownKeyFarFromAll", with_line_4("[magic]\nwand_of_wonder = 1"),
                "example.toml:5: key `magic.wand_of_wonder`: unknown key, expected one of `gnomon "
                "help scene example`"},
        Mistake{"KeyInTheWrongTable", with_line_4("level = 2"),
                "example.toml:4: key `body.level`: unknown key, did you mean `mesh.level`?"},
        Mistake{"UnknownEmptyTable", with_line_4("[bdy.element]"),
                "example.toml:4: key `bdy.element`: unknown key, did you mean `body.element`?"},
        Mistake{"MisspeltTable", with_line_4("[outptu]\nlevel = 2"),
                "example.toml:5: key `outptu.level`: unknown key, did you mean `output`?"},
        Mistake{"QuotedDottedKey", with_line_4("\"body.element\" = 1"),
                "example.toml:4: key `body.\"body.element\"`: unknown key, did you mean "
                "`body.element`?"},
        Mistake{"KeyBelowAValue", with_line_4("element.kind = 1"),
                "example.toml:4: key `body.element.kind`: unknown key, did you mean "
                "`body.element`?"},
        Mistake{
            "ArrayOfTables", with_line_4("[[mesh]]\nlevel = 2"),
            "example.toml:5: key `mesh.1.level`: expected a table of keys, [mesh], got an array of "
            "tables, [[mesh]]"},
        Mistake{"SeveralTablesAfterOne", with_line_4("[[body]]"),
                "example.toml:4: [[body]], but line 2 has [body]: expected [[body]] for each of "
                "several tables"},
        Mistake{"OneTableAfterSeveral", "problem = \"example\"\n[[load]]\na = 1\n [load] # last\n",
                "example.toml:4: [load], but line 2 has [[load]]: expected [[load]] for each of "
                "several tables"},
        Mistake{
            "BlankInAHeader", with_line_4("[wear.surfaces.a b]"),
            "example.toml:4: [wear.surfaces.a b]: a name with blanks stands in quotes, expected "
            "[wear.surfaces.\"a b\"]"},
        Mistake{"BlankInAKey", with_line_4("poisson ratio = 0.3"),
                "example.toml:4: `poisson ratio`: expected a key without blanks, or with quotes: "
                "\"poisson ratio\""},
        Mistake{"TextForNumber", with_line_4("poisson_ratio = \"soft\""),
                "example.toml:4: key `body.poisson_ratio`: expected a number in [0, 0.5), got "
                "\"soft\""},
        Mistake{"NumberForText", with_line_4("element = 3.5"),
                "example.toml:4: key `body.element`: expected one of \"plain\", \"f-bar\", got "
                "3.5"},
        Mistake{"NumberForFlag", with_line_4("[output]\nlast = 1"),
                "example.toml:5: key `output.last`: expected true or false, got 1"},
        Mistake{"RealForInteger", with_line_4("[mesh]\nlevel = 1.0"),
                "example.toml:5: key `mesh.level`: expected an integer in [0, 9], got 1.0"},
        Mistake{"ScalarForArray", with_line_4("[mesh]\nelements = 4"),
                "example.toml:5: key `mesh.elements`: expected an array of 2 integers in [1, inf), "
                "got 4"},
        Mistake{"ArrayForScalar", with_line_4("poisson_ratio = [0.3]"),
                "example.toml:4: key `body.poisson_ratio`: expected a number in [0, 0.5), got an "
                "array of 1 value"},
        Mistake{"TableForScalar", with_line_4("element = {}"),
                "example.toml:4: key `body.element`: expected one of \"plain\", \"f-bar\", got a "
                "table"},
        Mistake{"DateForNumber", with_line_4("poisson_ratio = 2020-01-01"),
                "example.toml:4: key `body.poisson_ratio`: expected a number in [0, 0.5), got a "
                "date or time"},
        Mistake{"OutOfRange", with_line_4("poisson_ratio = 0.5"),
                "example.toml:4: key `body.poisson_ratio`: expected a number in [0, 0.5), got 0.5"},
        Mistake{"NotANumber", with_line_4("poisson_ratio = nan"),
                "example.toml:4: key `body.poisson_ratio`: expected a number in [0, 0.5), got nan"},
        Mistake{"Infinity", with_line_4("[output]\nlimit = -inf"),
                "example.toml:5: key `output.limit`: expected a number, finite [s], got -inf"},
        Mistake{"ArrayTooLong", with_line_4("[mesh]\nelements = [4, 4, 4]"),
                "example.toml:5: key `mesh.elements`: expected an array of 2 integers in [1, inf), "
                "got an array of 3 values"},
        Mistake{"EmptyArray", with_line_4("[mesh]\nelements = []"),
                "example.toml:5: key `mesh.elements`: expected an array of 2 integers in [1, inf), "
                "got an empty array"},
        Mistake{"ArrayEntryOutOfRange", with_line_4("[mesh]\nelements = [4, 0]"),
                "example.toml:5: key `mesh.elements`: expected an array of 2 integers in [1, inf), "
                "got 0 at place 2"},
        Mistake{"ArrayOfTexts", with_line_4("[output]\ntimes = [1, \"two\"]"),
                "example.toml:5: key `output.times`: expected an array of numbers in [0, inf) [s], "
                "got \"two\" at place 2"},
        Mistake{"BadChoice", with_line_4("element = \"fbar\""),
                "example.toml:4: key `body.element`: expected one of \"plain\", \"f-bar\", got "
                "\"fbar\", did you mean \"f-bar\"?"},
        Mistake{"MissingKey", "problem = \"example\"\n",
                "example.toml: key `body.young_modulus`: missing, expected a number in (0, inf) "
                "[MPa]"},
        Mistake{
            "MissingProblem", "[body]\nyoung_modulus = 1\n",
            "example.toml: key `problem`: missing, expected the name of a problem (`gnomon list "
            "problems`)"},
        Mistake{"MisspeltProblem", "problm = \"example\"\n",
                "example.toml:1: key `problm`: unknown key, did you mean `problem`?"},
        Mistake{"UnknownProblem", "problem = \"exmple\"\n",
                "example.toml:1: key `problem`: unknown problem \"exmple\""},
        Mistake{"ProblemIsNoText", "problem = 3\n",
                "example.toml:1: key `problem`: expected a text, got 3"}),
    [](const auto& info) { return info.param.name; });

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

const std::string too_many_parts =
    "example.toml:4: a key of more than 32 parts, expected at most 32";
const std::string too_deep =
    "example.toml:4: arrays or tables nested more than 32 deep, expected at most 32";

// 200,000 parts overflow the stack of the parser.
TEST(AbsurdNesting, IsRefusedBeforeItIsParsed) {
  for (const int count : {32, 200000}) {
    const std::string dotted = repeated("a.", count) + "a",
                      spaced = repeated("'b c' . ", count) + "a";
    for (const std::string& line : {dotted + " = 1", spaced + " = 1", "[" + dotted + "]",
                                    "[[" + dotted + "]]", "x = {y = [1, {" + dotted + " = 1}]}"})
      EXPECT_EQ(complaint(with_line_4(line)), too_many_parts);
  }
  for (const int count : {33, 200000}) {
    EXPECT_EQ(complaint(with_line_4("a = " + repeated("[", count))), too_deep);
    EXPECT_EQ(complaint(with_line_4("a = " + repeated("{a = ", count))), too_deep);
    EXPECT_EQ(complaint(with_line_4("a = " + repeated("[{a = ", count))), too_deep);
  }
}

TEST(AbsurdNesting, CountsTheLinesOfStringsAndArrays) {
  EXPECT_EQ(complaint("a = \"\"\"\n\\\n\"\"\"\"\n" + repeated("b.", 40) + "b = 1"), too_many_parts);
  EXPECT_EQ(complaint("a = [\n1, # one\n2]\n" + repeated("b.", 40) + "b = 1"), too_many_parts);
  EXPECT_EQ(complaint("a = 'C:\\'\n\n\n" + repeated("b.", 40) + "b = 1"), too_many_parts);
}

TEST(AbsurdNesting, DoesNotCountStringsCommentsOrNeighbours) {
  const std::string dots = repeated(".[{", 100);
  for (const std::string& text :
       {"\"" + dots + "\\\"" + dots + "\"", "'" + dots + "\\'",
        "\"\"\"" + dots + "\"\n\"\"" + dots + "\"\"\"\"\"", "'''" + dots + "\n'" + dots + "''''"})
    EXPECT_EQ(complaint("problem = \"example\" # " + dots + "\noutput.title = " + text + " # " +
                        dots + "\nbody.young_modulus = 1"),
              "");
  EXPECT_EQ(complaint(with_line_4("[output]\ntimes = [" + repeated("1.5, ", 1000) + "2.5]")), "");
  // 32 parts are not too many, only unknown.
  EXPECT_THAT(complaint(with_line_4("[" + repeated("a.", 31) + "a]")),
              testing::HasSubstr("unknown key"));
}

TEST(BadSceneText, SyntaxErrorNamesFileAndLine) {
  const std::string message = complaint(with_line_4("poisson_ratio = = 3"));
  EXPECT_EQ(message.rfind("example.toml:4: not valid TOML: ", 0), 0u) << message;
}

TEST(BadSceneText, DuplicateKeyNamesFileAndLine) {
  const std::string message = complaint(with_line_4("young_modulus = 2"));
  EXPECT_EQ(message.rfind("example.toml:4: not valid TOML: ", 0), 0u) << message;
}

TEST(BadSceneText, NumberBeyondTheRealsIsRefused) {
  EXPECT_NE(complaint(with_line_4("poisson_ratio = 1e400")), "");
}

TEST(SceneText, KnownTablesMayBeEmpty) {
  EXPECT_EQ(complaint(with_line_4("[output]\n[mesh]")), "");
}

TEST(BadSceneText, FirstMistakeOfTheFileIsReported) {
  const std::string text = with_line_4("poisson_ratio = 7\n[mesh]\nelements = 3\n[what]\nis = 1");
  EXPECT_EQ(complaint(text).rfind("example.toml:4:", 0), 0u) << complaint(text);
}

TEST(BadSceneText, OverriddenValueMustStillBeRight) {
  const std::string text = with_line_4("poisson_ratio = 7");
  EXPECT_NE(complaint(text, {"body.poisson_ratio=0.2"}), "");
}

TEST(BadSceneText, LongTextIsShortenedInTheMessage) {
  const std::string text = with_line_4("element = \"" + std::string(10000, 'x') + "\"");
  EXPECT_LT(complaint(text).size(), 300u);
}

TEST(BadSceneFile, MissingFileIsNamed) {
  try {
    load_scene("no/such/scene.toml", {}, test::example_table);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "no/such/scene.toml: no such file, expected a scene");
  }
}

TEST(BadSceneFile, FolderIsNamed) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  try {
    load_scene(folder, {}, test::example_table);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), folder + ": is a folder, expected a scene file");
  }
}

}  // namespace
}  // namespace gnomon::bad_scene_test
