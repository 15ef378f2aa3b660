// Two bodies that deform and wear: derivatives of the whole system, the patch test, the
// conservation of forces and volumes.

#include <cmath>
#include <cstdio>

#include "newton/krylov.hpp"
#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::mortar_pair_test {
namespace {

using namespace testing;

/// Every third slave node is open.
constexpr RoughState rough{.every = 3};

TEST(MortarPair, JacobianEqualsCentralDifferences) {
  for (const NormalRule normal :
       {NormalRule::averaged, NormalRule::normalised, NormalRule::conservative})
    for (const Section section : {Section::plane, Section::meridian})
      for (const double friction : {0.0, 0.3}) {
        SCOPED_TRACE(::testing::Message() << int(normal) << int(section) << friction);
        TwoBodies pair{.upper = {.along = 5, .high = 2, .wear = 1e-3},
                       .lower = {.along = 7, .high = 2, .from = 0.1, .wear = 2e-3},
                       .friction = friction,
                       .section = section,
                       .normal = normal};
        pair.lower.from = section == Section::meridian ? 0 : 0.1;
        pair.lower.surface = [](double x) { return 0.05 * std::sin(2 * x); };
        const WearModel<2> model(two_bodies<2>(pair));
        check_jacobian(model.system(), 0, rough_state(model, rough), 0.2, nullptr, 1e-6);
      }
}

TEST(MortarPair, JacobianEqualsCentralDifferencesInSpace) {
  for (const double friction : {0.0, 0.3}) {
    TwoBodies pair{.upper = {.along = 2, .high = 1, .across = 2, .wear = 1e-3},
                   .lower = {.along = 3, .high = 1, .across = 1, .from = 0.1, .wear = 2e-3},
                   .friction = friction};
    const WearModel<3> model(two_bodies<3>(pair));
    check_jacobian(model.system(), 0, rough_state(model, rough), 0.2, nullptr, 1e-6);
  }
}

/// Of the slave's nodes.
template <int dim>
double largest_difference(const ContactSurface& surface, const WearModel<dim>& model,
                          double pressure) {
  double most = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    if (model.assembly().carries[c])
      most = std::max(most, std::abs(surface.pressure[c] / pressure - 1));
  return most;
}

TEST(MortarPair, UniformPressurePassesFlatInterfaces) {
  for (const Section section : {Section::plane, Section::meridian})
    for (const auto& [above, below] : {std::pair{4, 4}, {2, 6}, {6, 2}, {4, 6}, {6, 4}, {5, 7}}) {
      TwoBodies pair{.upper = {.along = above}, .lower = {.along = below}, .section = section};
      const WearModel<2> model(two_bodies<2>(pair));
      Counters counters;
      const State start = model.start(counters);
      const double difference = largest_difference(model.contact(start).value(), model,
                                                   section == Section::plane ? 10 : 5 / M_PI);
      EXPECT_LT(difference, 1e-10);
    }
}

TEST(MortarPair, UniformPressurePassesFlatInterfacesInSpace) {
  for (const auto& [above, below] : {std::pair{3, 3}, {2, 6}, {6, 2}, {2, 3}, {3, 2}}) {
    TwoBodies pair{.upper = {.along = above, .across = above},
                   .lower = {.along = below, .across = below}};
    const WearModel<3> model(two_bodies<3>(pair));
    Counters counters;
    const State start = model.start(counters);
    const double difference = largest_difference(model.contact(start).value(), model, 10);
    EXPECT_LT(difference, 1e-10);
  }
}

// Contact alone holds the upper body, also where it is the master: springs that join the bodies
// keep the stiffness definite, and the solver takes about as many iterations as with one body.
TEST(MortarPair, TheBlockSolverFindsTheStartWhicheverBodyIsTheSlave) {
  for (const bool lower_is_slave : {false, true}) {
    SCOPED_TRACE(lower_is_slave);
    TwoBodies pair{.upper = {.along = 9, .high = 3, .across = 4},
                   .lower = {.along = 6, .high = 3, .across = 3},
                   .lower_is_slave = lower_is_slave};
    pair.upper.surface = [](double x) { return 0.05 * x * x; };
    AssemblyParts<3> parts = two_bodies<3>(pair);
    parts.solver.make = [](const Structure& structure, Counters& counters) {
      return std::make_unique<sundials::BlockSolver>(structure, counters, factor_solvers());
    };
    const WearModel<3> model(std::make_shared<const Assembly<3>>(std::move(parts)));
    Counters counters;
    const State start = model.start(counters);
    EXPECT_NEAR(*value_of(model.observe(start), "contact_force") / pair.force, 1, 1e-3);
    EXPECT_GT(counters.linear_solves, 0);
    EXPECT_LT(double(counters.krylov_iterations), 10.0 * double(counters.linear_solves));
  }
}

/// Wavy blocks pressed together, unlike meshes and moduli, both wearing.
TwoBodies wavy(double upper, double lower) {
  TwoBodies pair{.upper = {.along = 12, .high = 6, .wear = upper},
                 .lower = {.along = 17, .high = 6, .young_modulus = 3000, .wear = lower},
                 .force = 60};
  pair.upper.surface = [](double x) { return 0.01 * (1 - std::cos(M_PI * x)); };
  return pair;
}

TEST(MortarPair, ForcesAndVolumesBalance) {
  for (const double friction : {0.0, 0.3})
    for (const Section section : {Section::plane, Section::meridian}) {
      SCOPED_TRACE(::testing::Message() << friction << int(section));
      TwoBodies pair = wavy(3e-5, 1e-5);
      pair.friction = friction, pair.section = section;
      if (section == Section::meridian) pair.force *= M_PI;
      const WearModel<2> model(two_bodies<2>(pair));
      const ModelRun run = run_model(model, "esdirk-4", 0, 1e-6, pair.duration);
      const Observation end = model.observe(run.last());
      // In the plane the surface is inclined to the velocity.
      const double rounding = section == Section::plane ? 1e-4 : 1e-12;
      const double flux = *value_of(end, "wear_flux"), above = *value_of(end, "wear_flux_upper"),
                   below = *value_of(end, "wear_flux_lower"),
                   power = *value_of(end, "contact_force") * pair.speed;
      EXPECT_NEAR(above + below, flux, 1e-14);
      EXPECT_NEAR(above / (pair.upper.wear * power), 1, rounding);
      EXPECT_NEAR(below / (pair.lower.wear * power), 1, rounding);
      EXPECT_NEAR(*value_of(end, "worn_volume_upper") / *value_of(end, "worn_volume_lower"), 3,
                  1e-5);
      Vector<3> sum = Vector<3>::Zero();
      for (const ResultantForce& force :
           static_cast<const Model&>(model).examine(run.last()).forces)
        sum += Vector<3>::Map(force.force.data());
      EXPECT_LT(sum.norm(), 1e-9 * pair.force);
    }
}

/// Its top is brought down instead of loaded.
AssemblyParts<2> brought_down(AssemblyParts<2> parts, double distance) {
  parts.loads.clear();
  PrescribedValues moved;
  for (const int node : parts.mesh.boundary_nodes("top")) {
    parts.supports.held.row(node).setOnes();
    moved.entries.push_back({node, 1, -distance});
  }
  parts.supports.moved = {moved};
  return parts;
}

TEST(MortarPair, MirroredBodiesAreOneOnAPlane) {
  TwoBodies pair{.upper = {.along = 20, .high = 10, .wear = 2e-5},
                 .lower = {.along = 20, .high = 10, .wear = 2e-5},
                 .force = 60};
  pair.upper.surface = [](double x) { return 0.02 * x * x; };
  pair.lower.surface = [](double x) { return -0.02 * x * x; };
  const WearModel<2> both(brought_down(two_bodies<2>(pair), 0.2)),
      one(brought_down(upper_body(pair), 0.1));
  const ModelRun two = run_model(both, "esdirk-4", 5, 0, pair.duration),
                 alone = run_model(one, "esdirk-4", 5, 0, pair.duration);
  const ContactSurface pressed = both.contact(two.last()).value(),
                       expected = one.contact(alone.last()).value();
  double depth = 0, peak = 0;
  for (std::size_t c = 0; c < expected.node.size(); ++c) {
    const auto at = std::ranges::find(pressed.node, expected.node[c]) - pressed.node.begin();
    depth = std::max(depth, std::abs(pressed.wear_depth[at] - expected.wear_depth[c]));
    peak = std::max(peak, std::abs(pressed.pressure[at] - expected.pressure[c]));
  }
  EXPECT_LT(depth, 1e-4 * *std::ranges::max_element(expected.wear_depth));
  EXPECT_LT(peak, 1e-5 * *std::ranges::max_element(expected.pressure));
}

// In full contact, waves wear away to a uniform pressure, however deep and with whatever meshes.
TEST(MortarPair, DeepWearEndsWithUniformPressure) {
  for (const auto& [above, below] : {std::pair{10, 10}, {10, 15}, {15, 10}, {7, 20}, {20, 7}})
    for (const double depth : {0.1, 0.8}) {
      SCOPED_TRACE(::testing::Message() << above << ":" << below << " depth " << depth);
      TwoBodies pair{.upper = {.along = above, .high = 8, .wear = 1e-5},
                     .lower = {.along = below, .high = 8, .wear = 1e-5},
                     .force = 20};
      pair.upper.surface = [](double x) { return 0.02 * std::cos(M_PI * x); };
      pair.lower.surface = [](double x) { return 0.01 * std::cos(M_PI * x); };
      pair.duration = depth / (pair.upper.wear * pair.force / 2);
      const WearModel<2> model(two_bodies<2>(pair));
      const ModelRun run = run_model(model, "esdirk-3", 0, 1e-4, pair.duration);
      EXPECT_LT(largest_difference(model.contact(run.last()).value(), model, 10), 2e-3);
      for (const char* body : {"worn_volume_upper", "worn_volume_lower"})
        EXPECT_NEAR(*value_of(model.observe(run.last()), body) / (2 * depth), 1, 2e-5);
    }
}

}  // namespace
}  // namespace gnomon::mortar_pair_test
