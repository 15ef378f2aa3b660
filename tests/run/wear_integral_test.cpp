// The integral of the wear flux, and the ledger: its comparison with the worn volume.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/run/run.hpp>
#include <gnomon/run/summary.hpp>
#include <nlohmann/json.hpp>

#include "app/decay.hpp"
#include "run/guards.hpp"
#include "support/pin.hpp"

namespace gnomon::wear_integral_test {
namespace {

using namespace testing;
using test::Decay;
using test::exact_decay;
using ::testing::IsEmpty;

// ---- the ledger

IntegratorSettings settings(double step, double end) {
  IntegratorSettings result;
  result.step = step;
  result.end = end;
  return result;
}

nlohmann::json summary_of(const RunOutcome& outcome) {
  return nlohmann::json::parse(summary_json(pin_scene(), {}, settings(0.5, 2), outcome, {}));
}

TEST(Ledger, StandsInTheSummaryAndBalances) {
  const auto model = model_of("winkler/pin.toml", {"foundation.points=21"});
  const auto& euler = Integrators::find("backward-euler", "integrator");
  const RunOutcome outcome = run(*model, euler, settings(0.5, 2), {}, nullptr, {});
  const auto json = summary_of(outcome);
  const double worn = json["worn_volume"], integral = json["wear_integral"];
  EXPECT_NEAR(worn, 1e-7 * 1000 * 20 * 2, 1e-12);  // k v F t
  EXPECT_NEAR(integral, worn, 1e-12);
  EXPECT_EQ(json["wear_difference"].get<double>(), worn - integral);
}

TEST(Ledger, HasKeysWhateverIsKnown) {
  Decay model;
  model.starts = false;
  const auto failed = summary_of(run(model, exact_decay(), settings(0.5, 2), {}, nullptr, {}));
  for (const char* key : {"worn_volume", "wear_integral", "wear_difference"})
    EXPECT_TRUE(failed.at(key).is_null()) << key;
  const auto equation = model_of("dahlquist/decay.toml");
  IntegratorSettings given = settings(0.1, 1);
  given.scale = 1;
  const auto json =
      summary_of(run(*equation, Integrators::find("backward-euler", ""), given, {}, nullptr, {}));
  EXPECT_TRUE(json.at("wear_difference").is_null());
}

TEST(Ledger, IsOneLineForPeople) {
  EXPECT_THAT(ledger_text({}), IsEmpty());
  EXPECT_EQ(ledger_text({common("worn_volume", 1.99711), common("wear_integral", 2)}),
            "worn volume 1.99711 mm^2, wear integral 2.00000 mm^2, difference -2.9e-03 mm^2 "
            "(-0.14 %)");
  EXPECT_EQ(ledger_text({common("worn_volume", 0, 3), common("wear_integral", 0, 3)}),
            "worn volume 0.00000 mm^3, wear integral 0.00000 mm^3, difference 0.0e+00 mm^3");
}

RunOutcome run_to(double end, const Model& model, const std::string& integrator, double step,
                  double rtol) {
  IntegratorSettings given = settings(step, end);
  given.rtol = rtol;
  given.scale = model.differential_scale;
  given.atol = rtol * given.scale;
  return run(model, Integrators::find(integrator, "integrator"), given, {}, nullptr, {});
}

// With the averaged normal 4.8e-3 are missing.
TEST(Ledger, OfAPinBalancesToTheTolerance) {
  const auto model = pin_model({elements(8), "wear.normal=conservative"});
  for (const char* name : {"esdirk-4", "bdf"}) {
    const RunOutcome outcome = run_to(200, *model, name, 0, 1e-4);
    const Observation& last = outcome.last->scalars;
    EXPECT_NEAR(value_of(last, "wear_integral").value(), 0.4, 1e-8) << name;  // k v F t
    EXPECT_NEAR(wear_difference(last).value(), 0, 1e-5) << name;
  }
}

// The depth of a spring changes only by its wear rate, so that a method integrates both in the same
// way.
TEST(Ledger, OfSpringsBalances) {
  const auto model = model_of("winkler/pin.toml", {"foundation.points=41"});
  for (const char* name : {"backward-euler", "esdirk-3"}) {
    const RunOutcome outcome = run_to(50, *model, name, 10, 1e-4);
    const Observation& last = outcome.last->scalars;
    EXPECT_NEAR(value_of(last, "worn_volume").value(), 0.1, 1e-8) << name;  // k v F t
    EXPECT_NEAR(wear_difference(last).value(), 0, 1e-9) << name;
  }
}

}  // namespace
}  // namespace gnomon::wear_integral_test
