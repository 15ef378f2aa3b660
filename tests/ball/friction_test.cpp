// Friction in the plane, and wear without friction in space: dimension does not choose physics.

#include <cmath>
#include <gnomon/model/wear_model.hpp>

#include "ball/coarse.hpp"

namespace gnomon::friction_test {
namespace {

using namespace testing;

template <int dim>
AssemblyParts<dim> parts_of(const std::string& scene, const Overrides& overrides) {
  const auto model = model_of(scene, overrides);
  return dynamic_cast<const WearModel<dim>&>(*model).assembly();
}

/// The sum of the contact forces on the counter-body along x, by the force.
double traction_ratio(const WearModel<2>& model, const State& state) {
  Vector<2> force = Vector<2>::Zero();
  for (const ContactNode<2>& node :
       model.equations().contact_nodes(model.system(), model.system().values(state.t, state.y),
                                       {.t = state.t, .y = state.y, .branch = state.own_branch()}))
    force += node.force;
  return force[0] / force[1];
}

// The plane drags the pin along, which its sides hold; the pin wears by K mu F v, more on one side.
TEST(Friction, DragsAndWearsAPinInThePlane) {
  auto parts = parts_of<2>("pin_on_flat/small_deformation.toml", {"mesh.elements=[20, 20]"});
  parts.interface.friction = 0.3;
  parts.interface.surfaces.front().wear =
      WearLaw({.rate = [K = 1e-7 / 0.3](const WearInput& at, auto) {
        return WearRate{.value = K * at.friction_power, .by_friction_power = K};
      }});
  const WearModel<2> model(parts);
  const ModelRun run = run_model(model, "backward-euler", 50, 1e-3, 200);
  for (const State& state : run.states) {
    EXPECT_NEAR(observed(model, state, "wear_flux"), 1e-4 * 20, 1e-9 * 2e-3);
    EXPECT_NEAR(std::abs(traction_ratio(model, state)), 0.3, 1e-12);
  }
  EXPECT_NEAR(observed(model, run.last(), "worn_volume"), 0.4, 0.004);
}

// A ball that wears by k p v on a smooth plane: k v F.
TEST(Friction, IsNotNeededToWearABall) {
  auto parts = parts_of<3>(ball_small, ball_mesh(4, 3, 2));
  parts.interface.friction = 0;
  parts.interface.surfaces.front().wear = archard(1e-8);
  const WearModel<3> model(parts);
  const double speed = parts.interface.partner.motion.velocity[0];
  const ModelRun run = run_model(model, "backward-euler", 250, 1e-3, 500);
  for (const State& state : run.states)
    EXPECT_NEAR(observed(model, state, "wear_flux") /
                    (1e-8 * speed * observed(model, state, "contact_force")),
                1, 1e-9);
}

}  // namespace
}  // namespace gnomon::friction_test
