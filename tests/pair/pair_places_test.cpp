// Bodies of pairs that have places over a cycle: derivatives, independence of the frame, volumes.

#include <cmath>
#include <gnomon/linear/inner_solver.hpp>

#include "linear/block_preconditioner.hpp"
#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/turned_bodies.hpp"

namespace gnomon::pair_places_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

template <int dim>
Tensor<dim> rotation(double angle) {
  if constexpr (dim == 2)
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  else
    return Eigen::AngleAxisd(angle, Vector<3>(1, 2, 3).normalized()).toRotationMatrix();
}

/// One phase with these places; of the master's material a velocity in the frame of the slave.
template <int dim>
AssemblyParts<dim> placed(const TwoBodies& pair, const BodyPlace<dim>& slave,
                          const BodyPlace<dim>& master) {
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  Phase<dim> phase{.places = {slave, master}};
  phase.places[1].motion.velocity = slave.turn * parts.pairs.front().motion.velocity;
  parts.phases = {phase};
  return parts;
}

template <int dim>
void check_turned_jacobian(const TwoBodies& pair) {
  const BodyPlace<dim> slave{.turn = rotation<dim>(0.7), .shift = Vector<dim>::Constant(0.3)};
  // A little further than the slave, about the same point.
  const Tensor<dim> more = rotation<dim>(0.02);
  const WearModel<dim> model(
      placed<dim>(pair, slave, {.turn = more * slave.turn, .shift = slave.shift}));
  check_jacobian(model.system(), 0, rough_state(model, {.every = 3}), 0.2, nullptr, 1e-6);
}

TEST(PairPlaces, JacobianEqualsCentralDifferences) {
  for (const double friction : {0.0, 0.3}) {
    TwoBodies pair{.upper = {.along = 5, .high = 2, .wear = 1e-3},
                   .lower = {.along = 7, .high = 2, .from = 0.1, .wear = 2e-3},
                   .friction = friction};
    check_turned_jacobian<2>(pair);
    pair.upper.along = 2, pair.upper.high = pair.lower.high = 1, pair.upper.across = 2;
    pair.lower.along = 3, pair.lower.across = 1;
    check_turned_jacobian<3>(pair);
  }
}

/// Of bodies at rest, turned about the same point and moved on.
template <int dim>
double difference_in_a_turned_frame() {
  BodyPlace<dim> place{.turn = rotation<dim>(2.1)};
  place.shift = 5 * Vector<dim>::Unit(0);
  const TwoBodies pair = bodies_to_turn<dim>();
  return difference_of_starts<dim>(two_bodies<dim>(pair), placed<dim>(pair, place, place));
}

TEST(PairPlaces, WhatTurnsTogetherIsAsAtRest) {
  EXPECT_LT(difference_in_a_turned_frame<2>(), 1e-9);
  EXPECT_LT(difference_in_a_turned_frame<3>(), 1e-9);
}

constexpr const char* cam = "worn_body/cam_and_follower.toml";

// On a flat follower a disc of radius R slides by 2 pi R in a turn, about any centre.
TEST(PairPlaces, AnEccentricCamWearsAsItsPathSays) {
  const auto model = model_of(cam, {});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 100);
  const double path = 2 * M_PI * 10 * 1000, force = 50;
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cam") / (1e-9 * force * path), 1, 2e-5);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_follower") / (2e-9 * force * path), 1,
              2e-5);
  // In space, where the forces of the bore turn against the cam, they balance.
  const Examination facts = model->examine(run.last());
  Vector<3> sum = Vector<3>::Zero();
  for (const ResultantForce& each : facts.forces) sum += Vector<3>::Map(each.force.data());
  EXPECT_LT(sum.norm(), 1e-6 * force);
  EXPECT_NEAR(facts.reactions.front().force[1], force, 1e-4 * force);
  // The block solver takes about as many iterations as without a cycle.
  EXPECT_GT(run.counters.krylov_iterations, 0);
  EXPECT_LT(double(run.counters.krylov_iterations), 10.0 * double(run.counters.linear_solves));
}

/// A rigid rocker with a flat pad, `below` its pivot P, on a disc that turns about the origin.
struct Rocker {
  static constexpr double radius = 10, eccentric = 2, below = 3, load = 50;
  Vector<2> P{40, 13.8}, spring{-3, 16.8};  // where the load acts before it is turned
  double rate = 2 * M_PI / 0.1;

  /// Height of the disc above the pad, at an angle of the disc and of the rocker.
  double overlap(double turn, double angle) const {
    const Vector<2> C = eccentric * Vector<2>(std::cos(turn), std::sin(turn));
    const Vector<2> n(-std::sin(angle), std::cos(angle));
    return (C - P).dot(n) + below + radius;
  }
  double angle(double turn) const {
    double low = -0.3, high = 0.3;  // it turns away from the disc by negative angles
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (overlap(turn, middle) * overlap(turn, low) <= 0 ? high : low) = middle;
    }
    return low;
  }
  /// Force times speed, and what the rocker itself slides by that of the disc, with a sign.
  std::pair<double, double> at(double turn) const {
    constexpr double h = 1e-4;
    const double phi = angle(turn), spin = rate * (angle(turn + h) - angle(turn - h)) / (2 * h);
    const Vector<2> t(std::cos(phi), std::sin(phi)), n(-t[1], t[0]);
    const Vector<2> X = eccentric * Vector<2>(std::cos(turn), std::sin(turn)) + radius * n;
    const Vector<2> from = spring - P, lever = from[0] * t + from[1] * n;
    const double force = load * lever[0] / (X - P).dot(t),
                 speed = rate * Vector<2>(-X[1], X[0]).dot(t);
    return {force * std::abs(speed), spin * below / speed};
  }
};

// The pivot and the cam determine how it is turned in each phase.
TEST(PairPlaces, ARockerRestsOnItsCamInEveryPhase) {
  const auto model = model_of("worn_body/cam_and_rocker.toml", {"mesh.factor=2"});
  const State end = run_model(*model, "esdirk-3", 0, 1e-3, 100).last();
  double power = 0, unseen = 0;
  for (int phase = 0; phase < 8; ++phase) {
    const auto [own, beside] = Rocker{}.at(2 * M_PI * phase / 8);
    power += own / 8, unseen += own * std::abs(beside) / 8;
  }
  EXPECT_NEAR(observed(*model, end, "worn_volume_cam") / (1e-9 * power * 100), 1, 5e-3);
  EXPECT_NEAR(observed(*model, end, "worn_volume_rocker") / (2e-9 * power * 100), 1, 5e-3);
  // What the rocker slides by itself is left out, and told where it is much.
  const Examination facts = model->examine(end);
  ASSERT_TRUE(facts.unseen_sliding);
  EXPECT_EQ(facts.unseen_sliding->body, "rocker");
  EXPECT_NEAR(facts.unseen_sliding->part / (unseen / power), 1, 0.15);
}

// The cycle may begin anywhere: the same places in another order.
TEST(PairPlaces, ARockerRestsWhereverTheCycleBegins) {
  const auto wear = [](const Overrides& overrides) {
    const auto model = model_of("worn_body/cam_and_rocker.toml", overrides);
    const State end = run_model(*model, "esdirk-3", 0, 1e-4, 10).last();
    return observed(*model, end, "worn_volume");
  };
  EXPECT_NEAR(wear({"mesh.factor=2", R"(motion.1.cycle.rotation="2*pi*tau+pi/2")"}) /
                  wear({"mesh.factor=2"}),
              1, 1e-6);
}

// A tooth slides on the other one by the distance from the pitch point times the sum of the speeds
// of rotation; force and path are those of the line of action.
TEST(PairPlaces, GearTeethWearAsTheySlide) {
  constexpr double base = 40 * 0.9396926, pressure_angle = 20 * M_PI / 180, half = 0.157;
  constexpr int pieces = 1000;
  double work = 0;  // of a unit of friction, over a mesh
  for (int k = 0; k < pieces; ++k) {
    const double angle = half * (2 * (k + 0.5) / pieces - 1);
    work += 30 / std::cos(pressure_angle + angle / 2) * 1.5 * base * std::abs(angle) * 2 * half /
            pieces;
  }
  const auto model = model_of("worn_body/gear_teeth.toml", {"mesh.factor=1.5", "time.cycles=3e4"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 300);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_driven") / (1e-8 * work * 3e4), 1, 3e-3);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_driver") / (1e-10 * work * 3e4), 1, 3e-3);
}

// Phases of a stroke press and wear other nodes of the master. What pressures do is inverted
// exactly, so that only derivatives of equilibrium by the shape are left to the iterations.
TEST(PairPlaces, TheBlockSolverInvertsWhatPressuresOfAllPhasesDo) {
  TwoBodies pair{.upper = {.along = 4, .high = 3, .wear = 1e-4},
                 .lower = {.along = 9, .high = 3, .from = -1, .to = 2, .wear = 2e-4}};
  AssemblyParts<2> parts = two_bodies<2>(pair);
  for (const double shift : {-0.4, 0.0, 0.5}) {
    Phase<2> phase;
    phase.weight = 1.0 / 3;
    phase.places.resize(2);
    phase.places[1].shift = shift * Vector<2>::UnitX();
    parts.phases.push_back(phase);
  }
  const WearModel<2> model(std::make_shared<const Assembly<2>>(std::move(parts)));
  Counters counters;
  const State start = model.start(counters);
  const System& system = model.system();
  const Structure& structure = system.structure();
  const ActiveSet branch = active_set(system, 0, start.y);
  std::vector<double> J(structure.pattern.nonzeros()), rest(start.y.size(), 0.0);
  system.jacobian({0, start.y, rest, &branch}, 1e-2, J);
  BlockPreconditioner preconditioner(structure, factor_solvers());
  preconditioner.refresh(J);
  preconditioner.set_up(true);
  std::vector<double> r(start.y.size()), z(start.y.size());
  int pressures = 0;
  for (int l : unknowns_of(structure, {Role::multiplier})) {
    std::vector<double> unit(start.y.size(), 0.0);
    unit[l] = structure.unknown_scale[l];
    multiply(structure.pattern, J, unit, r);
    preconditioner.apply(r, z);
    for (std::size_t i = 0; i < z.size(); ++i) {
      if (structure.block_of(static_cast<int>(i)).role == Role::extension) continue;
      ASSERT_NEAR(z[i], unit[i], 1e-8 * structure.unknown_scale[i]) << l << " " << i;
    }
    ++pressures;
  }
  EXPECT_EQ(pressures, 15);
}

TEST(PairPlaces, MistakesAreNamed) {
  EXPECT_THAT(refusal(cam, {R"(cycle.x="0.1*tau")"}), HasSubstr("expected motion.#.cycle.x"));
  EXPECT_THAT(refusal(cam, {R"(cycle.force="10")"}),
              HasSubstr("expected cycle.load beside [[pair]]"));
}

}  // namespace
}  // namespace gnomon::pair_places_test
