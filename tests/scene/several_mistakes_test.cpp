// All mistakes of a scene are told in one go, in the order of the file; what only follows from
// another one is not.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/scene/registry.hpp>

#include "scene/example_table.hpp"

namespace gnomon::several_mistakes_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> complaints(const std::string& text,
                                    const std::vector<std::string>& overrides = {}) {
  try {
    test::example_scene(text, overrides);
  } catch (const InputErrors& errors) {
    EXPECT_EQ(errors.what(), errors.lines.front());
    return errors.lines;
  } catch (const InputError& error) {
    return {error.what()};
  }
  return {};
}

TEST(SeveralMistakes, UnknownKeysWrongValuesAndMissingKeysAreToldAtOnce) {
  EXPECT_THAT(complaints("problem = \"example\"\n[body]\nelement = \"plan\"\nmass = 3\n[mesh]\n"
                         "elements = [4, 0]\n",
                         {"output.last=5"}),
              ElementsAre("example.toml:3: key `body.element`: expected one of \"plain\", "
                          "\"f-bar\", got \"plan\", did you mean \"plain\"?",
                          "example.toml:4: key `body.mass`: unknown key, expected one of `gnomon "
                          "help scene example`",
                          "example.toml:6: key `mesh.elements`: expected an array of 2 integers in "
                          "[1, inf), got 0 at place 2",
                          "--set output.last: expected true or false, got 5",
                          "example.toml: key `body.young_modulus`: missing, expected a number in "
                          "(0, inf) [MPa]"));
}

TEST(SeveralMistakes, AMisspeltKeyIsNotMissingAsWell) {
  EXPECT_THAT(complaints("problem = \"example\"\n[body]\nE = 3\n"),
              ElementsAre("example.toml:3: key `body.E`: unknown key, did you mean "
                          "`body.young_modulus`?"));
}

TEST(SeveralMistakes, AnEmptyTableMeansNoKey) {
  EXPECT_THAT(complaints("problem = \"example\"\n[body]\n"),
              ElementsAre("example.toml: key `body.young_modulus`: missing, expected a number in "
                          "(0, inf) [MPa]"));
}

struct Thing {
  std::string name;
};

// A file that is copied and adapted, its name forgotten.
TEST(Registry, RefusesASecondEntryOfOneName) {
  Registry<Thing>::add({"one"});
  EXPECT_THROW(Registry<Thing>::add({"one"}), RegistrationError);
  EXPECT_EQ(Registry<Thing>::names().size(), 1u);
}

struct StaticThing {
  std::string name;
};

// An exception before main() could not be caught.
TEST(Registry, TellsOfStaticRegistrationsAtTheFirstUse) {
  const Registration<StaticThing> first({"one"});
  EXPECT_EQ(Registry<StaticThing>::find("one", "thing").name, "one");
  const Registration<StaticThing> again({"one"});
  EXPECT_THROW(Registry<StaticThing>::all(), RegistrationError);
  EXPECT_THROW(Registry<StaticThing>::find("one", "thing"), RegistrationError);
}

struct Part {
  std::string name;
  int (*make)() = nullptr;
  std::string missing() const { return make ? "" : "make"; }
};

// It would end in a call of nothing, later and somewhere else.
TEST(Registry, RefusesAnEntryWithoutAMemberThatIsNeeded) {
  const auto refused = [](auto&& add, const std::string& reason) {
    EXPECT_THAT(add, testing::ThrowsMessage<RegistrationError>(testing::HasSubstr(reason)));
  };
  const std::string reason = "\"half\" is registered without `make`";
  refused([] { Registry<Part>::add({"half"}); }, reason);
  refused([] { Registry<Part>::put({"half"}); }, reason);
  refused([] { Registry<Part>::add({"", [] { return 1; }}); }, "\"\" is registered without `name`");
  EXPECT_TRUE(Registry<Part>::all().empty());
  const Registration<Part> statically({"half"});
  refused([] { Registry<Part>::all(); }, reason);
}

}  // namespace
}  // namespace gnomon::several_mistakes_test
