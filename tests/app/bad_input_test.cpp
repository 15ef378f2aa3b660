// Bad input through the real program: exit code 2, one line on stderr that says where and what was
// expected, nothing on stdout, nothing written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/child.hpp"

namespace gnomon::bad_input_test {
namespace {

using test::coarse;
using test::Outcome;
using test::pin;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BadInput : public test::ProgramTest {
protected:
  /// Expects refusal with a line that contains all of `parts`.
  void expect_refused(const std::vector<std::string>& arguments,
                      const std::vector<std::string>& parts) {
    const auto before = files();
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& part : parts) EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(files(), before);
  }

  /// The shipped scene with `from` replaced by `to`.
  void write_scene(const std::string& from, const std::string& to) {
    std::string text = test::read_text(pin);
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write("scene.toml", text.replace(at, from.size(), to));
  }
};

TEST_F(BadInput, UnknownKey) {
  write_scene("young_modulus = 640.0", "young_modlus = 640.0");
  expect_refused({"run", "scene.toml"},
                 {"scene.toml:18: key `body.young_modlus`", "did you mean `body.young_modulus`?"});
}

TEST_F(BadInput, WrongType) {
  write_scene("young_modulus = 640.0", "young_modulus = \"steel\"");
  expect_refused({"run", "scene.toml"}, {"scene.toml:18: key `body.young_modulus`: expected a "
                                         "number in [1e-30, 1e+30] [MPa], got \"steel\""});
}

TEST_F(BadInput, OutOfRange) {
  write_scene("poisson_ratio = 0.3", "poisson_ratio = 0.5");
  expect_refused({"run", "scene.toml"}, {"scene.toml:19: key `body.poisson_ratio`: expected a "
                                         "number in [0, 0.5), got 0.5"});
}

TEST_F(BadInput, ArrayLength) {
  write_scene("[40, 40]", "[40, 40, 40]");
  expect_refused({"run", "scene.toml"},
                 {"scene.toml:15: key `mesh.elements`: expected an array of 2 integers"});
}

TEST_F(BadInput, Choice) {
  write_scene("\"f-bar\"", "\"fbar\"");
  expect_refused({"run", "scene.toml"},
                 {"scene.toml:20: key `body.element`", "did you mean \"f-bar\"?"});
}

TEST_F(BadInput, MissingKey) {
  write_scene("force = 20.0", "");
  expect_refused({"run", "scene.toml"}, {"scene.toml: key `load.force`: missing, expected a number "
                                         "in [1e-30, 1e+30] [N/mm]"});
}

TEST_F(BadInput, UnknownProblem) {
  write_scene("\"pin_on_flat\"", "\"pin_on_flt\"");
  expect_refused({"run", "scene.toml"},
                 {"scene.toml:6: key `problem`", "did you mean \"pin_on_flat\"?"});
}

TEST_F(BadInput, UnknownIntegrator) {
  expect_refused({"run", pin, "--integrator", "backward-euller"},
                 {"gnomon: --integrator: ", "did you mean \"backward-euler\"?"});
}

TEST_F(BadInput, SyntaxError) {
  write_scene("[load]", "[load");
  expect_refused({"check", "scene.toml"}, {"scene.toml:22: not valid TOML"});
}

TEST_F(BadInput, BinaryFile) {
  write("scene.toml", std::string("\x00\x01\xff\xfe\n", 5));
  expect_refused({"run", "scene.toml"}, {"scene.toml:1: not valid TOML"});
}

TEST_F(BadInput, EmptyFile) {
  write("scene.toml", "");
  expect_refused({"run", "scene.toml"}, {"scene.toml: key `problem`: missing"});
}

TEST_F(BadInput, MissingFile) {
  expect_refused({"run", "no.toml"}, {"no.toml: no such file"});
}

TEST_F(BadInput, UnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  write_scene("[load]", "[load]");
  std::filesystem::permissions(folder() / "scene.toml", std::filesystem::perms::none);
  expect_refused({"run", "scene.toml"}, {"scene.toml: cannot be read"});
}

TEST_F(BadInput, LineBreakInAFileName) {
  expect_refused({"run", "no\nsuch.toml"}, {"no such.toml: no such file"});
}

TEST_F(BadInput, NamesThatAreTooLong) {
  const std::string name(300, 'x');
  expect_refused({"run", pin, "-o", "a.h5", "--summary", name}, {name + ": the name is too long"});
  expect_refused({"extremes", name}, {name + ": File name too long"});
  for (const char* command : {"run", "study", "info", "resume", "plot"})
    expect_refused({command, name}, {name});
}

TEST_F(BadInput, KeysThatContradictEachOther) {
  write_scene("height = 10.0", "height = 2.0");
  expect_refused({"run", "scene.toml"}, {"scene.toml:10: key `pin.height`"});
  EXPECT_EQ(gnomon({"check", pin, "--set", "output.times=[1000.0000000000001]"}).exit_code, 0);
  expect_refused({"run", pin, "--set", "output.times=[5, 5.00000001]"}, {"apart", "got 5 and"});
  expect_refused({"run", pin, "--set", "output.times=[999.99999]"}, {"time.end", "and 1000"});
}

TEST_F(BadInput, Overrides) {
  expect_refused({"run", pin, "--set", "mesh"}, {"--set mesh: expected KEY=VALUE"});
  expect_refused({"run", pin, "--set", "mesh.elemnts=[4,4]"}, {"did you mean `mesh.elements`?"});
  expect_refused({"run", pin, "--integrator", "bdf", "--set", "integrator.name=bdf"},
                 {"integrator.name: given twice"});
  expect_refused({"run", pin, "--set"}, {"--set"});
}

TEST_F(BadInput, NumbersBeyondReason) {
  for (const char* value :
       {"integrator.rtol=1e-300", "integrator.atol=1e-300", "time.end=1e-300", "time.end=1e300",
        "integrator.step=1e-300", "wear.velocity=1e-300", "wear.velocity=1e308", "pin.radius=1e31"})
    expect_refused({"run", pin, "--set", value}, {"expected a number in [1e-"});
  // Load and wear would be smaller than the rounding errors of such a stiffness.
  expect_refused({"run", pin, "--set", "pin.height=1e20"}, {"expected elements at most 10000"});
}

TEST_F(BadInput, OutputsThatCannotBeWritten) {
  expect_refused({"run", pin, "--set", coarse, "-o", "no/such/folder.h5"}, {"no/such/folder.h5"});
  expect_refused({"run", pin, "--set", coarse, "--summary", "no/such.json"},
                 {"no/such.json", "no folder no"});
  expect_refused({"run", pin, "--set", coarse, "-o", "a.h5", "--summary", "a.h5"},
                 {"different files"});
  expect_refused({"run", pin, "--set", coarse, "-o", "a.h5", "--summary", "./a.xdmf"},
                 {"different files"});
}

TEST_F(BadInput, ResultsAreNamedH5) {
  write_scene("[load]", "[load]");
  expect_refused({"run", "scene.toml", "-o", "./scene.toml"}, {"ends in .h5"});
  expect_refused({"run", "scene.toml", "-o", "q.hdf5"}, {"q.hdf5: expected a name", "in .h5"});
  expect_refused({"run", "scene.toml", "-o", ""}, {"expected a name"});
  expect_refused({"run", "scene.toml", "--summary", ""}, {"expected a name"});
  for (const char* command : {"study", "extremes", "stability", "plot"})
    expect_refused({command, "scene.toml", "-o", ""}, {"expected a name"});
}

TEST_F(BadInput, NothingIsOverwritten) {
  write("a.h5", "foreign");
  write("b.xdmf", "foreign");
  write("s.json", "{}");
  write("small_deformation-backward-euler.h5", "foreign");
  expect_refused({"run", pin, "-o", "a.h5"},
                 {"a.h5 exists; give another name with -o, or --force to replace it"});
  expect_refused({"run", pin, "-o", "b.h5"}, {"b.xdmf exists; give another name with -o"});
  expect_refused({"run", pin, "-o", "c.h5", "--summary", "s.json"},
                 {"s.json exists; give another name with --summary"});
  expect_refused({"run", pin}, {"small_deformation-backward-euler.h5 exists"});
}

TEST_F(BadInput, ForceReplacesNothingForeign) {
  write("a.h5", "foreign");
  write("b.xdmf", "foreign");
  write("s.json", "{\"status\": \"finished\"}");
  expect_refused({"run", pin, "--force", "-o", "a.h5"}, {"a.h5 exists and is not a result"});
  expect_refused({"run", pin, "--force", "-o", "b.h5"}, {"b.xdmf exists and is not a sidecar"});
  expect_refused({"run", pin, "--force", "-o", "c.h5", "--summary", "s.json"},
                 {"s.json exists and is not a summary"});
}

TEST_F(BadInput, CommandLine) {
  expect_refused({}, {"expected a command"});
  expect_refused({"rnu", pin}, {"unknown command `rnu`, did you mean `run`?"});
  expect_refused({"run", pin, "--quite"}, {"unknown option `--quite`, did you mean `--quiet`?"});
  expect_refused({"run"}, {"SCENE is required"});
  expect_refused({"run", pin, "second.toml"}, {"unexpected argument `second.toml`"});
  expect_refused({"list", "integrator"}, {"did you mean `integrators`?"});
  expect_refused({"list", "zzzz"},
                 {"cannot list `zzzz`, expected one of: integrators, laws, materials,"});
  expect_refused({"help", "zzzzzzzz"}, {"unknown topic `zzzzzzzz`, see `gnomon help`"});
  expect_refused({"help", "exit-code"}, {"unknown topic `exit-code`, did you mean `exit-codes`?"});
  expect_refused({"help", "scene", "pin"}, {"unknown problem \"pin\""});
  expect_refused({"help", "integrators", "x"}, {"argument `x`, see `gnomon help integrators`"});
  expect_refused({"help", "scene", "pin_on_flat", "x"}, {"argument `x`, see `gnomon help`"});
  for (const char* number : {"soon", "nan", "1e400"}) {
    const std::string refusal = std::string(": expected a finite number, got `") + number + "`";
    expect_refused({"contact", "a.h5", "--time", number},
                   {std::string("--time: expected a time in seconds, as 350 or \"350 s\", got `") +
                    number + "`"});
    expect_refused({"stability", pin, "--time", number}, {"--time" + refusal});
    expect_refused({"resume", "a.h5", "--end", number}, {"--end" + refusal});
    expect_refused({"extremes", "--limit", number}, {"--limit" + refusal});
  }
  expect_refused({"run", pin, "--quiet=3"}, {"quiet", "see `gnomon help run`"});
  const std::string nameless = ": expected a name, got an empty text";
  expect_refused({"plot", ""}, {nameless});
  expect_refused({"extremes", ""}, {nameless});
  expect_refused({"compare", "a.h5", "--reference", ""}, {"--reference" + nameless});
  expect_refused({"--version=3"}, {"version", "see `gnomon help`"});
}

TEST_F(BadInput, ResultFiles) {
  write("text.h5", "no HDF5 at all");
  for (const char* command : {"info", "contact", "compare"}) {
    expect_refused({command, "no.h5"}, {"no.h5"});
    expect_refused({command, "text.h5"}, {"text.h5"});
  }
}

}  // namespace
}  // namespace gnomon::bad_input_test
