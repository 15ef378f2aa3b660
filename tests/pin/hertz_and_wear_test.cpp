// The worn pin against theory: Hertz at the start, conservation of wear, the rigid limit.

#include "support/pin.hpp"

#include <cmath>

namespace gnomon {
namespace {

using namespace testing;

constexpr double F = 20, R = 5, E = 640, nu = 0.3, k_v = 1e-4;
const double E_star = E / (1 - nu * nu);
const double hertz_a = std::sqrt(4 * F * R / (M_PI * E_star));
const double hertz_p = 2 * F / (M_PI * hertz_a);

TEST(Pin, StartsFromHertz) {
  EXPECT_NEAR(hertz_p, 29.9, 0.05);
  EXPECT_NEAR(hertz_a, 0.4255, 1e-4);
  std::vector<double> pressure_error, width_error;
  for (int n : {10, 20, 80}) {
    const auto model = pin_model({elements(n)});
    Counters counters;
    const State start = model->start(counters);
    pressure_error.push_back(std::abs(observed(*model, start, "max_pressure") / hertz_p - 1));
    width_error.push_back(std::abs(observed(*model, start, "contact_half_width") / hertz_a - 1));
  }
  EXPECT_LT(pressure_error[2], 0.03);
  EXPECT_LT(width_error[2], 0.03);
  for (int k : {0, 1}) {
    EXPECT_LT(pressure_error[k + 1], pressure_error[k]);
    EXPECT_LT(width_error[k + 1], width_error[k]);
  }
}

// Wear and force share the nodal quadrature: at every step the wear flux is k v F.
TEST(Pin, WearFluxIsThatOfTheLoadAtEveryStep) {
  for (const auto& [integrator, step] :
       {std::pair("forward-euler", 10.0), {"backward-euler", 50.0}, {"bdf", 0.0}}) {
    const PinRun run = run_pin(integrator, step, 1e-3, 200, {elements(20)});
    for (const State& state : run.states)
      EXPECT_NEAR(observed(*run.model, state, "wear_flux") / (k_v * F), 1, 1e-9) << integrator;
  }
}

TEST(Pin, WornAreaAndRigidLimitAtTheEnd) {
  const double rigid = std::cbrt(3 * R * k_v * F * 1000 / 2);
  std::vector<double> width_error;
  for (int n : {10, 20, 40}) {
    const PinRun run = run_pin("backward-euler", 50, 0, 1000, {elements(n)});
    width_error.push_back(std::abs(run.observed("contact_half_width") / rigid - 1));
    if (n == 40) {
      EXPECT_NEAR(run.observed("worn_volume"), 2, 0.003 * 2);
      EXPECT_EQ(run.counters.rejected_steps, 0);
    }
  }
  EXPECT_LT(width_error[1], width_error[0]);
  EXPECT_LT(width_error[2], width_error[1]);
  EXPECT_LT(width_error[2], 0.01);  // the rest is elastic: it shrinks with stiffness, not the mesh
}

TEST(Pin, ConstraintFormsGiveTheSameSolution) {
  const PinRun eliminated = run_pin("backward-euler", 50, 0, 200, {elements(16)});
  const PinRun multiplier =
      run_pin("backward-euler", 50, 0, 200, {elements(16), "shape.constraint=multiplier"});
  const Eigen::VectorXd X = eliminated.worn_surface();
  EXPECT_LT((multiplier.worn_surface() - X).norm(), 1e-10 * X.norm());
  const auto initial = eliminated.model->contact(eliminated.states[0])->worn;
  EXPECT_GT(std::abs(initial[8][1] - eliminated.model->contact(eliminated.last())->worn[8][1]), 0.01);
}

// Sec. 4.1: soft and stiff, compressible and nearly incompressible, from rest without hand-set steps.
TEST(Pin, StartsFromRest) {
  for (const char* young : {"10", "640"})
    for (const char* poisson : {"0.3", "0.499"}) {
      const auto model = pin_model({elements(20), std::string("body.young_modulus=") + young,
                                    std::string("body.poisson_ratio=") + poisson});
      Counters counters;
      const State start = model->start(counters);
      EXPECT_NEAR(observed(*model, start, "contact_force"), F, 1e-9 * F) << young << " " << poisson;
    }
}

}  // namespace
}  // namespace gnomon
