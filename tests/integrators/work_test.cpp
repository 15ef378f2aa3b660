// Counts of the work of whole runs, so that nobody loses an iteration unnoticed. The table is what
// was counted when it was last changed; whoever makes runs cheaper writes the new counts into it.
#include "ball/coarse.hpp"
#include "support/problem_run.hpp"

namespace gnomon::work_test {
namespace {

using namespace testing;

struct Work {
  long steps, newton_iterations, factorizations;
};

struct WorkCase {
  const char* name;
  const char* scene;
  Overrides overrides;
  const char* integrator;
  double rtol;
  Work counted;
};

const char* const pin_scene = "pin_on_flat/small_deformation.toml";
const Overrides stiff_pin = {"mesh.elements=[20,20]", "body.young_modulus=640"};

const WorkCase cases[] = {
    {"pin_esdirk_2", pin_scene, stiff_pin, "esdirk-2", 1e-2, {13, 62, 12}},
    {"pin_esdirk_3", pin_scene, stiff_pin, "esdirk-3", 1e-3, {10, 77, 10}},
    {"pin_esdirk_4", pin_scene, stiff_pin, "esdirk-4", 1e-4, {19, 212, 27}},
    {"pin_bdf", pin_scene, stiff_pin, "bdf", 1e-4, {89, 172, 25}},
    {"ball_small_esdirk_3", ball_small, ball_mesh(5, 2, 3), "esdirk-3", 1e-2, {11, 111, 10}},
    {"ball_finite_bdf", ball_finite, ball_mesh(4, 2, 1), "bdf", 1e-2, {14, 26, 8}},
    {"groove_small_esdirk_2",
     groove_small,
     block_mesh(6, 12, 4, 0.08),
     "esdirk-2",
     1e-2,
     {16, 75, 21}},
};

void PrintTo(const WorkCase& given, std::ostream* out) {
  *out << given.name;
}

class WorkOfARun : public ::testing::TestWithParam<WorkCase> {};

// Rounding chooses other steps on other machines: a tenth is left for that, and what is missing by
// more is an improvement that belongs into the table.
TEST_P(WorkOfARun, IsWhatItWas) {
  const WorkCase& given = GetParam();
  const auto model = model_of(given.scene, given.overrides);
  const Counters counters = run_model(*model, given.integrator, 0, given.rtol, 1000).counters;
  const auto expect = [](const char* what, long counted, long expected) {
    EXPECT_LE(counted, 1.1 * expected + 2) << what;
    EXPECT_GE(counted, 0.9 * expected - 2) << what << ": better; change the table";
  };
  expect("steps", counters.steps, given.counted.steps);
  expect("Newton iterations", counters.newton_iterations, given.counted.newton_iterations);
  expect("factorizations", counters.factorizations, given.counted.factorizations);
}

INSTANTIATE_TEST_SUITE_P(Runs, WorkOfARun, ::testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace gnomon::work_test
