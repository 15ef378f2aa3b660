// Coulomb's coefficient may jump in time while bodies slide as a whole.
#include "stick/stick_scenes.hpp"

namespace gnomon::friction_jump_test {
namespace {

using namespace testing;

class FrictionJump : public Fretting {};

// A pad on springs that slides by what is left of the amplitude a: 2 (a - f p / k) each way.
TEST_F(FrictionJump, IsPassedWhileAPadSlides) {
  const double amplitude = 0.0015, sheared = 0.5 * 20 / 1e4;
  for (const double factor : {0.8, 1.2}) {
    SCOPED_TRACE(factor);
    const auto pad =
        model(bed(fmt::format("x = \"{} * sin(2*pi*tau)\"", amplitude)),
              {"cycle.phases=24", fmt::format("friction.factor=\"if(t > 5e5, {}, 1)\"", factor)});
    const ModelRun run = run_model(*pad, "esdirk-3", 0, 1e-3, 1e6);
    const auto flux = [&](const State& at) { return observed(*pad, at, "wear_flux"); };
    EXPECT_NEAR(flux(run.last()) / flux(run.states.front()),
                (amplitude - factor * sheared) / (amplitude - sheared), 1e-3);
  }
}

}  // namespace
}  // namespace gnomon::friction_jump_test
