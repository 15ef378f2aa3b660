// Short steps before stored times and at an end by time.until: in runs of the integrators that
// settle, and of no other.
#include <algorithm>
#include <cmath>
#include <gnomon/run/run.hpp>
#include <gnomon/stability/stability.hpp>

#include "part/part_scene.hpp"
#include "support/problem_run.hpp"

namespace gnomon::settled_run_test {
namespace {

using namespace testing;

class SettledRun : public ::testing::TestWithParam<std::string> {
protected:
  const Integrator& integrator() const { return Integrators::find(GetParam(), "integrator"); }

  /// The ends of the steps of a run of the pin in which nodes close, with many stored times.
  std::vector<double> ends(bool settle) const {
    const Scene scene = load_scene(GNOMON_SOURCE_DIR "/problems/pin_on_flat/small_deformation.toml",
                                   {"mesh.elements=[8,6]", "time.end=160", "integrator.rtol=1e-2",
                                    "output.interval=20", "integrator.name=" + GetParam(),
                                    std::string("output.settle=") + (settle ? "true" : "false")},
                                   key_table);
    const auto model = make_model(scene);
    std::vector<double> times;
    const RunHooks hooks{.on_step = [&](const HistoryRow& row) { times.push_back(row.t); }};
    EXPECT_EQ(run(*model, integrator(), integrator_settings(scene, *model), store_policy(scene),
                  nullptr, hooks)
                  .text(),
              "finished");
    return times;
  }
};

// An explicit method solves for the pressures at the end of every step and would gain nothing.
TEST_P(SettledRun, HasShortStepsWhereTheMethodIsImplicit) {
  const auto table = integrator().table({});
  const bool is_implicit = !table || !is_explicit(*table);  // bdf has no table
  EXPECT_EQ(integrator().settles, is_implicit);
  const std::vector<double> times = ends(true);
  if (is_implicit) {
    const auto begins = [](double t) { return std::abs(std::remainder(t + 0.4, 20)) < 1e-9; };
    EXPECT_TRUE(std::ranges::any_of(times, begins));  // two of 0.01 of 20 s
  } else {
    EXPECT_EQ(times, ends(false));
  }
}

std::string parameter_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, SettledRun, ::testing::ValuesIn(Integrators::names()),
                         parameter_name);

/// The time at which a run of the block on a ring ends, and its largest pressure there.
std::pair<double, double> end_of(const Overrides& overrides) {
  const Scene scene = load_scene(shipped("block_on_ring.toml"), overrides, key_table);
  const auto model = make_model(scene);
  const RunOutcome outcome =
      run(*model, chosen_integrator(scene), integrator_settings(scene, *model), store_policy(scene),
          nullptr, {});
  return {outcome.last->t, value_of(outcome.last->scalars, "max_pressure").value()};
}

// A node that closes in the last step protrudes: 97 % without.
TEST(SettledEnd, IsThatOfAnObservationToo) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const auto [end, peak] = end_of({"integrator.name=esdirk-3", "integrator.rtol=1e-3",
                                   "time.until=wear_depth > 0.022032381753841073"});
  const double exact =
      end_of({"integrator.name=bdf", "integrator.rtol=1e-4", "time.end=" + std::to_string(end)})
          .second;
  EXPECT_NEAR(peak / exact, 1, 0.03);
}

}  // namespace
}  // namespace gnomon::settled_run_test
