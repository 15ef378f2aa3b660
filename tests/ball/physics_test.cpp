// The balls against theorems, on coarse meshes.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/laws/hertz.hpp>

#include "ball/coarse.hpp"

namespace gnomon::physics_test {
namespace {

using namespace testing;

// On a plane, wear by frictional dissipation is K mu F v at every step, on every mesh; and the
// error of the geometric volume comes from the mesh: it decreases with refinement.
TEST(Ball, WearFluxIsThatOfTheFrictionalDissipation) {
  for (const char* scene : {ball_small, ball_finite})
    for (const char* integrator : {"backward-euler", "esdirk-3", "bdf"}) {
      const auto model = model_of(scene, ball_mesh(4, 2, 1));
      const ModelRun run = run_model(*model, integrator, 0, 1e-2, 1000, false, to_rounding);
      for (const State& state : run.states)
        EXPECT_NEAR(observed(*model, state, "wear_flux") / 0.005, 1, 1e-9)
            << scene << " " << integrator << " t = " << state.t;
    }
}

// A stiff ball wears like a rigid one: the pressure is F/(pi a^2) where pi a^4/(4R) = K mu F v t,
// here a = 2.38 mm; on a mesh with h = a/5 the ring of nodes at the edge determines about 2 h/a of
// it.
TEST(Ball, TendsToTheUniformPressureOfARigidBall) {
  const auto model = model_of(ball_small, ball_mesh(7, 2, 2));
  const ModelRun run = run_model(*model, "bdf", 0, 1e-2, 1000);
  const double a = std::pow(4 * 5 * 5 / M_PI, 0.25), uniform = 100 / (M_PI * a * a);
  const ContactSurface surface = model->contact(run.last()).value();
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double r = std::hypot(surface.initial[c][0], surface.initial[c][1]);
    EXPECT_LT(surface.pressure[c], 1.25 * uniform) << r;
    if (r < a / 2) {
      EXPECT_NEAR(surface.pressure[c], uniform, 0.15 * uniform) << r;
    } else if (r > a + 0.6) {
      EXPECT_EQ(surface.pressure[c], 0) << r;
    }
  }
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume"), 5, 0.05);
}

/// The displacement of nodes in contact along x by friction, and the distance of the resultant of
/// their pressures from their middle (both [mm]).
/// All nodes of the patch have the same area but those in the plane of symmetry, which have half.
std::array<double, 2> drag_and_lean(const ContactSurface& surface) {
  double drag = 0, middle = 0, moment = 0, force = 0, area = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    if (surface.pressure[c] <= 0) continue;
    const double weight = surface.initial[c][1] < 1e-9 ? 0.5 : 1, x = surface.current[c][0];
    drag += weight * (x - surface.worn[c][0]);
    middle += weight * x;
    moment += weight * surface.pressure[c] * x;
    force += weight * surface.pressure[c];
    area += weight;
  }
  return {drag / area, moment / force - middle / area};
}

// Friction drags the ball along with the flat, and as it wears the pressure leans that way (figs.
// 9, 10). Without friction fore and aft are alike.
TEST(Ball, FrictionDragsItAlongAndMakesThePressureLean) {
  const auto model = model_of(ball_finite, ball_mesh(7, 2, 2));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-2, 1000);
  const auto [drag, lean] = drag_and_lean(model->contact(run.last()).value());
  EXPECT_GT(drag, 0.4);
  EXPECT_GT(lean, 0.01);

  const auto smooth =
      model_of(ball_finite, ball_mesh(7, 2, 2) + Overrides{"friction.coefficient=1e-9"});
  Counters counters;
  const auto [none, upright] = drag_and_lean(smooth->contact(smooth->start(counters)).value());
  EXPECT_NEAR(none, 0, 1e-8);
  EXPECT_NEAR(upright, 0, 1e-8);
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

// The groove loses K mu F v t of a length L: its section is 0.2857 mm^2 in the end.
TEST(Groove, SectionIsThatOfTheWornVolume) {
  const auto model = model_of(groove_small, block_mesh(10, 20, 6, 0.06));
  const ModelRun run = run_model(*model, "esdirk-2", 0, 1e-2, 1000);
  EXPECT_NEAR(observed(*model, run.last(), "groove_section") / (4e-7 * 0.5 * 100 * 1e6 / 70), 1,
              0.01);
}

/// Radius where p^2 = c - s r^2 vanishes, by least squares over nodes that carry a good part of
/// the peak.
double radius_of_semi_ellipse(const ContactSurface& surface) {
  const double peak = *std::ranges::max_element(surface.pressure);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double p = surface.pressure[c];
    if (p < 0.4 * peak) continue;
    const double x = surface.initial[c][0], y = surface.initial[c][1];
    const Eigen::Vector2d row(1, x * x + y * y);
    normal += row * row.transpose();
    right += row * p * p;
  }
  const Eigen::Vector2d line = normal.inverse() * right;
  return std::sqrt(-line[0] / line[1]);
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
  EXPECT_NEAR(radius_of_semi_ellipse(model->contact(start).value()) / hertz.radius, 1, 0.05);
}

}  // namespace
}  // namespace gnomon::physics_test
