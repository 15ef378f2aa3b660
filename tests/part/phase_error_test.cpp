// The error of the mean over the phases of a cycle: its estimate against the error itself, and the
// number of phases that a run chooses by it.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>
#include <gnomon/system/system.hpp>
#include <nlohmann/json.hpp>

#include "part/cyclic_flat.hpp"

namespace gnomon::phase_error_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A cylinder that slides to and fro on a flat, or goes on and is only modulated.
class PhaseErrors : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
    folder_.write("flat.geo", flat_geometry(4));
  }

  std::filesystem::path scene(const std::string& phases, const std::string& motion = "") const {
    return folder_.write("flat.toml", fmt::format(R"toml(problem = "worn_body"
mesh.file = "flat.geo"
body = {{ young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" }}
support = [ {{ on = "bottom" }} ]
wear = {{ on = ["surface"], coefficient = 2.9e-6 }}
time.end = 20.0
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
[counter_body]
shape = "cylinder"
radius = 6.0
center = [0.0, 6.0]
press = {{ direction = [0.0, -1.0], force = 18.5 }}
{}
[cycle]
period = 1.0
phases = {}
x = "0.1 * sin(2*pi*tau)"
)toml",
                                                  motion, phases));
  }
  gnomon::Setup setup(const std::string& phases, const std::string& motion = "",
                      const Overrides& overrides = {}) const {
    return set_up(scene(phases, motion), overrides);
  }
  /// At the initial shape.
  double estimate(const std::string& phases, const std::string& motion = "") const {
    const gnomon::Setup of = setup(phases, motion);
    Counters counters;
    return of.model->phase_error(of.model->start(counters)).value().error;
  }
  /// Rates of the worn surface at the start, from the rows of the system itself.
  std::vector<double> rates(int phases, const std::string& motion) const {
    const gnomon::Setup of = setup(fmt::format("{}", phases), motion);
    Counters counters;
    const State start = of.model->start(counters);
    std::vector<double> found;
    for (std::size_t i = 0; i < start.y.size(); ++i)
      if (of.model->system().structure().differential[i]) found.push_back(start.ydot[i]);
    return found;
  }

  SceneFolder folder_;
};

const std::string sliding_on = "motion.velocity = [2.0, 0.0]";  // never at rest

TEST_F(PhaseErrors, AreEstimatedWithinAFactorOfTwo) {
  for (const std::string& motion : {std::string(), sliding_on}) {
    const std::vector<double> exact = rates(96, motion);
    double last = 1;
    for (const int phases : {8, 16}) {
      const std::vector<double> mean = rates(phases, motion);
      double difference = 0, whole = 0;  // the surface is flat and its nodes are equally far apart
      for (std::size_t i = 0; i < exact.size(); ++i) {
        difference += std::abs(mean[i] - exact[i]);
        whole += std::abs(exact[i]);
      }
      const double error = difference / whole, guess = estimate(fmt::format("{}", phases), motion);
      EXPECT_GT(guess, 0.5 * error) << phases << " phases, " << motion;
      EXPECT_LT(guess, 2 * error) << phases << " phases, " << motion;
      EXPECT_LT(error, 0.7 * last) << phases << " phases, " << motion;
      last = error;
    }
  }
}

/// Chosen positions are compared with the middles between them, equal ones with others.
TEST_F(PhaseErrors, OfChosenPositionsAreLikeThoseOfAsManyPhases) {
  const double ratio = estimate("[0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875]", sliding_on) /
                       estimate("8", sliding_on);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

/// What repeats as often as the phases do looks constant to them, and to twice as many.
TEST_F(PhaseErrors, SeeWhatRepeatsAsOftenAsThePhases) {
  const auto with = [&](const std::string& phases, const std::string& cycle,
                        const std::string& velocity) {
    std::string text = text_of(scene(phases, velocity));
    text.erase(text.find("x = \"0.1"));
    if (cycle.find("force") != cycle.npos) text.replace(text.find(", force = 18.5"), 14, "");
    return set_up(folder_.write("repeats.toml", text + cycle), {});
  };
  struct Case {
    std::string cycle, velocity;
    double path, force;  // the mean speed, and the mean force on the path
  };
  const std::vector<Case> cases = {
      {"x = \"0.1*sin(8*pi*tau)\"\n", "", 1.6, 18.5},
      {"force = \"18.5*(1+0.5*cos(16*pi*tau))\"\n", sliding_on, 2, 18.5}};
  for (const Case& of : cases) {
    for (const char* phases : {"4", "8"}) {
      const gnomon::Setup fixed = with(phases, of.cycle, of.velocity);
      Counters counters;
      EXPECT_GT(fixed.model->phase_error(fixed.model->start(counters)).value().error, 0.1)
          << of.cycle << phases;
    }
    const gnomon::Setup chosen = with("\"auto\"", of.cycle, of.velocity);
    EXPECT_GE(chosen.model->phases, 16);
    Counters counters;
    const double flux = observed(*chosen.model, chosen.model->start(counters), "wear_flux");
    EXPECT_NEAR(flux / (2.9e-6 * of.path * of.force), 1, 1e-3) << of.cycle;
  }
}

/// Said before anything is solved, and where estimates are not wanted.
TEST_F(PhaseErrors, OfTheMotionAloneAreRemarked) {
  const auto remarks = [&](const std::string& phases) {
    return setup(phases, "", {"output.phase_errors=false"}).model->remarks;
  };
  EXPECT_THAT(
      remarks("2"),
      Contains("cycle.phases: the mean of speed or force over 2 phases has an error of 57 % "
               "(the cycle has 2 corners and reversals); take more phases"));
  EXPECT_THAT(remarks("16"), Not(Contains(HasSubstr("cycle.phases"))));
}

/// A held cylinder, which turns and comes nearest at tau = 0, wears until it hardly touches: what
/// the phases miss then is small beside what is worn, whatever part of the vanishing rate it is.
TEST_F(PhaseErrors, AtTheEndArePartsOfTheMeanRate) {
  std::string text = text_of(scene("4"));
  text.replace(text.find("force = 18.5"), 12, "approach = 2e-4");
  text.replace(text.find("x = \"0.1 * sin(2*pi*tau)\""), 25,
               "rotation = \"2*pi*tau\"\ny = \"2e-4*(1-cos(2*pi*tau))\"");
  const gnomon::Setup held =
      set_up(folder_.write("held.toml", text), {"time.end=1", "wear.coefficient=1e-4"});
  Counters counters;
  const State start = held.model->start(counters);
  const double first = held.model->phase_error(start).value().error;
  const State last = run_model(*held.model, "esdirk-3", 0, 1e-4, 0.2).last();
  const Observation end = held.model->observe(last);
  const double of_the_mean = held.model->phase_error(last).value().error,
               of_the_rate = of_the_mean * *value_of(end, "worn_volume") / last.t /
                             *value_of(end, "wear_flux");
  EXPECT_GT(of_the_rate, 0.3);
  EXPECT_LT(of_the_mean, 0.01 * first);
}

/// Of a speed that is a rounding error there is no part.
TEST_F(PhaseErrors, AbsentWhereNothingSlides) {
  const std::string still = "0.1 * sin(2*pi*tau)^2 + 0.1 * cos(2*pi*tau)^2";
  const gnomon::Setup idle = setup("6", "", {"cycle.x=\"" + still + "\""});
  Counters counters;
  EXPECT_FALSE(idle.model->phase_error(idle.model->start(counters)));
}

TEST_F(PhaseErrors, AbsentWithoutACycle) {
  std::string text = text_of(scene("4"));
  text.erase(text.find("[cycle]"));
  text.insert(text.find("press ="), "motion.velocity = [0.4, 0.0]\n");
  const gnomon::Setup steady = set_up(folder_.write("steady.toml", text), {});
  EXPECT_FALSE(steady.model->phase_error);
}

TEST_F(PhaseErrors, ChooseTheFewestPhasesWithinTheTolerance) {
  long last = 0;
  for (const double rtol : {0.1, 0.005}) {
    const gnomon::Setup chosen = setup("\"auto\"", "", {fmt::format("integrator.rtol={}", rtol)});
    const long phases = chosen.model->phases;
    EXPECT_GT(phases, last);
    EXPECT_EQ(chosen.scene.reals("cycle.phases"), std::vector<double>{double(phases)});
    EXPECT_LE(estimate(fmt::format("{}", phases)), rtol);
    if (phases > 4) {
      EXPECT_GT(estimate(fmt::format("{}", phases / 2)), rtol);
    }
    EXPECT_THAT(chosen.model->remarks.back(),
                HasSubstr(fmt::format("cycle.phases = \"auto\": {} phases", phases)));
    last = phases;
  }
}

/// Fixed steps have no tolerance: a thousandth stands for it.
TEST_F(PhaseErrors, ChoosePhasesForFixedSteps) {
  const auto phases = [&](const Overrides& overrides) {
    return setup("\"auto\"", "", overrides).model->phases;
  };
  const Overrides fixed = {"integrator.name=forward-euler", "integrator.step=1"};
  EXPECT_EQ(phases(fixed), phases({"integrator.rtol=1e-3"}));
  EXPECT_GT(phases(fixed), phases({"integrator.rtol=0.1"}));
}

/// What the tolerance is compared with: the error of the worn shape is not larger, but of its size.
TEST_F(PhaseErrors, AtTheStartBoundThatOfTheWornShape) {
  const auto worn = [&](int phases) {
    const gnomon::Setup of = setup(fmt::format("{}", phases), "", {"integrator.rtol=1e-4"});
    return of.model->contact(run_model(*of.model, "esdirk-3", 0, 1e-4, 20).last()).value();
  };
  const ContactSurface exact = worn(32);
  for (const int phases : {4, 8}) {
    const ContactSurface shape = worn(phases);
    double difference = 0, whole = 0;
    for (std::size_t c = 0; c < exact.node.size(); ++c) {
      difference += std::abs(shape.wear_depth[c] - exact.wear_depth[c]);
      whole += exact.wear_depth[c];
    }
    const double guess = estimate(fmt::format("{}", phases));
    EXPECT_LT(difference / whole, 1.2 * guess) << phases;
    EXPECT_GT(difference / whole, 0.05 * guess) << phases;
  }
}

/// Estimates do not change the run; they are in its outcome, its summary and its warnings.
TEST_F(PhaseErrors, AreReportedBesideTheRun) {
  const auto run_of = [&](const char* estimated) {
    const gnomon::Setup of = setup("6", "", {std::string("output.phase_errors=") + estimated});
    const IntegratorSettings settings = integrator_settings(of.scene, *of.model);
    const RunOutcome outcome = run(*of.model, chosen_integrator(of.scene), settings,
                                   store_policy(of.scene), nullptr, RunHooks());
    return std::pair(outcome, summary_json(of.scene, run_header(of), settings, outcome, {}));
  };
  const auto [with, summary] = run_of("true");
  const auto [without, short_summary] = run_of("false");
  EXPECT_TRUE(without.phase_errors.empty());
  EXPECT_EQ(with.counters.newton_iterations, without.counters.newton_iterations);
  EXPECT_EQ(with.state->y, without.state->y);
  ASSERT_EQ(with.phase_errors.size(), 2u);
  EXPECT_EQ(with.phase_errors[0].t, 0);
  EXPECT_EQ(with.phase_errors[1].t, 20);
  EXPECT_NEAR(with.phase_errors[0].error / estimate("6"), 1, 1e-6);
  EXPECT_GT(with.phase_errors[1].error, 0);
  const auto json = nlohmann::json::parse(summary);
  ASSERT_EQ(json.at("phase_errors").size(), 2u);
  EXPECT_EQ(json.at("phase_errors")[1].at("phases"), 6);
  EXPECT_EQ(json.at("phase_errors")[1].at("error"), with.phase_errors[1].error);
  EXPECT_TRUE(nlohmann::json::parse(short_summary).at("phase_errors").empty());
  ASSERT_FALSE(with.warnings.empty());
  EXPECT_THAT(with.warnings.front(),
              AllOf(HasSubstr("the mean over 6 phases has an error of about"),
                    HasSubstr("more than the tolerance of 0.001")));
  EXPECT_TRUE(without.warnings.empty());
}

}  // namespace
}  // namespace gnomon::phase_error_test
