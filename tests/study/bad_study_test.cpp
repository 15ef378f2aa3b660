// Bad studies: exit code 2, one line that says where and what was expected, nothing written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study_fixture.hpp"

namespace gnomon::bad_study_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Case {
  const char* name;
  std::string text;  // after the head, whose last line is the fourth
  std::vector<std::string> parts;
};

void PrintTo(const Case& value, std::ostream* stream) {
  *stream << value.name;
}

class BadStudy : public test::StudyTest, public testing::WithParamInterface<Case> {};

TEST_P(BadStudy, IsRefused) {
  write("study.toml", head() + GetParam().text);
  const auto before = files();
  const Outcome outcome = study();
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& part : GetParam().parts) EXPECT_THAT(outcome.err, HasSubstr(part));
  EXPECT_EQ(files(), before);
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

/// "1, 2, ..., count".
std::string numbers(int count) {
  std::string result = "1";
  for (int i = 2; i <= count; ++i) result += ", " + std::to_string(i);
  return result;
}

const Case cases[] = {
    {"UnknownKey",
     "[[method]]\nintegrator = \"bdf\"\ntolerancs = [1e-3]\n",
     {"study.toml:7: key `method.tolerancs`: unknown key, did you mean `method.tolerances`?"}},
    {"UnlikeAnyKey",
     "[[method]]\nintegrator = \"bdf\"\nqqqqqqqq = 1\n",
     {"study.toml:7: key `method.qqqqqqqq`: unknown key, expected one of `gnomon help studies`"}},
    {"OneBracketMethod",
     "[method]\nintegrator = \"bdf\"\n",
     {"study.toml:6: key `method.integrator`: there may be several of these tables, expected "
      "[[method]]"}},
    {"OneBracketReference",
     "[reference]\ntolerance = 1e-6\n",
     {"study.toml:6: key `reference.tolerance`: there may be several of these tables, expected "
      "[[reference]]"}},
    {"OneBracketSweep",
     "[sweep]\n",
     {"key `sweep`: there may be several of these tables, expected [[sweep]]"}},
    {"WrongType",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = \"1e-3\"\n",
     {"study.toml:7: key `method.tolerances`: expected a number in [1e-13, 0.1], or an array of "
      "numbers in [1e-13, 0.1]"}},
    {"LongName",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\nname = \"" + std::string(300, 'x') +
         "\"\n",
     {"method", "expected names that make files of 200 bytes or less"}},
    {"OutOfRange",
     "[[method]]\nintegrator = \"sdirk-2\"\nsteps = [-1]\n",
     {"study.toml:7: key `method.steps`: expected", "got -1 at place 1"}},
    {"UnknownTable",
     "[[methods]]\nintegrator = \"bdf\"\n",
     {"study.toml:5: key `methods`: unknown table, did you mean [[method]]?"}},
    {"TableUnlikeAny",
     "[[zzzzzzzz]]\nx = 1\n",
     {"study.toml:5: key `zzzzzzzz`: unknown table, expected [[sweep]], [[method]] or"}},
    {"TwoMethodsOfOneName",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-4]\n",
     {"study.toml:9: key `method.integrator`: two methods are called \"bdf\", expected different"}},
    {"NoMethod",
     "[[sweep]]\nkey = \"load.force\"\nvalues = [10]\n",
     {"study.toml: expected one [[method]] or more, got none; reference = \"none\" at the top "
      "makes"}},
    {"ReferenceBelowATable",
     "[[sweep]]\nkey = \"load.force\"\nvalues = [10]\nreference = \"none\"\n",
     {"study.toml:8: key `sweep.reference`: `reference` is a key of the study, expected it above"}},
    {"ReferenceInSet",
     "reference = \"none\"\n",
     {"study.toml:5: key `set.reference`: `reference` is a key of the study, expected it above"}},
    {"NothingToRun", "[[method]]\nintegrator = \"bdf\"\n", {"study.toml:6", "nothing to run"}},
    {"MissingIntegrator",
     "[[method]]\nsteps = [1]\n",
     {"study.toml:5: key `method.integrator`: missing, expected a text"}},
    {"UnknownIntegrator",
     "[[method]]\nintegrator = \"bfd\"\nsteps = [1]\n",
     {"study.toml:6: key `method.integrator`: unknown integrator \"bfd\", did you mean \"bdf\"?"}},
    {"StepsForBdf",
     "[[method]]\nintegrator = \"bdf\"\nsteps = [1]\n",
     {"study.toml:7: key `method.steps`: expected tolerances, bdf chooses its own steps"}},
    {"UnknownSceneKey",
     "body.young_modlus = 5.0\n",
     {"study.toml:5: key `set.body.young_modlus`", "did you mean `body.young_modulus`?"}},
    {"SceneValue",
     "body.young_modulus = \"soft\"\n",
     {"study.toml:5: key `set.body.young_modulus`: expected a number in [1e-30, 1e+30] [MPa]"}},
    {"OwnedKey", "integrator.step = 5.0\n", {"study.toml:5", "given by `method.steps`"}},
    {"SweptTolerance",
     "[[sweep]]\nkey = \"integrator.rtol\"\nvalues = [1e-3]\n[[method]]\nintegrator = \"bdf\"\n"
     "tolerances = [1e-3]\n",
     {"study.toml:6: key `sweep.key`: expected another key, `integrator.rtol` is given by "
      "`method.tolerances`"}},
    {"ToleranceOfAReference",
     "[[reference]]\nintegrator = \"bdf\"\ntolerance = 1e-7\nset.integrator.rtol = 1e-3\n",
     {"study.toml:8: key `reference.set.integrator.rtol`: expected another key, `integrator.rtol` "
      "is given by `reference.tolerances`"}},
    {"StepOfAReference",
     "[[reference]]\nintegrator = \"esdirk-3\"\ntolerance = 1e-7\nset.integrator.step = 5.0\n",
     {"study.toml:8: key `reference.set.integrator.step`: expected another key, `integrator.step` "
      "is given by `reference.tolerances`, which chooses the steps"}},
    {"StoredSteps", "output.every = 1\n", {"study.toml:5", "given by the study itself"}},
    {"SweptValue",
     "[[sweep]]\nkey = \"mesh.elements\"\nvalues = [[8, 8], 8]\n",
     {"study.toml:7: key `sweep.values`: expected an array of 2 integers", "got 8"}},
    {"SweptTwice",
     "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [10, 20, 10.0]\n",
     {"study.toml:7: key `sweep.values`: 10", "is given twice, expected once"}},
    {"SweptArrayTwice",
     "[[sweep]]\nkey = \"mesh.elements\"\nvalues = [[8, 8], [8, 8]]\n",
     {"study.toml:7: key `sweep.values`: [8, 8] is given twice, expected once"}},
    {"SweptKey",
     "[[sweep]]\nkey = \"mesh.elemnts\"\nvalues = [8]\n",
     {"study.toml:6: key `sweep.key`: unknown key, did you mean `mesh.elements`?"}},
    {"KeySweptTwice",
     "[[sweep]]\nkey = \"load.force\"\nvalues = [10]\n"
     "[[sweep]]\nkey = \"load.force\"\nvalues = [20]\n",
     {"study.toml:9: key `sweep.key`: `load.force` is swept twice, expected once"}},
    {"NothingSwept",
     "[[sweep]]\nkey = \"load.force\"\nvalues = []\n",
     {"study.toml:7: key `sweep.values`: expected an array of one or more values"}},
    {"SetAndSwept",
     "[[sweep]]\nkey = \"time.end\"\nvalues = [8]\n[[method]]\nintegrator = \"bdf\"\n"
     "tolerances = [1e-3]\n",
     {"study.toml:4: key `set.time.end`: expected it to be set or swept, not both"}},
    {"EndOfOneMethod",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\nset.time.end = 50.0\n",
     {"study.toml:8: key `method.set.time.end`: cannot differ between methods"}},
    {"EndOfOneReference",
     "[[reference]]\nintegrator = \"bdf\"\ntolerance = 1e-6\nset.time.end = 50.0\n",
     {"study.toml:8: key `reference.set.time.end`: cannot differ between methods"}},
    {"OneReference",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[[reference]]\nintegrator = \"bdf\"\ntolerance = 1e-6\n",
     {"study.toml:9: key `reference.integrator`: expected two [[reference]] tables, or none of "
      "them",
      "reference = \"none\"", "got 1"}},
    {"OneFamily",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[[reference]]\nintegrator = \"bdf\"\ntolerance = 1e-6\n"
     "[[reference]]\nintegrator = \"bdf\"\ntolerance = 1e-7\n",
     {"study.toml:12: key `reference.integrator`: expected references of two families"}},
    {"SelfReference",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[self_reference]\nmethod = \"bdff\"\ntolerance = 1e-6\n",
     {"study.toml:9: key `self_reference.method`", "did you mean \"bdf\"?"}},
    {"SelfReferenceWithoutMethod",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[self_reference]\ntolerance = 1e-6\n",
     {"study.toml:9: key `self_reference.tolerance`: expected self_reference.method too"}},
    {"SelfReferenceWithoutSetting",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[self_reference]\nmethod = \"bdf\"\n",
     {"study.toml:9: key `self_reference.method`: expected one of self_reference.step and "}},
    {"SelfReferenceByStepsOfBdf",
     "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n"
     "[self_reference]\nmethod = \"bdf\"\nstep = 1.0\n",
     {"study.toml:10: key `self_reference.step`: expected a tolerance, bdf chooses its own"}},
    {"Contradiction",
     "pin.height = 1.0\n[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n",
     {"study.toml", "pin.height", "expected more than"}},
    {"TooManyRuns",
     "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [" + numbers(200) + "]\n" +
         "[[sweep]]\nkey = \"load.force\"\nvalues = [" + numbers(60) + "]\n" +
         "[[method]]\nintegrator = \"bdf\"\ntolerances = [1e-3]\n",
     {"study.toml: expected at most 10000 runs, sweeps and methods make 12000"}},
    {"DeepNesting",
     "[[method]]\nset." + repeated("a.", 100000) + "a = 1\n",
     {"study.toml:6: a key of more than 32 parts, expected at most 32"}},
    {"OneWordTwice",
     "[[method]]\nintegrator = \"bdf\"\ntolerance = 1e-3\ntolerances = [1e-4]\n",
     {"study.toml:8: key `method.tolerances`: given twice, expected once"}},
    {"Syntax", "[[method]\n", {"study.toml:5: not valid TOML"}},
};

INSTANTIATE_TEST_SUITE_P(Kinds, BadStudy, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

class BadStudyFiles : public test::StudyTest {
protected:
  void expect_refused(const std::string& part) {
    const auto before = files();
    const Outcome outcome = study();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(part));
    EXPECT_EQ(files(), before);
  }
};

TEST_F(BadStudyFiles, Missing) {
  expect_refused("study.toml: no such file, expected a study");
}

TEST_F(BadStudyFiles, MissingScene) {
  write("study.toml", "scene = \"no.toml\"\n");
  expect_refused("study.toml:1: key `scene`: expected a scene file, there is no \"no.toml\"");
}

TEST_F(BadStudyFiles, SceneWhoseNameNoFileCanHave) {
  write("study.toml", "scene = \"" + std::string(5000, 'n') + "\"\n");
  const Outcome outcome = study();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("study.toml:1: key `scene`: expected a scene file"));
}

TEST_F(BadStudyFiles, FolderOfSomethingElse) {
  write("study.toml", head() + method("bdf", "tolerances = [0.1]"));
  std::filesystem::create_directory(folder() / "out");
  write("out/precious.txt", "mine");
  expect_refused("out: is not the folder of a study");
}

}  // namespace
}  // namespace gnomon::bad_study_test
