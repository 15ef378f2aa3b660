// Worn bodies of revolution: derivatives of the whole system, Hertz, wear and the lost volume.

#include <cmath>
#include <cstdio>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/hertz.hpp>
#include <limits>

#include "support/problem_run.hpp"
#include "support/revolved_ball.hpp"
#include "support/rough_state.hpp"

namespace gnomon::revolved_contact_test {
namespace {

using namespace testing;

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(RevolvedContact, JacobianEqualsCentralDifferences) {
  for (const auto technology :
       {ElementTechnology::plain, ElementTechnology::f_bar, ElementTechnology::f_bar_variational})
    for (const Kinematics kinematics : {Kinematics::finite, Kinematics::small})
      for (const NormalRule normal :
           {NormalRule::averaged, NormalRule::normalised, NormalRule::conservative})
        for (const ConstraintForm form : {ConstraintForm::eliminated, ConstraintForm::multiplier}) {
          SCOPED_TRACE(::testing::Message()
                       << int(technology) << int(kinematics) << int(normal) << int(form));
          RevolvedBall ball{.along = 4, .high = 3, .normal = normal};
          ball.element = {technology, kinematics, Section::meridian};
          auto body = revolved_ball(ball);
          body.interface.friction = 0.2;
          body.shape.constraint = form;
          const WearModel<2> model(body);
          const std::vector<double> y = rough_state(model, {.closed = -200, .open = 300});
          check_jacobian(model.system(), 0, y, 0.2, nullptr, 1e-6);
        }
}

// A ball on a plane, the radius of contact a twentieth of the body. E* F R are such that a = 1.
TEST(RevolvedContact, BallOnPlaneIsThatOfHertz) {
  for (const auto technology : {ElementTechnology::plain, ElementTechnology::f_bar}) {
    RevolvedBall ball{.along = 40, .high = 40, .radius = 50, .size = 20, .grading = 2, .wear = 0};
    ball.force = 4 * ball.young_modulus / (1 - 0.09) / (3 * ball.radius);
    ball.element.technology = technology;
    const WearModel<2> model(revolved_ball(ball));
    Counters counters;
    const Observation start = model.observe(model.start(counters));
    const HertzPoint hertz(ball.force, ball.radius, ball.young_modulus, ball.poisson_ratio);
    std::printf("%s: radius %.4f, pressure %.4f of Hertz\n",
                technology_names[static_cast<std::size_t>(technology)],
                *value_of(start, "contact_half_width") / hertz.radius,
                *value_of(start, "max_pressure") / hertz.peak_pressure);
    EXPECT_NEAR(hertz.radius, 1, 1e-12);
    EXPECT_NEAR(*value_of(start, "contact_half_width"), hertz.radius, 0.03);  // facets of 0.2
    EXPECT_NEAR(*value_of(start, "max_pressure") / hertz.peak_pressure, 1, 0.02);
    EXPECT_NEAR(*value_of(start, "contact_force"), ball.force, 1e-6 * ball.force);
    EXPECT_EQ(find_scalar(start, "contact_force")->unit, "N");
    EXPECT_EQ(find_scalar(start, "worn_volume")->unit, "mm^3");
  }
}

// A cylinder with a flat end: the pressure is uniform, and with the same speed everywhere it wears
// evenly.
TEST(RevolvedContact, AFlatEndWearsEvenly) {
  RevolvedBall ball{.radius = inf, .spin = 0, .slide = 0.5};
  ball.element.kinematics = Kinematics::small;
  const WearModel<2> model(revolved_ball(ball));
  const ModelRun run = run_model(model, "esdirk-4", 0, 1e-5, ball.duration);
  const double pressure = ball.force / (M_PI * ball.size * ball.size);
  EXPECT_NEAR(observed(model, run.last(), "displacement_gradient"),
              pressure / 640 * std::sqrt(1 + 2 * 0.3 * 0.3), 1e-10);
  const ContactSurface surface = model.contact(run.last()).value();
  for (std::size_t c = 0; c < surface.pressure.size(); ++c) {
    EXPECT_NEAR(surface.pressure[c], pressure, 1e-8);
    EXPECT_NEAR(surface.wear_depth[c], ball.wear * pressure * ball.slide * ball.duration, 1e-9);
  }
  EXPECT_NEAR(observed(model, run.last(), "contact_half_width"),
              ball.size * (1 + 0.3 * pressure / 640), 1e-8);
}

/// Worn volume and integral of the wear flux of a ball that loses two thirds of a cubic millimetre.
std::array<double, 2> worn(NormalRule normal, ConstraintForm form) {
  RevolvedBall ball{.along = 8, .high = 6, .wear = 2e-4, .normal = normal};
  auto body = revolved_ball(ball);
  body.shape.constraint = form;
  const WearModel<2> model(body);
  Counters counters;
  State state = model.start(counters);
  IntegratorSettings settings = controlled_settings(model, 1e-5, 1000);
  settings.integrand = model.wear_flux;
  const auto stepper =
      Integrators::find("esdirk-4", "integrator").make(model.system(), settings, counters);
  double integral = 0;
  while (state.t < settings.end) integral += stepper->advance(state, settings.end).integral;
  return {observed(model, state, "worn_volume"), integral};
}

TEST(RevolvedContact, VolumeLostIsWhatWears) {
  for (const ConstraintForm form : {ConstraintForm::eliminated, ConstraintForm::multiplier}) {
    const auto [volume, integral] = worn(NormalRule::conservative, form);
    std::printf("worn %.4f mm^3, by the wear integral %.1e more\n", volume, integral - volume);
    EXPECT_GT(volume, 0.5);
    EXPECT_NEAR(volume / integral, 1, 2e-5);
  }
  const auto [volume, integral] = worn(NormalRule::averaged, ConstraintForm::eliminated);
  EXPECT_GT(std::abs(volume / integral - 1), 1e-3);
}

// Far from the axis a ring is a plane body: a tyre whose profile is a disk, per circumference.
TEST(RevolvedContact, FarFromTheAxisIsPlane) {
  const double far = 1e5;
  AssemblyParts<2> ring = revolved_ball({.wear = 0});
  ring.bodies.front().element.technology = ElementTechnology::plain;
  AssemblyParts<2> plane = ring;
  plane.bodies.front().element.section = Section::plane;
  plane.interface.boundary.clear();
  plane.loads.front().forces = uniform_load(plane.mesh, "top", Vector<2>(0, -20));
  for (Vector<2>& X : ring.mesh.nodes) X[0] += far;
  ring.loads.front().forces =
      uniform_load(ring.mesh, "top", Vector<2>(0, -20 * 2 * M_PI * far), Section::meridian);
  ring.interface.boundary.clear();
  ring.scales.force *= 2 * M_PI * far;
  Counters counters;
  const WearModel<2> in_space(ring), in_plane(plane);
  const Observation revolved = in_space.observe(in_space.start(counters)),
                    flat = in_plane.observe(in_plane.start(counters));
  EXPECT_NEAR(*value_of(revolved, "max_pressure") / *value_of(flat, "max_pressure"), 1, 1e-4);
  EXPECT_NEAR(*value_of(revolved, "contact_force") / (2 * M_PI * far),
              *value_of(flat, "contact_force"), 1e-3);
}

TEST(RevolvedContact, RefusesBodiesOfDifferentSections) {
  AssemblyParts<2> parts = revolved_ball({});
  parts.bodies.push_back({.material = parts.bodies.front().material});
  EXPECT_THROW(Assembly<2>{parts}, InputError);
}

}  // namespace
}  // namespace gnomon::revolved_contact_test
