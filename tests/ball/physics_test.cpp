// The balls against theorems, on coarse meshes.

#include <cmath>
#include <gnomon/hertz.hpp>

#include "ball/coarse.hpp"

namespace gnomon {
namespace {

using namespace testing;

// On a plane, wear by frictional dissipation is K mu F v at every step, on every mesh; and the
// error of the geometric volume is the mesh's: it falls with refinement.
TEST(Ball, WearFluxIsThatOfTheFrictionalDissipation) {
  for (const char* scene : {ball_small, ball_finite})
    for (const char* integrator : {"backward-euler", "esdirk-3", "bdf"}) {
      const auto model = model_of(scene, ball_mesh(4, 2, 1));
      const ModelRun run = run_model(*model, integrator, 0, 1e-2, 1000);
      for (const State& state : run.states)
        EXPECT_NEAR(observed(*model, state, "wear_flux") / 0.005, 1, 1e-9)
            << scene << " " << integrator << " t = " << state.t;
    }
}

// A stiff ball wears like a rigid one: the pressure is F/(pi a^2) where pi a^4/(4R) = K mu F v t,
// here a = 2.38 mm; on a mesh with h = a/5 the ring of nodes at the edge decides about 2 h/a of it.
TEST(Ball, TendsToTheUniformPressureOfARigidBall) {
  const auto model = model_of(ball_small, ball_mesh(7, 2, 2));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-2, 1000);
  const double a = std::pow(4 * 5 * 5 / M_PI, 0.25);
  const ContactSurface surface = model->contact(run.last()).value();
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double r = std::hypot(surface.initial[c][0], surface.initial[c][1]);
    if (r < a / 2) {
      EXPECT_NEAR(surface.pressure[c], 100 / (M_PI * a * a), 0.15 * 5.62) << r;
    } else if (r > a + 0.6) {
      EXPECT_EQ(surface.pressure[c], 0) << r;
    }
  }
}

// The mean wear along the path, times its length, is what the body loses: section times length and
// the integral of the wear rate over the surface agree at every step.
TEST(Groove, WornVolumeIsTheIntegralOfTheWearRate) {
  const auto model = model_of(groove_small, block_mesh(6, 12, 4, 0.08));
  const double step = 1;
  const ModelRun run = run_model(*model, "backward-euler", step, 1e-2, 3);
  double integral = 0;
  for (std::size_t k = 1; k < run.states.size(); ++k)
    integral += step * observed(*model, run.states[k], "wear_flux");
  // What differs is the averaged normal, shorter than one where the groove is curved.
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / integral, 1, 2e-3);
  EXPECT_NEAR(integral / (4e-7 * 0.5 * 100 * 1000 * 3), 1, 0.03);
}

// Hertz: radius and peak pressure of the ball on the block before it wears. The pressure is
// semi-elliptic: p^2 is linear in r^2.
TEST(Groove, StartsFromHertz) {
  const auto model =
      model_of(groove_small, block_mesh(24, 16, 10, 0.03) + Overrides{"friction.coefficient=1e-6"});
  Counters counters;
  const State start = model->start(counters);
  const HertzPoint hertz(100, 5, 1e5, 0.3);
  EXPECT_NEAR(hertz.radius, 0.1506, 1e-4);  // the paper: 0.15 mm and 2.1 GPa
  EXPECT_NEAR(hertz.peak_pressure, 2106, 1);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 100, 0.1);
  EXPECT_NEAR(observed(*model, start, "max_pressure") / hertz.peak_pressure, 1, 0.05);
}

}  // namespace
}  // namespace gnomon
