// Error budgets and plans as a user meets them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/budget/budget.hpp>
#include <gnomon/results/results.hpp>
#include <nlohmann/json.hpp>

#include "app/child.hpp"
#include "support/pin_text.hpp"

namespace gnomon::accuracy_test {
namespace {

using test::Outcome;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Accuracy : public test::ProgramTest {
protected:
  void write_scene(const std::string& more) const {
    write("pin.toml", test::pin_text(1000) + more);
  }
};

TEST_F(Accuracy, ARunEndsWithABudgetThatItsResultKeeps) {
  write_scene("[mesh]\nelements = [24, 16]\n");
  const Outcome run = gnomon({"run", "pin.toml", "-o", "a.h5", "--summary", "s.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("error budget"), HasSubstr("inner_pressure")));
  EXPECT_THAT(gnomon({"info", "a.h5"}).out, HasSubstr("mesh: mesh.elements = [12, 8]"));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  const Budget kept = budget_of_json(ResultReader(folder() / "a.h5").budget());
  ASSERT_EQ(json["budget"]["values"].size(), kept.values.size());
  for (std::size_t i = 0; i < kept.values.size(); ++i)
    EXPECT_EQ(json["budget"]["values"][i]["value"], kept.values[i].value);

  EXPECT_EQ(json["budget"]["values"][1]["error"], kept.total(1));  // wear_depth

  const Outcome without = gnomon({"run", "pin.toml", "-o", "b.h5", "--set", "output.budget=false"});
  EXPECT_THAT(without.out, Not(HasSubstr("error budget")));
  EXPECT_EQ(ResultReader(folder() / "b.h5").budget(), "");
}

TEST_F(Accuracy, MayBeAskedForInsteadOfSettings) {
  write_scene("[accuracy]\nwithin = 0.1\nof = [\"depth\", \"volume\"]\n");
  const Outcome run = gnomon({"run", "pin.toml", "-o", "a.h5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("asked for 10 % in depth, volume: "),
                             Not(HasSubstr("NOT within")), HasSubstr("integrator.rtol")));
  // The result has settings, and goes on by them.
  EXPECT_THAT(ResultReader(folder() / "a.h5").header().scene, HasSubstr("# within = ..."));
  EXPECT_EQ(gnomon({"resume", "a.h5", "--end", "1010"}).exit_code, 0);

  const Outcome plan = gnomon({"plan", "pin.toml"});
  EXPECT_THAT(plan.out, AllOf(HasSubstr("20 %"), HasSubstr("2.5 %"), HasSubstr("pilot runs")));
  EXPECT_THAT(gnomon({"check", "pin.toml"}).out,
              AllOf(HasSubstr("#     10 %"), HasSubstr("[pin]")));
}

// Friction presses on the front edge of a block; before wear has removed what is singular there,
// the largest depth grows by 10 to 18 % with each halving of the elements.
TEST_F(Accuracy, AnEdgeThatIsNotResolvedIsWarnedOf) {
  write("block.geo", R"(
Point(1) = {-5, 0, 0, 0.5}; Point(2) = {5, 0, 0, 0.5}; Point(3) = {5, 8, 0, 1}; Point(4) = {-5, 8, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Recombine Surface{1};
Physical Curve("face") = {1}; Physical Curve("top") = {3}; Physical Surface("block") = {1};
)");
  write("block.toml", R"(problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 2000.0, poisson_ratio = 0.35 }
support = [ { on = "top" } ]
friction.coefficient = 0.3
wear = { on = ["face"], coefficient = 1e-8 }
time.end = 100.0
[counter_body]
shape = "plane"
center = [0.0, 0.0]
normal = [0.0, 1.0]
motion = { velocity = [200.0, 0.0] }
press = { direction = [0.0, 1.0], force = 30.0 }
)");
  const Outcome run = gnomon({"run", "block.toml", "-o", "a.h5", "--summary", "s.json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, AllOf(HasSubstr("warning: mesh: the changes of wear_depth"),
                             HasSubstr("the error is not known")));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_EQ(json["budget"]["values"][1]["name"], "wear_depth");
  EXPECT_TRUE(json["budget"]["values"][1]["error"].is_null());
  EXPECT_FALSE(json["budget"]["values"][0]["error"].is_null());  // worn_volume
  EXPECT_THAT(gnomon({"budget", "block.toml"}).out, HasSubstr("hardly fall"));
}

TEST_F(Accuracy, IsRefusedWhereNothingWouldPlan) {
  write_scene("[accuracy]\nwithin = 0.1\n");
  write("study.toml",
        "scene = \"pin.toml\"\n[[method]]\nintegrator = \"esdirk-3\"\ntolerances = [1e-2]\n");
  const Outcome study = gnomon({"study", "study.toml"});
  EXPECT_EQ(study.exit_code, 2);
  EXPECT_THAT(study.err, HasSubstr("accuracy.within`: expected none in a study"));
  const Outcome stability = gnomon({"stability", "pin.toml"});
  EXPECT_EQ(stability.exit_code, 2);
  EXPECT_THAT(stability.err, HasSubstr("accuracy.within`: expected none here"));
}

TEST_F(Accuracy, OfWhatHasNoWornSurfaceIsRefused) {
  const std::string decay = GNOMON_SOURCE_DIR "/problems/dahlquist/decay.toml";
  for (const std::vector<std::string>& words : {std::vector<std::string>{"budget", decay},
                                                {"plan", decay, "--set", "accuracy.within=0.1"}}) {
    const Outcome outcome = gnomon(words);
    EXPECT_EQ(outcome.exit_code, 2) << words[0];
    EXPECT_THAT(outcome.err, HasSubstr("expected a problem with a worn surface")) << words[0];
  }
}

}  // namespace
}  // namespace gnomon::accuracy_test
