// The run loop: which data are recorded and stored, and how a run may end.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>
#include <nlohmann/json.hpp>

#include "app/decay.hpp"
#include "run/store_schedule.hpp"

namespace gnomon::run_test {
namespace {

using test::Decay;
using test::exact_decay;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Status = RunOutcome::Status;

IntegratorSettings settings(double step, double end) {
  IntegratorSettings result;
  result.step = step;
  result.end = end;
  return result;
}

RunHeader header(const Integrator& integrator) {
  RunHeader result;
  result.problem = "decay";
  result.integrator = integrator.name;
  return result;
}

/// A result file that is removed after the test.
class RunTest : public testing::Test {
protected:
  RunTest() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("gnomon-run-" + std::string(info->name()) + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~RunTest() override { std::filesystem::remove_all(folder_); }

  RunOutcome run_decay(const StorePolicy& policy, const Integrator& integrator = exact_decay(),
                       const RunHooks& hooks = {}, double step = 0.25, double end = 2) {
    ResultWriter writer(file(), header(integrator), {});
    return run(model_, integrator, settings(step, end), policy, &writer, hooks);
  }
  std::filesystem::path file() const { return folder_ / "result.h5"; }

  Decay model_;
  std::filesystem::path folder_;
};

TEST_F(RunTest, RecordsTheStartAndEveryStep) {
  std::vector<double> seen;
  const RunHooks hooks{.on_step = [&](const HistoryRow& row) { seen.push_back(row.t); }};
  const RunOutcome outcome = run_decay({}, exact_decay(), hooks, 0.5);
  EXPECT_EQ(outcome.status, Status::finished);
  EXPECT_THAT(seen, ElementsAre(0, 0.5, 1, 1.5, 2));

  const ResultReader result(file());
  EXPECT_EQ(result.status(), "finished");
  const auto history = result.history();
  ASSERT_EQ(history.size(), 5u);
  EXPECT_EQ(history[0].counters.newton_iterations, 3);
  EXPECT_EQ(history[4].counters.newton_iterations, 11);
  EXPECT_EQ(history[4].counters.steps, 4);  // which the method itself does not count
  EXPECT_EQ(history[4].step.newton_iterations, 2);
  EXPECT_FALSE(history[4].step.restarted);
  EXPECT_EQ(history[4].step.step, 0.5);
  EXPECT_EQ(outcome.state->t, 2);
  EXPECT_NEAR(outcome.state->y[0], std::exp(-2.0), 1e-15);
}

TEST_F(RunTest, SumsWhatTheMethodIntegratesOfTheWearFlux) {
  const RunOutcome outcome = run_decay({}, exact_decay(), {}, 0.5);
  const Scalar& integral = outcome.last->scalars.back();
  EXPECT_EQ(integral.name, "wear_integral");
  EXPECT_EQ(integral.unit, "mm^2");
  EXPECT_NEAR(integral.value, 1 - std::exp(-2.0), 1e-15);
}

TEST_F(RunTest, StoresEveryNthStepAndTheLast) {
  run_decay({.every = 3, .times = {}});
  EXPECT_THAT(ResultReader(file()).stored_times(), ElementsAre(0, 0.75, 1.5, 2));
}

TEST_F(RunTest, StepsEndOnTheTimesThatAreStored) {
  const RunOutcome outcome = run_decay({.every = 0, .times = {0.3, 1.0, 2.0}});
  EXPECT_THAT(ResultReader(file()).stored_times(), ElementsAre(0, 0.3, 1, 2));
  EXPECT_EQ(outcome.counters.steps, 9);
}

TEST_F(RunTest, EndsWhereAnObservationPassesAValue) {
  for (const bool above : {true, false}) {
    const std::string name = above ? "worn_volume" : "wear_flux";
    const RunOutcome outcome = run_decay(
        {.every = 0, .until = Until{name + " is 0.5", "scene", name, above, 0.5}}, exact_decay());
    EXPECT_EQ(outcome.ended_by, "time.until: " + name + " is 0.5");
    const ResultReader result(file());
    EXPECT_EQ(result.status(), "finished: " + name + " is 0.5");
    EXPECT_GE(outcome.last->t, std::log(2));
    EXPECT_NEAR(outcome.last->t, std::log(2), 1e-3 * 0.25);
    EXPECT_THAT(result.stored_times(), ElementsAre(0, outcome.last->t));
    EXPECT_EQ(result.checkpoints().back().rows, long(result.history().size()));
    EXPECT_GT(outcome.counters.rejected_steps, 0);
    EXPECT_EQ(outcome.counters.steps, long(result.history().size()) - 1);
    std::filesystem::remove(file());
  }
  EXPECT_EQ(run_decay({.every = 0}).ended_by, "time.end");
}

TEST_F(RunTest, AnUnknownObservationIsRefused) {
  EXPECT_THAT(
      [&] {
        run_decay({.until = Until{"", "s.toml:2: key", "worn_volum", true, 1}});
      },
      ::testing::ThrowsMessage<InputError>(
          "s.toml:2: key: no observation is called worn_volum, did you mean worn_volume?"));
}

TEST_F(RunTest, InterruptionEndsAfterTheStepAndStoresIt) {
  int steps = 0;
  const RunHooks hooks{.on_step = [&](const HistoryRow&) { ++steps; },
                       .interrupted = [&] { return steps == 4; }};
  const RunOutcome outcome = run_decay({.every = 0, .times = {}}, exact_decay(), hooks);
  EXPECT_EQ(outcome.status, Status::interrupted);
  const ResultReader result(file());
  EXPECT_EQ(result.status(), "interrupted");
  EXPECT_THAT(result.stored_times(), ElementsAre(0, 0.75));
}

TEST_F(RunTest, InterruptionDuringTheStartEndsBeforeTheIntegratorIsMade) {
  Integrator never = exact_decay();
  never.make = [](const System&, const IntegratorSettings&, Counters&) -> std::unique_ptr<Stepper> {
    throw std::logic_error("made");
  };
  const RunHooks hooks{.interrupted = [] { return true; }};
  const RunOutcome outcome = run_decay({.every = 0, .times = {}}, never, hooks);
  EXPECT_EQ(outcome.status, Status::interrupted);
  const ResultReader result(file());
  EXPECT_EQ(result.status(), "interrupted");
  EXPECT_THAT(result.stored_times(), ElementsAre(0));
}

TEST_F(RunTest, FailureStoresTheLastGoodState) {
  const RunOutcome outcome = run_decay({.every = 0, .times = {}}, exact_decay(/*fail_at=*/1.0));
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_EQ(outcome.diagnosis, "inverted element 7");
  const ResultReader result(file());
  EXPECT_EQ(result.status(), "failed: inverted element 7");
  EXPECT_THAT(result.stored_times(), ElementsAre(0, 1));
}

// Steps that succeed; each is a tenth of the remaining time to t = 1 and takes a hundred Newton
// iterations.
TEST_F(RunTest, ARunThatNoLongerGetsAnywhereEnds) {
  struct Vanishing : Stepper {
    Counters& counters;
    explicit Vanishing(Counters& c) : Stepper(c), counters(c) {}
    StepReport take_step(State& state, double) override {
      const double step = (1 - state.t) / 10;
      state.t += step;
      counters.newton_iterations += 100;
      return {.step = step, .order = 1};
    }
    std::vector<double> memory() const override { return {}; }
    void restore(const State&, std::span<const double>) override {}
  };
  Integrator vanishing = exact_decay();
  vanishing.make = [](const System&, const IntegratorSettings&, Counters& counters) {
    return std::make_unique<Vanishing>(counters);
  };
  const RunOutcome outcome = run_decay({.every = 0, .times = {}}, vanishing);
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_THAT(outcome.diagnosis, testing::HasSubstr("lack of progress: the last 5050 Newton"));
  EXPECT_THAT(ResultReader(file()).stored_times(),
              ElementsAre(0, testing::AllOf(testing::Gt(0.999), testing::Lt(1))));
}

TEST_F(RunTest, FailureOfTheStartLeavesNoResult) {
  model_.starts = false;
  const RunOutcome outcome = run_decay({});
  EXPECT_EQ(outcome.status, Status::failed);
  EXPECT_FALSE(outcome.last);
  EXPECT_FALSE(outcome.state);
  EXPECT_EQ(outcome.counters.newton_iterations, 3);
  EXPECT_EQ(outcome.text(), "failed: no equilibrium");
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(RunTest, OtherExceptionsPassThroughAndCloseTheResult) {
  const RunHooks hooks{.on_step = [](const HistoryRow& row) {
    if (row.t > 1) throw std::runtime_error("out of paper");
  }};
  EXPECT_THROW(run_decay({}, exact_decay(), hooks), std::runtime_error);
  EXPECT_EQ(ResultReader(file()).status(), "failed: out of paper");
}

TEST_F(RunTest, NeedsNoWriter) {
  const RunOutcome outcome = run(model_, exact_decay(), settings(0.5, 2), {}, nullptr, {});
  EXPECT_EQ(outcome.status, Status::finished);
  EXPECT_NEAR(outcome.last->scalars.front().value, 1 - std::exp(-2.0), 1e-15);
}

Scene pin_scene(const std::vector<std::string>& overrides) {
  return load_scene(
      std::filesystem::path(GNOMON_SOURCE_DIR) / "problems/pin_on_flat/small_deformation.toml",
      overrides, key_table);
}

TEST(Settings, AbsentToleranceFollowsTheWearDepth) {
  const Decay model;
  const auto given = integrator_settings(pin_scene({"integrator.rtol=1e-3"}), model);
  EXPECT_DOUBLE_EQ(given.atol, 0.25e-3);
  EXPECT_EQ(given.step, 0);  // error control chooses the steps
  EXPECT_EQ(given.end, 1000);
  EXPECT_EQ(given.max_step, 0);
  EXPECT_EQ(given.nonlinear_fraction, 0.01);
  EXPECT_EQ(integrator_settings(pin_scene({"integrator.atol=1e-9"}), model).atol, 1e-9);
}

// bdf begins again with small steps, and goes on to the end instead of beginning at each.
TEST(RunToAnObservation, DoesNotEndAtItsValueButForRounding) {
  const Until until{"contact_force < 100", "scene", "contact_force", false, 100};
  const auto excess_of = [&](double force) {
    return excess(until, {Scalar{"contact_force", "N", force}});
  };
  EXPECT_LT(excess_of(100 - 6e-14), 0);
  EXPECT_LT(excess_of(100), 0);
  EXPECT_GT(excess_of(100 - 1e-6), 0);
}

TEST(RunToAnObservation, TakesFewStepsOfBdf) {
  const gnomon::Setup setup = set_up(
      pin_scene({"integrator.name=bdf", "mesh.elements=[8, 4]", "time.until=worn_volume > 1"}));
  const RunOutcome outcome =
      run(*setup.model, chosen_integrator(setup.scene),
          integrator_settings(setup.scene, *setup.model), store_policy(setup.scene), nullptr, {});
  EXPECT_EQ(outcome.ended_by, "time.until: worn_volume > 1");
  EXPECT_NEAR(value_of(outcome.last->scalars, "worn_volume").value(), 1, 1e-3);
  EXPECT_LT(outcome.counters.steps, 300);
}

// It jumps: what a straight line would say is a thousandth of each step, and a method that begins
// again with small steps comes near to it by ever smaller ones.
TEST(RunToAnObservation, TakesFewStepsToANumberOfNodes) {
  for (const auto& [name, most] : {std::pair("esdirk-3", 40), std::pair("erk-3", 20)}) {
    SCOPED_TRACE(name);
    const gnomon::Setup setup = set_up(pin_scene(
        {std::string("integrator.name=") + name, "mesh.elements=[20, 8]", "body.young_modulus=20",
         "integrator.rtol=1e-3", "time.until=contact_nodes > 11"}));
    const RunOutcome outcome =
        run(*setup.model, chosen_integrator(setup.scene),
            integrator_settings(setup.scene, *setup.model), store_policy(setup.scene), nullptr, {});
    EXPECT_EQ(outcome.ended_by, "time.until: contact_nodes > 11") << outcome.diagnosis;
    EXPECT_GT(value_of(outcome.last->scalars, "contact_nodes").value(), 11);
    EXPECT_LT(outcome.counters.steps, most);
  }
}

TEST(Settings, StoreTimesAreSortedAndChecked) {
  const StorePolicy policy = store_policy(pin_scene({"output.times=[30,0,10,30,1000]"}));
  EXPECT_THAT(policy.times, ElementsAre(10, 30, 1000));
  EXPECT_THROW(store_policy(pin_scene({"output.times=[5, 5.00000001]"})), InputError);
}

TEST(Settings, AnEndByAnObservationIsRead) {
  EXPECT_FALSE(store_policy(pin_scene({})).until);
  EXPECT_FALSE(store_policy(pin_scene({"time.until=\"\""})).until);
  const Until until = *store_policy(pin_scene({"time.until=wear_depth < 1.5e-3"})).until;
  EXPECT_EQ(until.observation, "wear_depth");
  EXPECT_FALSE(until.above);
  EXPECT_EQ(until.value, 1.5e-3);
  EXPECT_EQ(store_policy(pin_scene({"time.until=worn_volume_base plate > 1"})).until->observation,
            "worn_volume_base plate");
  for (const char* bad :
       {"wear_depth", "> 1", "wear_depth > x", "wear_depth >= 1", "a > 1 > 2", "1 < a"})
    EXPECT_THROW(store_policy(pin_scene({std::string("time.until=") + bad})), InputError) << bad;
}

TEST(Settings, AMethodHasKeysOfItsOwn) {
  const Decay model;
  const auto value = [&](const std::string& method, const std::string& override_) {
    const Scene scene = pin_scene({"integrator.name=" + method, override_});
    return integrator_settings(scene, model).own;
  };
  using Own = std::map<std::string, SceneValue>;
  EXPECT_EQ(value("theta", "integrator.alpha=0.75"), (Own{{"integrator.alpha", 0.75}}));
  EXPECT_EQ(value("bdf", "integrator.max_order=2"), (Own{{"integrator.max_order", 2L}}));
  EXPECT_EQ(value("bdf", "integrator.alpha=0.5"), (Own{{"integrator.max_order", 5L}}));
  EXPECT_THAT(
      [&] { value("bdf", "integrator.alpha=0.75"); },
      ::testing::ThrowsMessage<InputError>("--set integrator.alpha: expected none, bdf does "
                                           "not read it (theta does)"));
  EXPECT_THAT(pin_scene({"integrator.name=bdf"}).resolved(), Not(HasSubstr("alpha")));
}

TEST(Settings, KeysThatNothingReadsAreNamed) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const auto remarks = [](const std::vector<std::string>& overrides) {
    return remarks_on_keys(
        set_up(GNOMON_SOURCE_DIR "/problems/worn_body/hertz_cylinder.toml", overrides));
  };
  EXPECT_THAT(remarks({}), ElementsAre());
  EXPECT_THAT(remarks({"mesh.size=100"}), ElementsAre());
}

TEST(Settings, AVelocityBesideAMotionIsNamed) {
  const auto texts = [](const std::vector<std::string>& overrides) {
    return load_scene(GNOMON_SOURCE_DIR "/problems/worn_body/block_on_ring.toml", overrides,
                      key_table)
        .idle_texts();
  };
  EXPECT_THAT(texts({}), ElementsAre());
  EXPECT_THAT(texts({"wear.velocity=5"}),
              ElementsAre(HasSubstr("wear.velocity has no effect: the motion of the")));
  EXPECT_THAT(texts({"wear.velocity=5", "wear.rate=\"k * p * v * exp(-s)\""}), ElementsAre());
}

TEST(Settings, TimesBehindTheEndAreDroppedWithAWord) {
  const Scene scene = pin_scene({"output.times=[30, 1001, 5000]"});
  EXPECT_THAT(store_policy(scene).times, ElementsAre(30));
  EXPECT_THAT(store_policy(scene).beyond, ElementsAre(1001, 5000));
  EXPECT_EQ(dropped_times_text(scene),
            "2 of output.times, from 1001 s on, lie after time.end = 1000 s and are not stored");
  EXPECT_EQ(dropped_times_text(pin_scene({"output.times=[1000]"})), "");
}

TEST(Settings, KeysWithoutAnEffectAreNamed) {
  const std::string step = "integrator.step=5";  // the scene has integrator.rtol
  EXPECT_THAT(pin_scene({step}).idle_texts(),
              ElementsAre("integrator.rtol has no effect: steps are fixed (integrator.step)"));
  EXPECT_THAT(
      pin_scene({step, "integrator.max_step=2", "integrator.atol=1e-6", "output.settle=true"})
          .idle_texts(),
      ElementsAre("integrator.rtol, integrator.atol, integrator.max_step, output.settle have no "
                  "effect: steps are fixed (integrator.step)"));
  EXPECT_THAT(pin_scene({"integrator.name=erk-3", "output.settle=true"}).idle_texts(),
              ElementsAre("output.settle has no effect: erk-3 does not settle pressures"));
  EXPECT_THAT(pin_scene({"solver.method=direct", "solver.preconditioner=factor"}).idle_texts(),
              ElementsAre("solver.preconditioner has no effect: solver.method is \"direct\""));
}

TEST(Settings, DefaultsAndKeysWithAnEffectAreNotNamed) {
  EXPECT_THAT(pin_scene({}).idle_texts(), ElementsAre());
  EXPECT_THAT(pin_scene({"integrator.name=erk-3", "output.settle=false"}).idle_texts(),
              ElementsAre());
  EXPECT_THAT(pin_scene({"integrator.rtol=1e-3", "integrator.max_step=2", "output.settle=true",
                         "solver.preconditioner=factor"})
                  .idle_texts(),
              ElementsAre());
  // The scene in full, as `gnomon check` prints it and results keep it, gives only what has one.
  const Scene fixed =
      pin_scene({"integrator.name=erk-3", "integrator.step=5", "solver.method=direct"});
  const Scene again = parse_scene(fixed.resolved(), "again.toml", {}, key_table);
  EXPECT_EQ(again, fixed);
  EXPECT_THAT(again.idle_texts(), ElementsAre());
}

TEST(Settings, AnIntervalStoresAtItsMultiplesBesideTheTimes) {
  EXPECT_THAT(store_policy(pin_scene({"output.interval=400"})).times, ElementsAre(400, 800));
  EXPECT_THAT(store_policy(pin_scene({"output.interval=500"})).times, ElementsAre(500, 1000));
  EXPECT_THAT(store_policy(pin_scene({"output.interval=400", "output.times=[30]"})).times,
              ElementsAre(30, 400, 800));
  // 3 * 0.1 is not 0.3, but the same time.
  const StorePolicy tenths =
      store_policy(pin_scene({"time.end=0.35", "output.interval=0.1", "output.times=[0.3]"}));
  EXPECT_THAT(tenths.times, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_THROW(store_policy(pin_scene({"output.interval=0.001"})), InputError);
}

TEST(Summary, HoldsCountersScalarsUnknownsAndVersions) {
  const Decay model;
  const RunOutcome outcome = run(model, exact_decay(), settings(0.5, 2), {}, nullptr, {});
  RunHeader facts = header(exact_decay());
  facts.versions = {{"gnomon", "1.2.3"}};
  facts.blocks = model.blocks;
  const auto json = nlohmann::json::parse(
      summary_json(pin_scene({}), facts, settings(0.5, 2), outcome, {"contact is narrow"}));
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["remarks"], nlohmann::json::array({"contact is narrow"}));
  EXPECT_EQ(json["steps"], 4);
  EXPECT_EQ(json["t"], 2.0);
  EXPECT_EQ(json["unknowns"]["amount"], 1);
  EXPECT_EQ(json["versions"]["gnomon"], "1.2.3");
  EXPECT_DOUBLE_EQ(json["worn_volume"], 1 - std::exp(-2.0));
  EXPECT_TRUE(json["max_pressure"].is_null());  // this model has none
  for (const char* key :
       {"rejected_steps", "newton_iterations", "residual_evaluations", "jacobian_evaluations",
        "factorizations", "linear_solves", "krylov_iterations", "preconditioner_setups",
        "wall_seconds", "wear_integral", "contact_half_width", "contact_force"})
    EXPECT_TRUE(json.contains(key)) << key;
}

TEST(Summary, HasTheSameKeysHoweverTheRunEnded) {
  const auto keys_of = [](const RunOutcome& outcome) {
    const auto json = nlohmann::json::parse(
        summary_json(pin_scene({}), header(exact_decay()), settings(0.5, 2), outcome, {}));
    std::vector<std::string> keys;
    for (const auto& [key, value] : json.items()) keys.push_back(key);
    return keys;
  };
  Decay model;
  const RunOutcome good = run(model, exact_decay(), settings(0.5, 2), {}, nullptr, {});
  model.starts = false;
  const RunOutcome failed = run(model, exact_decay(), settings(0.5, 2), {}, nullptr, {});
  EXPECT_FALSE(failed.last);
  EXPECT_EQ(keys_of(good), keys_of(failed));
}

}  // namespace
}  // namespace gnomon::run_test
