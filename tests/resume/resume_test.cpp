// A run that continues from a checkpoint gives the result of the uninterrupted run.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/run/summary.hpp>

#include "resume/runs.hpp"

namespace gnomon::resume_test {
namespace {

using test::bytes_of;
using test::Cut;
using test::expect_same;
using test::expect_same_steps;
using test::Overrides;
using test::resume;
using test::run_scene;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

const std::string pin = "pin_on_flat/small_deformation.toml";

Overrides coarse(const Overrides& further) {
  Overrides all = {"mesh.elements=[8,6]", "time.end=200",        "output.checkpoint_seconds=1e-9",
                   "output.every=3",      "output.times=[55.5]", "integrator.nonlinear_fraction=0"};
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

struct Method {
  const char* name;
  std::string scene;
  Overrides overrides;
  double tolerance = 1e-6;
  friend void PrintTo(const Method& method, std::ostream* stream) { *stream << method.name; }
};

class OneStep : public test::FolderTest, public testing::WithParamInterface<Method> {};

TEST_P(OneStep, ResumedIsTheUninterruptedRunToRounding) {
  const Method& method = GetParam();
  const RunOutcome whole = run_scene(method.scene, method.overrides, file("whole"));
  ASSERT_EQ(whole.status, RunOutcome::Status::finished);
  const long steps = whole.counters.steps;
  for (const long cut : {1L, steps / 3, 2 * steps / 3, steps - 1}) {
    SCOPED_TRACE("cut after step " + std::to_string(cut));
    const Cut how = cut % 2 ? Cut::killed : Cut::interrupted;
    run_scene(method.scene, method.overrides, file("cut"), cut, how);
    if (how == Cut::interrupted) {  // no step is lost
      EXPECT_EQ(ResultReader(file("cut")).checkpoints().back().rows, cut + 1);
    }
    ASSERT_EQ(resume(file("cut")), 0);
    expect_same_steps(file("cut"), file("whole"), method.tolerance);
  }
}

const std::string dahlquist = "dahlquist/decay.toml";

INSTANTIATE_TEST_SUITE_P(
    Methods, OneStep,
    testing::Values(
        Method{"fixed_forward_euler", pin,
               coarse({"integrator.name=forward-euler", "integrator.step=4"})},
        Method{"fixed_backward_euler", pin,
               coarse({"integrator.name=backward-euler", "integrator.step=4"})},
        Method{"fixed_esdirk_3", pin, coarse({"integrator.name=esdirk-3", "integrator.step=10"})},
        Method{"backward_euler", pin,
               coarse({"integrator.name=backward-euler", "integrator.rtol=1e-2"})},
        Method{"theta", pin, coarse({"integrator.name=theta", "integrator.rtol=1e-3"})},
        Method{"esdirk_3", pin, coarse({"integrator.name=esdirk-3", "integrator.rtol=1e-4"})},
        Method{"esdirk_4_settled", pin,
               coarse({"integrator.name=esdirk-4", "integrator.rtol=1e-2", "output.interval=7"})},
        Method{"sdirk_2", pin, coarse({"integrator.name=sdirk-2", "integrator.rtol=1e-3"})},
        Method{"esdirk_4_with_events", pin,
               coarse({"integrator.name=esdirk-4", "integrator.rtol=1e-4",
                       "integrator.events=locate"}),
               1e-4},  // that of the place of an event
        Method{"forward_euler_with_events", pin,
               coarse({"integrator.name=forward-euler", "integrator.rtol=1e-2",
                       "integrator.events=locate"})},
        Method{
            "esdirk_4_with_events_under_an_oscillating_load", pin,
            coarse({"integrator.name=esdirk-4", "integrator.rtol=1e-3", "integrator.events=locate",
                    "load.times=[0, 50, 100, 150]", "load.factors=[1, 0.01, 1, 0.01]"})},
        Method{"fixed_erk_2", pin, coarse({"integrator.name=erk-2", "integrator.step=5"})},
        Method{
            "by_blocks", pin,
            coarse({"integrator.name=esdirk-3", "integrator.rtol=1e-3", "solver.method=block"})}),
    [](const auto& info) { return std::string(info.param.name); });

class Resume : public test::FolderTest {};

// SUNDIALS keeps the history of its methods to itself.
class Sundials : public test::FolderTest, public ::testing::WithParamInterface<std::string> {};

TEST_P(Sundials, GoesOnToItsTolerance) {
  const Overrides overrides = coarse({"integrator.name=" + GetParam(), "integrator.rtol=1e-6"});
  const RunOutcome whole = run_scene(pin, overrides, file("whole"));
  run_scene(pin, overrides, file("cut"), whole.counters.steps / 2);
  const long kept = ResultReader(file("cut")).checkpoints().back().rows;
  ASSERT_GT(kept, 5);
  ASSERT_EQ(resume(file("cut")), 0);
  const ResultReader cut(file("cut")), reference(file("whole"));
  const int order = cut.history()[static_cast<std::size_t>(kept)].step.order;
  EXPECT_EQ(order, GetParam() == "bdf" ? 1 : 3);
  EXPECT_EQ(cut.history().back().t, 200);
  const auto depth = cut.contact(200.0).wear_depth, expected = reference.contact(200.0).wear_depth;
  const double deepest = *std::max_element(expected.begin(), expected.end());
  for (std::size_t i = 0; i < depth.size(); ++i)
    EXPECT_NEAR(depth[i], expected[i], 1e-4 * deepest) << i;
}

INSTANTIATE_TEST_SUITE_P(Methods, Sundials, ::testing::Values("bdf", "erk-3"),
                         [](const auto& info) { return info.param.substr(0, 3); });

// Of a cycle whose number of phases was chosen: it keeps this number.
TEST_F(Resume, OfACycleIsTheUninterruptedRunToRounding) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const std::string flat = "worn_body/cylinder_on_flat.toml";
  for (const char* phases : {"4", "\"auto\""}) {
    SCOPED_TRACE(phases);
    const Overrides overrides = {"mesh.factor=4",
                                 "time.cycles=2000",
                                 "output.times=[700]",
                                 "integrator.rtol=1e-2",
                                 "output.checkpoint_seconds=1e-9",
                                 "integrator.nonlinear_fraction=0",
                                 std::string("cycle.phases=") + phases};
    const RunOutcome whole = run_scene(flat, overrides, file("whole"));
    ASSERT_EQ(whole.status, RunOutcome::Status::finished);
    ASSERT_GE(whole.counters.steps, 4);
    for (const long cut : {1L, whole.counters.steps - 1}) {
      run_scene(flat, overrides, file("cut"), cut, Cut::killed);
      ASSERT_EQ(resume(file("cut")), 0);
      expect_same_steps(file("cut"), file("whole"));
    }
    const auto errors = ResultReader(file("cut")).phase_errors();
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_EQ(errors[0].error, ResultReader(file("whole")).phase_errors()[0].error);
  }
}

/// What was told of the start holds for all that follows.
TEST_F(Resume, OfACycleWarnsOfItsPhasesToo) {
  const std::string cycle = "winkler/cycle.toml", warning = "more than the tolerance of 1e-05";
  const Overrides overrides = {"integrator.rtol=1e-5", "time.cycles=2e4"};
  const RunOutcome first = run_scene(cycle, overrides, file("first"));
  EXPECT_THAT(first.warnings, testing::Contains(HasSubstr(warning)));
  app::RunOptions options;
  options.result = file("first");
  options.end = 3e4;
  testing::internal::CaptureStderr();
  ASSERT_EQ(app::resume_command(options), 0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr(warning));
}

TEST_F(Resume, GoesOnToALaterEnd) {
  const Overrides be = {"mesh.elements=[8,6]", "integrator.name=backward-euler",
                        "integrator.step=10", "integrator.nonlinear_fraction=0"};
  const auto with_end = [&](const char* end) {
    Overrides all = be;
    all.push_back(end);
    return all;
  };
  run_scene(pin, with_end("time.end=200"), file("whole"));
  run_scene(pin, with_end("time.end=120"), file("first"));
  ASSERT_EQ(resume(file("first"), {}, 200.0), 0);
  const ResultReader extended(file("first")), whole(file("whole"));
  EXPECT_EQ(extended.status(), "finished");
  EXPECT_EQ(extended.history().size(), whole.history().size());
  EXPECT_THAT(extended.stored_times(), testing::IsSupersetOf({0.0, 120.0, 200.0}));
  EXPECT_THAT(extended.header().scene, HasSubstr("end = 200"));
  const HistoryRow row = extended.history().back();
  const HistoryRow expected = whole.history().back();
  constexpr double rounding = 1e-3;  // forces and torques that are zero
  for (std::size_t i = 0; i < row.scalars.size(); ++i)
    EXPECT_NEAR(row.scalars[i].value, expected.scalars[i].value,
                1e-8 * std::max(std::abs(expected.scalars[i].value), rounding))
        << row.scalars[i].name;
}

TEST_F(Resume, ARunThatTimeUntilHasEndedGoesOnWithoutIt) {
  run_scene(pin,
            {"mesh.elements=[8,6]", "integrator.name=backward-euler", "integrator.step=10",
             "time.end=200", "time.until=worn_volume > 0.1"},
            file("r"));
  const std::string before = bytes_of(file("r"));
  ASSERT_EQ(ResultReader(file("r")).status(), "finished: worn_volume > 0.1");
  const auto refused =
      ThrowsMessage<InputError>(AllOf(HasSubstr("time.until"), HasSubstr("does not hold yet"),
                                      HasSubstr("got \"worn_volume > 0.1\"")));
  EXPECT_THAT([&] { resume(file("r"), {}, 300.0); }, refused);
  EXPECT_THAT([&] { resume(file("r"), {"output.every=1"}); }, refused);
  EXPECT_EQ(resume(file("r")), 0);  // nothing is left to do
  EXPECT_TRUE(bytes_of(file("r")) == before);
  ASSERT_EQ(resume(file("r"), {"time.until=\"\""}, 300.0), 0);
  EXPECT_EQ(ResultReader(file("r")).status(), "finished");
  EXPECT_EQ(ResultReader(file("r")).history().back().t, 300);
}

/// A load that rises to its triple at t = 20, where the first run ends.
class ResumeAtAJump : public test::FolderTest, public testing::WithParamInterface<const char*> {};

TEST_P(ResumeAtAJump, GoesOnBehindIt) {
  const Overrides all = {
      "mesh.elements=[6,6]",        "load.times=[0,20,20,40]",
      "load.factors=[0.3,0.3,1,1]", "time.end=20",
      "integrator.rtol=1e-5",       std::string("integrator.name=") + GetParam()};
  run_scene(pin, all, file("cut"));
  const double force = 20, velocity = 1000, k = 1e-7;
  const auto last = [&](const char* name) {
    return *value_of(ResultReader(file("cut")).history().back().scalars, name);
  };
  EXPECT_NEAR(last("contact_force"), force, 1e-6);
  ASSERT_EQ(resume(file("cut"), {}, 30.0), 0);
  EXPECT_NEAR(last("wear_integral"), k * force * velocity * (0.3 * 20 + 10), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Methods, ResumeAtAJump,
                         testing::Values("erk-3", "erk-4", "esdirk-3", "bdf"));

// A longer run brings more of the boundary into reach, which the model of the result does not have.
TEST_F(Resume, GoesOnToWhereMoreBoundaryIsInReach) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const Overrides short_run = {"time.end=1000", "output.times=[]", "integrator.rtol=1e-3"};
  run_scene("worn_body/block_on_ring.toml", short_run, file("ring"));
  const std::size_t nodes = ResultReader(file("ring")).contact(0).node.size();
  for (const double end : {7200.0, 8000.0}) {
    SCOPED_TRACE(end);
    ASSERT_EQ(resume(file("ring"), {}, end), 0);
    const ResultReader extended(file("ring"));
    EXPECT_EQ(extended.history().back().t, end);
    EXPECT_EQ(extended.header().model_end, 1000);
    EXPECT_EQ(extended.contact(0).node.size(), nodes);
  }
  const std::vector<HistoryRow> history = ResultReader(file("ring")).history();
  const auto wear = [](const HistoryRow& row) { return *value_of(row.scalars, "worn_volume"); };
  EXPECT_NEAR(wear(history.back()) / (8000 * 2e-9 * 500 * 10.8333), 1, 1e-4);  // k v F t
}

// A support carries the pin, before it is pressed, to facets of the plate that its model is made
// without.
TEST_F(Resume, GoesOnWhereBodiesHaveComeToOtherFacets) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const std::filesystem::path scene = file("scene").replace_filename("pin.toml");
  std::ofstream(file("scene").replace_filename("pin.geo")) << R"(
SetFactory("OpenCASCADE"); Mesh.MeshSizeMin = 0.5; Mesh.MeshSizeMax = 0.5;
Rectangle(1) = {-2, 0, 0, 4, 3}; Rectangle(2) = {-8, -3, 0, 16, 3};
Physical Surface("pin") = {1}; Physical Surface("plate") = {2};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Curve("base") = {5};
)";
  std::ofstream(scene) << R"(problem = "worn_body"
mesh.file = "pin.geo"
body = [ { name = "pin", young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" },
         { name = "plate", young_modulus = 2e4, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["pin", "plate"] } ]
motion = [ { body = "plate", velocity = [10.0, 0.0] } ]
support = [ { on = "base" }, { on = "top", directions = ["x"], value = [2.5] } ]
load = [ { on = "top", force = [0.0, -100.0] } ]
wear = { on = "foot", coefficient = 1e-6 }
time.end = 100
output.checkpoint_seconds = 1e-9
integrator.nonlinear_fraction = 0
)";
  run_scene(scene, {}, file("whole"));
  run_scene(scene, {}, file("cut"), 2);
  ASSERT_EQ(ResultReader(file("cut")).status(), "interrupted");
  ASSERT_EQ(resume(file("cut")), 0);
  expect_same_steps(file("cut"), file("whole"), 1e-6);
}

// Times of the load and output times that differ only by rounding from the end are replaced by it;
// the end may change.
TEST_F(Resume, GoesOnToAMomentBehindWhatWasReached) {
  const Overrides bdf = {"mesh.elements=[6,6]", "integrator.name=bdf", "time.end=0.3"};
  Overrides corner = bdf;
  corner.insert(corner.end(), {"load.times=[0,0.1,0.30000000000000004]", "load.factors=[1,2,0.5]"});
  run_scene(pin, corner, file("corner"));
  EXPECT_EQ(resume(file("corner"), {}, 1.0), 0);
  EXPECT_EQ(ResultReader(file("corner")).status(), "finished");
  for (const char* time : {"0.30000000000000004", "0.3000000000003", "0.300000000001"}) {
    SCOPED_TRACE(time);
    run_scene(pin, bdf, file(time));
    EXPECT_EQ(resume(file(time), {std::string("output.times=[") + time + "]"}, 1.0), 0);
    EXPECT_THAT(ResultReader(file(time)).stored_times(), testing::Contains(std::stod(time)));
  }
}

// A run whose method fails at a step ends with exit code 3.
TEST_F(Resume, GoesOnFromBeforeAFailureWithAnotherTolerance) {
  const Overrides overrides = coarse({"integrator.name=esdirk-3", "integrator.rtol=1e-3"});
  {
    const gnomon::Setup setup = set_up(GNOMON_SOURCE_DIR "/problems/" + pin, overrides);
    Integrator fails = chosen_integrator(setup.scene);
    struct Stops : Stepper {
      Counters unused;  // the method inside counts
      std::unique_ptr<Stepper> inner;
      Stops() : Stepper(unused) {}
      StepReport take_step(State& state, double t_stop) override {
        if (state.t > 100) throw SolutionError("an element is inverted");
        return inner->advance(state, t_stop);
      }
      std::vector<double> memory() const override { return inner->memory(); }
      void restore(const State& state, std::span<const double> memory) override {
        inner->restore(state, memory);
      }
    };
    fails.make = [make = fails.make](const System& system, const IntegratorSettings& settings,
                                     Counters& counters) -> std::unique_ptr<Stepper> {
      auto stepper = std::make_unique<Stops>();
      stepper->inner = make(system, settings, counters);
      return stepper;
    };
    ResultWriter writer(file("r"), run_header(setup), setup.model->grid);
    const auto outcome = run(*setup.model, fails, integrator_settings(setup.scene, *setup.model),
                             store_policy(setup.scene), &writer, {});
    ASSERT_EQ(outcome.status, RunOutcome::Status::failed);
  }
  ASSERT_EQ(ResultReader(file("r")).status(), "failed: an element is inverted");
  ASSERT_EQ(resume(file("r"), {"integrator.rtol=1e-4"}), 0);
  const ResultReader result(file("r"));
  EXPECT_EQ(result.status(), "finished");
  EXPECT_THAT(result.header().scene, HasSubstr("rtol = 0.0001"));
  EXPECT_EQ(result.history().back().t, 200);
}

TEST_F(Resume, AnEarlierEndOfTheContinuationLosesNothing) {
  const Overrides overrides = coarse({"integrator.name=backward-euler", "integrator.step=5"});
  run_scene(pin, overrides, file("r"), 20, Cut::killed);
  const auto rows = static_cast<long>(ResultReader(file("r")).history().size());
  ASSERT_LT(ResultReader(file("r")).checkpoints().back().rows, rows);
  // As if it had been killed before its first step.
  const std::string before = bytes_of(file("r")), sidecar = bytes_of(sidecar_of(file("r")));
  {
    const ResultReader earlier(file("r"));
    ResultWriter writer(file("r"), earlier.header(), earlier.grid(), Earlier::replaced,
                        earlier.history().back().t);
    copy_to_last_checkpoint(earlier, earlier.field_names(), writer);
  }
  EXPECT_TRUE(bytes_of(file("r")) == before);
  EXPECT_EQ(bytes_of(sidecar_of(file("r"))), sidecar);
  EXPECT_FALSE(std::filesystem::exists(file("r").string() + ".part"));
}

TEST_F(Resume, FinishedRunIsLeftAlone) {
  run_scene(pin, coarse({"integrator.name=backward-euler", "integrator.step=20"}), file("r"));
  const std::string before = bytes_of(file("r"));
  EXPECT_EQ(resume(file("r")), 0);
  EXPECT_TRUE(bytes_of(file("r")) == before);
  app::RunOptions summed_up;
  summed_up.result = file("r");
  summed_up.summary = file("r").parent_path() / "r.json";
  EXPECT_THROW(app::resume_command(summed_up), InputError);
  EXPECT_FALSE(std::filesystem::exists(summed_up.summary));
}

TEST_F(Resume, DoesNotReplaceAnEarlierSummary) {
  run_scene(pin, coarse({"integrator.name=backward-euler", "integrator.step=20"}), file("r"), 6);
  app::RunOptions options;
  options.result = file("r");
  options.summary = file("r").parent_path() / "r.json";
  options.quiet = true;
  std::ofstream(options.summary) << "mine";
  EXPECT_THROW(app::resume_command(options), InputError);
  options.force = true;  // does not help if the file is not a summary
  EXPECT_THROW(app::resume_command(options), InputError);
  EXPECT_EQ(bytes_of(options.summary), "mine");
  std::filesystem::remove(options.summary);
  ASSERT_EQ(app::resume_command(options), 0);
  EXPECT_TRUE(is_summary(options.summary));
}

/// Continues a run of the pin as `gnomon resume` does, and interrupts it after one step.
void one_more_step(const Overrides& overrides, const std::filesystem::path& file) {
  const ResultReader earlier(file);
  const gnomon::Setup setup = set_up(GNOMON_SOURCE_DIR "/problems/" + pin, overrides);
  Resumption from;
  from.checkpoint = earlier.checkpoints().back();
  from.row = earlier.history().at(std::size_t(from.checkpoint.rows - 1));
  from.stored = earlier.stored_times().at(std::size_t(from.checkpoint.stored - 1));
  ResultWriter writer(file, run_header(setup), setup.model->grid, Earlier::replaced, from.row.t);
  std::vector<std::string> fields;
  for (const GridField& field : setup.model->fields(state_at(from.checkpoint, *setup.model)))
    fields.push_back(field.name);
  copy_to_last_checkpoint(earlier, fields, writer);
  bool stepped = false;
  const RunHooks hooks{.on_step = [&](const HistoryRow&) { stepped = true; },
                       .interrupted = [&] { return stepped; }};
  run(*setup.model, chosen_integrator(setup.scene), integrator_settings(setup.scene, *setup.model),
      store_policy(setup.scene), &writer, hooks, &from);
}

TEST_F(Resume, ARunOfOneStepAtATimeComesToItsEnd) {
  const Overrides be = {"mesh.elements=[8,6]",
                        "time.end=100",
                        "integrator.name=backward-euler",
                        "integrator.step=20",
                        "output.checkpoint_seconds=0",
                        "integrator.nonlinear_fraction=0"};
  run_scene(pin, be, file("whole"));
  const std::vector<HistoryRow> whole = ResultReader(file("whole")).history();
  run_scene(pin, be, file("slots"), 1);
  for (std::size_t rows = 2; rows < whole.size(); ++rows) {
    EXPECT_EQ(ResultReader(file("slots")).checkpoints().back().rows, long(rows));
    one_more_step(be, file("slots"));
  }
  const std::vector<HistoryRow> slots = ResultReader(file("slots")).history();
  ASSERT_EQ(slots.size(), whole.size());
  const double worn = value_of(whole.back().scalars, "worn_volume").value();
  EXPECT_NEAR(value_of(slots.back().scalars, "worn_volume").value(), worn, 1e-8 * worn);
}

TEST_F(Resume, CheckpointsDoNotChangeTheRun) {
  for (const char* method : {"esdirk-3", "bdf"}) {
    Overrides often = coarse({std::string("integrator.name=") + method}), none = often;
    none[2] = "output.checkpoint_seconds=0";
    run_scene(pin, none, file("whole"));
    run_scene(pin, often, file("often"));
    expect_same_steps(file("often"), file("whole"), 0);
    const HistoryRow a = ResultReader(file("whole")).history().back(),
                     b = ResultReader(file("often")).history().back();
    EXPECT_EQ(a.counters.factorizations, b.counters.factorizations);
    EXPECT_EQ(a.counters.newton_iterations, b.counters.newton_iterations);
  }
}

TEST_F(Resume, BeginsAtTheStartWithoutACheckpoint) {
  Overrides none =
      coarse({"integrator.name=backward-euler", "integrator.step=20", "output.budget=false"});
  none[2] = "output.checkpoint_seconds=0";
  run_scene(pin, none, file("whole"));
  run_scene(pin, none, file("cut"), 6, Cut::killed);
  ASSERT_TRUE(ResultReader(file("cut")).checkpoints().empty());
  ASSERT_EQ(resume(file("cut")), 0);
  expect_same(file("cut"), file("whole"));
}

TEST_F(Resume, RefusesInOneLine) {
  const Overrides be = {"integrator.name=backward-euler", "integrator.step=20"};
  run_scene(pin, coarse(be), file("r"), 6);
  const auto refused = [&](const std::string& name, const Overrides& overrides,
                           std::optional<double> end, const std::string& reason) {
    EXPECT_THAT([&] { resume(file(name), overrides, end); },
                ThrowsMessage<InputError>(AllOf(HasSubstr(reason), Not(HasSubstr("\n")))))
        << reason;
  };
  refused("none", {}, {}, "there is no such file");
  refused("r", {}, 90.0, "expected at least");
  refused("r", {"time.end=70"}, {}, "expected at least");
  refused("r", {"body.young_modulus=20"}, {},
          "--set body.young_modulus: resuming can change only time.end, time.until");
  refused("r", {"integrator.name=theta"}, {}, "resuming can change only");
  refused("r", {"mesh.elements=[9,9]"}, {}, "resuming can change only");
  refused("r", {"mesh.element=[9,9]"}, {}, "did you mean");
  refused("r", {"output.times=[55.5, 56.5, 150]"}, {}, "got 56.5");
  std::ofstream(file("foreign")) << "problem = \"pin_on_flat\"\n";
  refused("foreign", {}, {}, "it is not an HDF5 file");
  const int next = 2;
  test::write_attribute(file("r"), "format_version", H5T_NATIVE_INT, &next);
  refused("r", {}, {}, "its format is 2, this program reads 1");
}

// A key says itself whether it may change, also one of a plug-in.
TEST_F(Resume, KeysOfAnIntegratorMayChangeIfTheySaySo) {
  Integrator own = Integrators::find("backward-euler", "integrator");
  own.name = "own";
  const Key key{.default_value = 1.0};
  own.keys = {key, key};
  own.keys[0].name = "integrator.care";
  own.keys[0].on_resume = true;
  own.keys[1].name = "integrator.way";
  std::vector<double> care;
  own.make = [&, make = own.make](const System& system, const IntegratorSettings& settings,
                                  Counters& counters) {
    care.push_back(std::get<double>(settings.value(own.keys[0])));
    return make(system, settings, counters);
  };
  Integrators::put(own);
  run_scene(pin, coarse({"integrator.name=own", "integrator.step=20", "output.budget=false"}),
            file("r"), 2);
  EXPECT_THROW(resume(file("r"), {"integrator.way=2"}), InputError);
  EXPECT_EQ(resume(file("r"), {"integrator.care=2"}), 0);
  EXPECT_THAT(care, ::testing::ElementsAre(1, 2));
}

TEST_F(Resume, InfoDoesNotInventTheTimeOfAKilledRun) {
  run_scene(pin, coarse({"integrator.name=backward-euler", "integrator.step=20"}), file("r"), 2);
  const auto info = [&] {
    ::testing::internal::CaptureStdout();
    app::info_command(file("r"));
    return ::testing::internal::GetCapturedStdout();
  };
  EXPECT_THAT(info(), Not(HasSubstr("not known")));
  const double none = 0;
  test::write_attribute(file("r"), "wall_seconds", H5T_NATIVE_DOUBLE, &none);
  EXPECT_THAT(info(), HasSubstr("not known: the run goes on, or was killed"));
}

TEST_F(Resume, ARunThatIsStillGoingIsRefused) {
  const gnomon::Setup setup = set_up(GNOMON_SOURCE_DIR "/problems/" + pin,
                                     coarse({"integrator.name=theta", "integrator.step=10"}));
  ResultWriter writer(file("r"), run_header(setup), setup.model->grid);
  int tried = 0;
  const RunHooks hooks{.on_step = [&](const HistoryRow& row) {
    if (row.counters.steps != 10) return;
    ++tried;
    EXPECT_THAT([&] { resume(file("r")); },
                ThrowsMessage<InputError>(HasSubstr("another run is writing it")));
  }};
  const auto settings = integrator_settings(setup.scene, *setup.model);
  run(*setup.model, chosen_integrator(setup.scene), settings, store_policy(setup.scene), &writer,
      hooks);
  EXPECT_EQ(tried, 1);
  EXPECT_EQ(ResultReader(file("r")).status(), "finished");
}

// The row that was written last is not used unless it is complete.
TEST_F(Resume, ADamagedCheckpointFallsBackToTheOneBefore) {
  const Overrides be = coarse({"integrator.name=backward-euler", "integrator.step=5"});
  run_scene(pin, be, file("whole"));
  run_scene(pin, be, file("r"), 30);
  const auto both = ResultReader(file("r")).checkpoints();
  ASSERT_EQ(both.size(), 2u);
  const auto spoil = [&](const Checkpoint& checkpoint) {
    const hid_t id = H5Fopen(file("r").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(id, "gnomon/checkpoints", H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    const hsize_t place[] = {static_cast<hsize_t>(checkpoint.number % 2), 40};
    H5Sselect_elements(space, H5S_SELECT_SET, 1, place);
    const hsize_t one = 1;
    const hid_t memory = H5Screate_simple(1, &one, nullptr);
    const double value = 1e-300;
    EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, &value), 0);
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(id);
  };
  spoil(both[1]);
  ASSERT_EQ(ResultReader(file("r")).checkpoints().size(), 1u);
  ASSERT_EQ(resume(file("r")), 0);
  expect_same_steps(file("r"), file("whole"));
}

// The continuation reads the data that it copies before it replaces the earlier file: here the last
// stored step, which the history does not mention.
TEST_F(Resume, ADamagedResultIsRefusedAndStays) {
  run_scene(pin, coarse({"integrator.name=backward-euler", "integrator.step=20"}), file("r"));
  const std::size_t last = ResultReader(file("r")).stored_times().size() - 1;
  const hid_t id = H5Fopen(file("r").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const std::string field = "steps/0000/" + fmt::format("{:06}", last) + "/shape";
  ASSERT_GE(H5Ldelete(id, field.c_str(), H5P_DEFAULT), 0);
  H5Fclose(id);
  const std::string before = bytes_of(file("r"));
  EXPECT_THROW(resume(file("r"), {}, 300.0), InputError);
  EXPECT_TRUE(bytes_of(file("r")) == before);
  EXPECT_EQ(ResultReader(file("r")).status(), "finished");
}

}  // namespace
}  // namespace gnomon::resume_test
