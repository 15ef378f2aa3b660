// The load ramp at the start: its control on artificial solvers, and the load that it reaches on
// the pin.

#include <fmt/format.h>

#include <cmath>

#include "model/wear_start.hpp"
#include "support/pin.hpp"

namespace gnomon::load_ramp_test {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Converges to y = fraction when the fraction is within `reach` of the guess and below `limit`.
struct Scripted {
  double reach = 1, limit = 1;
  int iterations = 3;
  std::vector<double> fractions{}, guesses{};

  LoadSolve solve() {
    return [this](double fraction, std::span<double> y) {
      fractions.push_back(fraction);
      guesses.push_back(y[0]);
      NewtonReport report;
      report.converged = fraction <= limit && std::abs(fraction - y[0]) <= reach;
      report.iterations = iterations;
      report.reason = "inverted element 7";
      y[0] = report.converged ? fraction : 1e9;
      return report;
    };
  }
};

TEST(LoadRamp, TakesTheWholeLoadWhereItCan) {
  Scripted script;
  std::vector<double> y = {0};
  const RampReport report = ramp_load(script.solve(), {}, y);
  EXPECT_EQ(report.reached, 1);
  EXPECT_EQ(report.increments, 1);
  EXPECT_EQ(report.failures, 0);
  EXPECT_EQ(report.reason, "");
  EXPECT_THAT(y, ElementsAre(1));
}

TEST(LoadRamp, HalvesAndThenFollowsTheSecant) {
  Scripted script{.reach = 0.3};
  std::vector<double> y = {0};
  const RampReport report = ramp_load(script.solve(), {}, y);
  EXPECT_THAT(script.fractions, ElementsAre(1, 0.5, 0.25, 0.5, 0.75, 1));
  EXPECT_THAT(script.guesses, ElementsAre(0, 0, 0, 0.5, 0.75, 1));  // the secant is exact here
  EXPECT_EQ(report.failures, 2);
  EXPECT_EQ(report.increments, 4);
  EXPECT_THAT(y, ElementsAre(1));
}

TEST(LoadRamp, GrowsByAtMostAHalfAndShrinksWhenNewtonToils) {
  std::vector<double> y = {0};
  Scripted quick{.iterations = 1}, slow{.iterations = 12};
  ramp_load(quick.solve(), {.first = 0.1}, y);
  EXPECT_NEAR(quick.fractions[1], 0.25, 1e-15);
  EXPECT_NEAR(quick.fractions[2], 0.475, 1e-15);
  y = {0};
  const RampReport report = ramp_load(slow.solve(), {.first = 0.4, .smallest = 0.05}, y);
  EXPECT_NEAR(slow.fractions[1], 0.6, 1e-15);
  EXPECT_EQ(report.reached, 1);  // shrinking after every success must not continue without end
  EXPECT_LT(report.increments, 12);
}

TEST(LoadRamp, EndsAtTheLimitWithTheLastEquilibrium) {
  Scripted script{.limit = 0.4};
  std::vector<double> y = {0};
  const RampReport report = ramp_load(script.solve(), {}, y);
  EXPECT_NEAR(report.reached, 0.4, 2e-4);
  EXPECT_LE(report.reached, 0.4);
  EXPECT_EQ(report.reason, "inverted element 7");
  EXPECT_EQ(y[0], report.reached);
}

/// The pin's contact problem at the initial shape.
struct ContactProblem {
  std::unique_ptr<Model> model;
  const Assembly<2>& body;
  ComposedSystem<2> system;
  FieldValues<2> values;
  Counters counters;

  explicit ContactProblem(const Overrides& overrides)
      : model(pin_model(overrides)),
        body(equations().assembly()),
        system(equations().composition(), equations().deformation()),
        values(*equations().composition()->fields) {}

  RampReport ramp(const RampOptions& options) {
    return find_equilibrium(equations(), system, options, values, counters);
  }
  const NodalField<2>& u() const { return values.vector(equations().fields().u); }
  Eigen::VectorXd lambda() const { return values.scalar(equations().fields().lambda); }

private:
  const WornBodyEquations<2>& equations() const {
    return dynamic_cast<const WearModel<2>&>(*model).equations();
  }
};

TEST(LoadRamp, EndsWhereItCreeps) {
  Scripted script{.iterations = 100};  // every increment is half the one before
  std::vector<double> y = {0};
  const RampReport report =
      ramp_load(script.solve(), {.first = 1e-3, .smallest = 1e-9, .most = 40}, y);
  EXPECT_EQ(report.increments, 40);
  EXPECT_GT(report.reached, 0);
  EXPECT_LT(report.reached, 1);
  EXPECT_EQ(y[0], report.reached);
  EXPECT_THAT(report.reason, HasSubstr("too small"));
}

TEST(LoadRampOfThePin, DoesNotDependOnTheIncrements) {
  const Overrides soft = {elements(16), "body.young_modulus=20", "body.poisson_ratio=0.499"};
  ContactProblem usual(soft), tiny(soft);
  const RampReport report = usual.ramp(ramp_options(usual.body));
  EXPECT_EQ(report.reached, 1);
  EXPECT_GT(report.increments, 3);
  EXPECT_LT(usual.counters.newton_iterations, 60);
  const RampReport slow = tiny.ramp({.first = 0.01, .largest = 0.01});
  EXPECT_EQ(slow.reached, 1);
  EXPECT_GE(slow.increments, 100);
  EXPECT_LT((usual.u() - tiny.u()).norm(), 1e-9 * tiny.u().norm());
  EXPECT_LT((usual.lambda() - tiny.lambda()).norm(), 1e-8 * tiny.lambda().norm());
}

/// Once the branch of contact is found, factors serve for several iterations.
TEST(LoadRampOfThePin, LastIterationsKeepTheirFactors) {
  ContactProblem pin({elements(40), "body.young_modulus=640"});
  EXPECT_EQ(pin.ramp(ramp_options(pin.body)).increments, 1);
  EXPECT_LE(pin.counters.factorizations, pin.counters.newton_iterations - 2);
  EXPECT_LE(pin.counters.newton_iterations, 15);
  double force = 0;  // carried as exactly as with fresh factors
  for (std::size_t i = 0; i < pin.body.contact_nodes.size(); ++i)
    force -= pin.body.contact_nodes[i].initial_area * pin.lambda()[static_cast<Eigen::Index>(i)];
  EXPECT_NEAR(force, pin.body.scales.force, 1e-9 * pin.body.scales.force);
}

TEST(LoadRampOfThePin, BeginsWithTheWholeLoadUnlessNearlyIncompressibleAndSoft) {
  const auto first = [](const char* young, const char* poisson) {
    const ContactProblem pin({elements(4), std::string("body.young_modulus=") + young,
                              std::string("body.poisson_ratio=") + poisson});
    return ramp_options(pin.body).first;
  };
  EXPECT_EQ(first("640", "0.3"), 1);
  EXPECT_EQ(first("10", "0.3"), 1);
  EXPECT_EQ(first("640", "0.499"), 1);
  EXPECT_NEAR(first("10", "0.499"), 0.03, 1e-3);
}

TEST(LoadRampOfThePin, SoftAndNearlyIncompressibleStaysCheap) {
  const auto model = pin_model({elements(20), "body.young_modulus=10", "body.poisson_ratio=0.499"});
  Counters counters;
  model->start(counters);
  EXPECT_LT(counters.newton_iterations, 70);  // 46 when written; 120 without secant and control
}

TEST(LoadRampOfThePin, RefusalNamesTheElementTheFractionAndTheInvertedCell) {
  // On finer meshes rounding, and thus the BLAS, decides which limit ends the ramp.
  const Overrides too_soft = {elements(6), "body.young_modulus=0.5"};
  ContactProblem pin(too_soft);
  const RampReport report = pin.ramp(ramp_options(pin.body));
  EXPECT_GT(report.reached, 0.5);
  EXPECT_LT(report.reached, 0.65);
  EXPECT_THAT(report.reason, HasSubstr("inverted element"));
  Counters counters;
  try {
    pin.model->start(counters);
    FAIL() << "expected the ramp to end before the whole load";
  } catch (const SolutionError& error) {
    EXPECT_EQ(std::string(error.what()),
              fmt::format("the load or approach at the start is more than this body carries: the "
                          "load ramp found equilibria up to load fraction {:.4g}, and none beyond "
                          "(element f-bar): {}",
                          report.reached, report.reason));
  }
}

// The load that a body carries is proportional to its modulus: forces scale with it.
TEST(LoadRampOfThePin, AHundredthOfTheModulusCarriesAHundredthOfTheLoad) {
  const auto reached = [](const char* young) {
    ContactProblem pin({elements(4), std::string("body.young_modulus=") + young});
    return pin.ramp(ramp_options(pin.body)).reached;
  };
  const double soft = reached("0.1");
  EXPECT_NEAR(reached("1e-3") / soft, 0.01, 1e-3);
  EXPECT_NEAR(reached("1e-6") / soft, 1e-5, 1e-6);
}

// A mean pressure of 2 MPa on E = 2 MPa. That the ramp ends does not mean that there is no
// equilibrium.
TEST(LoadRampOfThePin, FBarRefusesALoadThatOtherElementsCarry) {
  const auto reached = [](const char* element) {
    ContactProblem pin(
        {elements(10), "body.young_modulus=2", std::string("body.element=") + element});
    return pin.ramp(ramp_options(pin.body)).reached;
  };
  EXPECT_LT(reached("f-bar"), 0.7);
  EXPECT_EQ(reached("plain"), 1);
  EXPECT_EQ(reached("f-bar-variational"), 1);
}

}  // namespace
}  // namespace gnomon::load_ramp_test
