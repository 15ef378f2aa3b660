// Two bodies at the extremes: moduli, friction, wear and meshes far apart, a single node in
// contact; and how fast Newton's iterations converge.

#include <fmt/format.h>

#include <cmath>
#include <gnomon/newton/algebraic_solver.hpp>
#include <iterator>

#include "support/problem_run.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_extremes_test {
namespace {

using namespace testing;

/// A wave on a flat block.
TwoBodies wave() {
  TwoBodies pair{.upper = {.along = 8, .high = 4, .wear = 2e-5},
                 .lower = {.along = 12, .high = 4, .wear = 1e-5}};
  pair.upper.surface = [](double x) { return 0.02 * (1 - std::cos(M_PI * x)); };
  return pair;
}

/// Runs, and demands that contact carries the load, that volumes are those of the work of friction,
/// and that each body loses its share.
void expect_sound(const TwoBodies& pair, double volume_tolerance = 1e-3) {
  const WearModel<2> model(two_bodies<2>(pair));
  const ModelRun run = run_model(model, "esdirk-3", 0, 1e-4, pair.duration);
  const double power = pair.force * pair.speed * pair.duration,
               wear = pair.upper.wear + pair.lower.wear;
  EXPECT_NEAR(observed(model, run.states.front(), "contact_force") / pair.force, 1, 0.03);
  EXPECT_NEAR(observed(model, run.last(), "worn_volume") / (wear * power), 1, volume_tolerance);
  if (pair.upper.wear > 0) {
    EXPECT_NEAR(observed(model, run.last(), "worn_volume_upper") / (pair.upper.wear * power), 1,
                volume_tolerance);
  }
  Vector<3> sum = Vector<3>::Zero();
  for (const ResultantForce& force : static_cast<const Model&>(model).examine(run.last()).forces)
    sum += Vector<3>::Map(force.force.data());
  EXPECT_LT(sum.norm(), 1e-5 * pair.force);
}

TEST(PairExtremes, ModuliFromOneToAMillion) {
  for (const double ratio : {1e-3, 1e-2, 1e2, 1e4, 1e6}) {
    SCOPED_TRACE(ratio);
    TwoBodies pair = wave();
    (ratio < 1 ? pair.upper : pair.lower).young_modulus *= std::max(ratio, 1 / ratio);
    expect_sound(pair);
  }
}

TEST(PairExtremes, FrictionUpToOne) {
  for (const double friction : {0.1, 0.5, 1.0}) {
    SCOPED_TRACE(friction);
    TwoBodies pair = wave();
    pair.friction = friction;
    // The speed along the inclined surface.
    expect_sound(pair, 2e-2);
  }
}

TEST(PairExtremes, WearOfEitherBodyAlone) {
  for (const bool upper : {true, false}) {
    TwoBodies pair = wave();
    (upper ? pair.lower : pair.upper).wear = 0;
    expect_sound(pair);
  }
}

TEST(PairExtremes, MeshesOneToTen) {
  for (const bool coarse_above : {true, false}) {
    SCOPED_TRACE(coarse_above);
    TwoBodies pair = wave();
    pair.upper.along = coarse_above ? 4 : 40;
    pair.lower.along = coarse_above ? 40 : 4;
    expect_sound(pair);
  }
}

// Contact spreads from the middle to the edge of the lower body, which the upper one overhangs.
TEST(PairExtremes, ContactMovesToTheEdge) {
  for (const bool lower_is_slave : {false, true})
    for (const int along : {8, 12, 19}) {
      SCOPED_TRACE(::testing::Message() << lower_is_slave << " " << along);
      TwoBodies pair = wave();
      pair.upper.surface = [](double x) { return 0.05 * x * x; };
      pair.duration = 500;
      pair.lower.to = 1.5;
      pair.lower.along = along;
      pair.lower_is_slave = lower_is_slave;
      expect_sound(pair);
      const WearModel<2> model(two_bodies<2>(pair));
      const ModelRun run = run_model(model, "esdirk-3", 0, 1e-4, pair.duration);
      EXPECT_LT(observed(model, run.states.front(), "contact_half_width"), 0.7);
      EXPECT_NEAR(observed(model, run.last(), "contact_half_width"), 1.5 / 2, 0.02);
    }
}

TEST(PairExtremes, ASingleNodeTouchesAtFirst) {
  TwoBodies pair = wave();
  pair.upper.surface = [](double x) { return 0.5 * std::abs(x - 1); };
  pair.force = 0.2;
  const WearModel<2> model(two_bodies<2>(pair));
  Counters counters;
  EXPECT_LE(observed(model, model.start(counters), "contact_nodes"), 2);
  expect_sound(pair, 2e-2);
}

// Where the set of contact nodes no longer changes, the error of an iterate is as the square of
// that before.
TEST(PairExtremes, NewtonConvergesQuadratically) {
  for (const double friction : {0.0, 0.3}) {
    SCOPED_TRACE(friction);
    TwoBodies pair = wave();
    pair.force = 300;
    pair.friction = friction;
    const WearModel<2> model(two_bodies<2>(pair));
    const WornBodyEquations<2>& equations = model.equations();
    ComposedSystem<2> contact(equations.composition(), equations.deformation());
    const NonlinearFunction function = algebraic_function(contact);
    Counters counters;
    std::vector<double> y(static_cast<std::size_t>(contact.structure().size));
    contact.numbering().gather(model.system().values(0, model.start(counters).y), y);
    Eigen::Map<Eigen::VectorXd> at(y.data(), std::ssize(y));
    at *= 1.2;
    std::vector<double> G(y.size()), values(contact.structure().pattern.nonzeros());
    std::vector<Eigen::VectorXd> iterates;
    for (int iteration = 0; iteration < 6; ++iteration) {
      function.residual(y, G);
      function.jacobian(y, values);
      at -= dense(contact.structure().pattern, values)
                .partialPivLu()
                .solve(Eigen::Map<Eigen::VectorXd>(G.data(), std::ssize(G)));
      iterates.push_back(at);
    }
    const auto error = [&](std::size_t k) {
      const double result = (iterates[k] - iterates.back()).norm() / iterates.back().norm();
      RecordProperty(fmt::format("error_{}_friction_{}", k, friction),
                     fmt::format("{:.2e}", result));
      return result;
    };
    const double first = error(0), second = error(1), third = error(2);
    EXPECT_GT(second, 1e-8);
    EXPECT_GT(std::log(third / second) / std::log(second / first), 1.6);
  }
}

}  // namespace
}  // namespace gnomon::pair_extremes_test
