// The worn pin against theory: conservation of wear and the rigid limit; locking. Why the numbers
// differ from theory: docs/equations.md, Accuracy.

#include <algorithm>
#include <cmath>

#include "support/pin.hpp"

namespace gnomon::wear_test {
namespace {

using namespace testing;

constexpr double F = 20, R = 5, k_v = 1e-4;

/// To the end of the scene, with an error in time far below that of the mesh.
PinRun run_accurately(const Overrides& overrides) {
  return run_pin("esdirk-4", 0, 1e-3, 1000, overrides);
}

// Wear and force share the nodal quadrature: at every step the wear flux is k v F.
TEST(Pin, WearFluxIsThatOfTheLoadAtEveryStep) {
  for (const Integrator& integrator : Integrators::all())
    for (const bool locate : {false, true}) {
      if (locate && !integrator.locates_events) continue;
      const PinRun run =
          run_pin(integrator.name, 0, 1e-3, 200, {elements(20)}, locate, to_rounding);
      for (const State& state : run.states)
        EXPECT_NEAR(observed(*run.model, state, "wear_flux") / (k_v * F), 1, 1e-9)
            << integrator.name << (locate ? ", events located" : "");
    }
}

// The worn volume is less than k v F t = 2, because the averaged normal is shorter than one where
// the contact ends in a kink: half as much on half the mesh size, and half as much with the unit
// normal.
TEST(Pin, WornVolumeDeficitIsOfFirstOrderInTheMesh) {
  const auto deficit = [](int n, const char* normal) {
    return 2 - run_accurately({elements(n), std::string("wear.normal=") + normal})
                   .observed("worn_volume");
  };
  const double coarse = deficit(20, "averaged");
  EXPECT_NEAR(coarse, 0.0058, 0.0003);
  EXPECT_NEAR(deficit(40, "averaged") / coarse, 0.5, 0.05);
  EXPECT_NEAR(deficit(20, "normalised") / coarse, 0.5, 0.07);
}

// A rigid pin would be worn to the half width cbrt(3 R k v F t / 2). The difference on a given mesh
// is elastic, proportional to 1/E, except for a part that comes from the mesh.
TEST(Pin, TendsToTheRigidLimitWithStiffness) {
  const double rigid = std::cbrt(3 * R * k_v * F * 1000 / 2);
  std::vector<double> width;
  for (const char* young : {"640", "6400", "64000"})
    width.push_back(run_accurately({elements(20), std::string("body.young_modulus=") + young})
                        .observed("contact_half_width"));
  EXPECT_NEAR((width[0] - width[1]) / (width[1] - width[2]), 10, 1.5);
  EXPECT_NEAR(width[2] / rigid, 1, 0.003);
}

// E = 20 MPa, nu = 0.499: the top comes down by 0.462 mm (80x80, both F-bar elements). Plain cells
// lock.
TEST(Pin, FBarDoesNotLock) {
  const auto approach = [](const char* element) {
    const auto model = pin_model({elements(10), "body.young_modulus=20", "body.poisson_ratio=0.499",
                                  std::string("body.element=") + element});
    Counters counters;
    const auto fields = model->fields(model->start(counters));
    const auto u = std::find_if(fields.begin(), fields.end(), [](const GridField& field) {
      return field.name == "displacement";
    });
    const std::size_t middle_of_top = u->values.size() / 3 - 1 - 5;
    return -u->values.at(3 * middle_of_top + 1);
  };
  EXPECT_NEAR(approach("f-bar"), 0.462, 0.02 * 0.462);
  EXPECT_NEAR(approach("f-bar-variational"), 0.462, 0.02 * 0.462);
  EXPECT_LT(approach("plain"), 0.2);
}

TEST(Pin, ConstraintFormsGiveTheSameSolution) {
  const PinRun eliminated = run_pin("backward-euler", 50, 0, 200, {elements(16)});
  const PinRun multiplier =
      run_pin("backward-euler", 50, 0, 200, {elements(16), "shape.constraint=multiplier"});
  const Eigen::VectorXd X = eliminated.worn_surface();
  EXPECT_LT((multiplier.worn_surface() - X).norm(), 1e-10 * X.norm());
  const auto initial = eliminated.model->contact(eliminated.states[0])->worn;
  EXPECT_GT(std::abs(initial[8][1] - eliminated.model->contact(eliminated.last())->worn[8][1]),
            0.01);
}

// Sec. 4.1: soft and stiff, compressible and nearly incompressible, from rest without hand-set
// steps.
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

// Ten times the paper's wear: the whole width is in contact, and the pressure uniform.
TEST(Pin, WearsDownToItsCorners) {
  const PinRun run = run_pin("bdf", 0, 1e-4, 1000, {elements(12), "wear.coefficient=1e-6"});
  EXPECT_EQ(run.observed("contact_nodes"), 13);
  EXPECT_NEAR(run.observed("max_pressure"), 2, 1e-3);  // F / L
  EXPECT_NEAR(run.observed("worn_volume"), 20, 0.3);
  // With sides that are held the corner nodes continue to carry load.
  const PinRun held =
      run_pin("bdf", 0, 1e-4, 1000, {elements(12), "wear.coefficient=1e-6", "pin.sides=held"});
  EXPECT_GT(held.observed("max_pressure"), 10);
}

// A flat pin never has an event: uniform wear k v F t / L.
TEST(Pin, FlatPinWearsUniformly) {
  const PinRun run = run_pin("esdirk-4", 0, 1e-4, 1000, {elements(6), "pin.radius=1e9"});
  const ContactSurface surface = run.model->contact(run.last()).value();
  for (double depth : surface.wear_depth) EXPECT_NEAR(depth, 0.2, 1e-5);
  for (double pressure : surface.pressure) EXPECT_NEAR(pressure, 2, 1e-2);
}

}  // namespace
}  // namespace gnomon::wear_test
