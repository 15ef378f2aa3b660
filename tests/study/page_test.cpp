// The JSON of studies and extremes, and the pages that the plotting script makes of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "study/study_fixture.hpp"

namespace gnomon::page_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// References with low accuracy, so that some errors are marked.
const std::string loose =
    "[[reference]]\nintegrator = \"sdirk-2\"\ntolerance = 0.1\n"
    "[[reference]]\nintegrator = \"bdf\"\ntolerance = 0.1\n";
const std::string hostile_name = "name = '''<i>&\"'x''' # <&>\n";

class Pages : public test::StudyTest {
protected:
  /// A study of four runs, one of which fails; with names of characters that mean something in
  /// HTML.
  void write_hostile_study(const std::string& name) const {
    write("sc&<e>ne.toml", test::read_text(folder() / "scene.toml"));
    std::string text = "# <script>alert(1)</script> & \"more\"\n" + head();
    text.replace(text.find("scene.toml"), 10, "sc&<e>ne.toml");
    write(name, text + "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [0.1, 640]\n" +
                    method("backward-euler", "steps = [50, 25]", hostile_name) + loose);
  }

  /// What a script beside the tests finds on a page.
  int check_page(const std::string& kind) const {
    const std::string script = GNOMON_SOURCE_DIR "/tests/app/check_pages.py";
    const std::string tools = GNOMON_SOURCE_DIR "/tools/plot";
    return std::system(("/usr/bin/python3 '" + script + "' '" + tools + "' " + kind + " '" +
                        (folder() / "out").string() + "'")
                           .c_str());
  }
};

TEST_F(Pages, TheJsonHoldsTheTable) {
  write_hostile_study("a&<b>.toml");
  ASSERT_EQ(gnomon({"study", "a&<b>.toml", "-o", "out", "--quiet"}).exit_code, 0);
  const auto rows = this->rows();
  const nlohmann::json json = this->json();
  EXPECT_EQ(json["study"], "a&<b>");
  EXPECT_EQ(json["title"], "<script>alert(1)</script> & \"more\"");
  EXPECT_EQ(json["text"], test::read_text(folder() / "a&<b>.toml"));
  EXPECT_EQ(json["sweep"][1]["label"], "body.young_modulus=640");
  EXPECT_EQ(json["sweep"][1]["values"]["body.young_modulus"], "640");
  EXPECT_EQ(json["sweep"][1]["reference"]["text"], rows[2].at("reference"));
  EXPECT_EQ(json["sweep"][1]["reference"]["error"], std::stod(rows[2].at("reference_error")));
  EXPECT_TRUE(json["sweep"][0]["reference"]["error"].is_null());
  for (const auto& column : json["columns"]) EXPECT_NE(column["meaning"], "") << column["name"];
  ASSERT_EQ(json["rows"].size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(json["rows"][i]["values"].size(), rows[i].size());
    EXPECT_EQ(json["rows"][i]["sweep"], i / 2);
    for (const auto& [name, text] : rows[i]) {
      const nlohmann::json& value = json["rows"][i]["values"][name];
      if (value.is_number()) {
        EXPECT_EQ(value, std::stod(text)) << name;
      } else {
        EXPECT_EQ(value.is_null() ? "" : value, text) << name;
      }
    }
  }
}

TEST_F(Pages, OfAStudyShowTheTable) {
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  write_hostile_study("a&<b>.toml");
  const Outcome outcome = gnomon({"study", "a&<b>.toml", "-o", "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("results: out (index.html, study.csv, study.json, study.h5"));
  EXPECT_FALSE(fs::exists(folder() / "out/figures.log"));
  EXPECT_EQ(check_page("study"), 0);
  // Elsewhere there are the figures only.
  fs::remove(folder() / "out/index.html");
  ASSERT_EQ(gnomon({"plot", "out", "-o", "elsewhere"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder() / "elsewhere/index.html"));
  EXPECT_FALSE(fs::exists(folder() / "out/index.html"));
}

TEST_F(Pages, OfExtremesShowTheCases) {
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  write("a&<b>.toml", head() + loose + method("bdf", "tolerances = [0.1, 1e-6]"));
  write("other.toml", head() + "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [-1.0]\n" +
                          loose + method("bdf", "tolerances = [0.1]"));
  const Outcome outcome = gnomon({"extremes", "a&<b>.toml", "other.toml", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 1);  // the references are too loose for 1e-6
  EXPECT_THAT(outcome.out, HasSubstr("results: out (index.html, extremes.csv, extremes.json, "));
  EXPECT_EQ(check_page("extremes"), 0);
}

// What there is no program for is drawn later; an earlier page does not stay beside new tables.
TEST_F(Pages, AStudySucceedsWithoutThem) {
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  write("study.toml", head() + method("backward-euler", "steps = [50]") + loose);
  fs::create_directory(folder() / "modules");
  write("modules/jinja2.py", "raise ImportError(name='jinja2')\n");
  setenv("PYTHONPATH", (folder() / "modules").c_str(), 1);
  const Outcome without = study();
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_THAT(
      without.out,
      HasSubstr("\nno page: drawing needs Python's jinja2: install the packages "
                "python3-matplotlib python3-h5py python3-jinja2; `gnomon plot out` draws it\n"
                "results: out (study.csv, study.json, study.h5, runs)\n"));
  EXPECT_FALSE(fs::exists(folder() / "out/index.html"));
  EXPECT_EQ(rows().size(), 1u);
  EXPECT_EQ(json()["rows"].size(), 1u);

  unsetenv("PYTHONPATH");
  const Outcome plot = gnomon({"plot", "out"});
  EXPECT_EQ(plot.exit_code, 0) << plot.err;
  EXPECT_THAT(plot.out, HasSubstr("out/index.html\n"));
  EXPECT_THAT(test::read_text(folder() / "out/index.html"), HasSubstr("backward-euler"));

  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const Outcome resumed = study({"--resume"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.out,
              HasSubstr("\nno page: drawing needs Python 3 and the packages python3-"));
  EXPECT_FALSE(fs::exists(folder() / "out/index.html"));
}

TEST_F(Pages, WithoutFiguresTheReasonIsTold) {
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  write("study.toml", head() + "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [-1.0]\n" +
                          loose + method("bdf", "tolerances = [0.1]"));
  const Outcome refused = gnomon({"extremes", "study.toml", "-o", "out"});
  EXPECT_EQ(refused.exit_code, 0) << refused.err;
  EXPECT_THAT(refused.out, HasSubstr("\nno figures: accuracy: no case with error control has a "
                                     "difference\n1 cases: 1 refused\n"));
  EXPECT_TRUE(fs::exists(folder() / "out/index.html"));

  fs::create_directory(folder() / "programs");
  const auto draw_by = [&](const std::string& script) {
    write("programs/python3", "#!/bin/sh\n" + script + "\n");
    fs::permissions(folder() / "programs/python3", fs::perms::owner_all);
    const std::string path = getenv("PATH");
    setenv("PATH", ((folder() / "programs").string() + ":" + path).c_str(), 1);
    const Outcome outcome = gnomon({"extremes", "study.toml", "-o", "out", "--resume"});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_THAT(draw_by("echo drawn in part; kill -9 $$"),
              HasSubstr("\nno page: drawing was ended by signal 9 (Killed); `gnomon plot out` "));
  EXPECT_THAT(draw_by("exit 3"), HasSubstr("\nno page: the drawing program ended with exit code 3 "
                                           "and no message; `gnomon plot out` draws it\n"));
  EXPECT_THAT(draw_by("echo Traceback >&2; echo 'ModuleNotFoundError: numpy' >&2; exit 1"),
              HasSubstr("\nno page: ModuleNotFoundError: numpy; `gnomon plot out` draws it\n"));
}

// A result that is damaged after its run: the tables are there nevertheless.
TEST_F(Pages, WithoutFiguresTheyHaveTheirTables) {
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  write("study.toml", head() + method("backward-euler", "steps = [50]") + loose);
  ASSERT_EQ(study({"--quiet"}).exit_code, 0);
  write("out/study.csv", "study\n");
  const Outcome plot = gnomon({"plot", "out"});
  EXPECT_EQ(plot.exit_code, 2);
  EXPECT_THAT(plot.err, HasSubstr("study.csv has no column sweep"));
  const std::string page = test::read_text(folder() / "out/index.html");
  EXPECT_THAT(page, HasSubstr("No figures. out/study.csv has no column sweep"));
  EXPECT_THAT(page, AllOf(HasSubstr("backward-euler"), Not(HasSubstr("<svg"))));
}

}  // namespace
}  // namespace gnomon::page_test
