// Observations: their columns in files, and the observations of the scenes' models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ball/coarse.hpp"
#include "support/pin.hpp"

namespace gnomon::observation_test {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::SizeIs;

/// "name [unit]" of every column.
std::vector<std::string> headings(const std::vector<Scalar>& columns) {
  std::vector<std::string> texts;
  for (const Scalar& column : columns) texts.push_back(column.name + " [" + column.unit + "]");
  return texts;
}

/// The observation of a model at rest, which may not be in equilibrium.
Observation at_rest(const Model& model) {
  State state;
  state.y.assign(model.system().structure().size, 0.0);
  state.ydot = state.y;
  return model.observe(state);
}

std::vector<std::string> headings(const Model& model) {
  return headings(at_rest(model));
}

// ---- columns. Results of gnomon 0.1.0 have these names, units and order.

TEST(Observation, HasUnitsOfThePlaneOrOfSpace) {
  EXPECT_EQ(common("contact_force", 1).unit, "N/mm");
  EXPECT_EQ(common("contact_force", 1, 3).unit, "N");
  EXPECT_EQ(common("wear_depth", 1, 3).unit, "mm");
  EXPECT_THROW(common("wear_deepth", 1), std::logic_error);
}

TEST(Observation, OfAPin) {
  EXPECT_THAT(
      headings(*pin_model({elements(4), "body.material=linear"})),
      ElementsAre("contact_nodes []", "contact_force [N/mm]", "max_pressure [MPa]",
                  "worn_volume [mm^2]", "wear_flux [mm^2/s]", "element_quality []",
                  "element_volume []", "displacement_gradient []", "contact_half_width [mm]",
                  "wear_depth [mm]", "contact_area [mm]", "contact_area_error [mm]",
                  "force_loads_x [N/mm]", "force_loads_y [N/mm]", "torque_loads_z [N]",
                  "force_supports_x [N/mm]", "force_supports_y [N/mm]", "torque_supports_z [N]",
                  "force_contact_x [N/mm]", "force_contact_y [N/mm]", "torque_contact_z [N]"));
}

TEST(Observation, OfABall) {
  EXPECT_THAT(headings(*model_of(ball_small, ball_mesh(3, 2, 3))),
              ElementsAre("contact_nodes []", "contact_force [N]", "max_pressure [MPa]",
                          "worn_volume [mm^3]", "wear_flux [mm^3/s]", "element_quality []",
                          "element_volume []", "approach [mm]", "wear_depth [mm]",
                          "contact_area [mm^2]", "contact_area_error [mm^2]"));
}

TEST(Observation, OfAGroove) {
  EXPECT_THAT(headings(*model_of(groove_small, block_mesh(4, 4, 2, 0.06))),
              ElementsAre("contact_nodes []", "contact_force [N]", "max_pressure [MPa]",
                          "worn_volume [mm^3]", "wear_flux [mm^3/s]", "element_quality []",
                          "element_volume []", "groove_section [mm^2]", "approach [mm]",
                          "wear_depth [mm]", "contact_area [mm^2]", "contact_area_error [mm^2]"));
}

TEST(Observation, OfSprings) {
  EXPECT_THAT(headings(*model_of("winkler/pin.toml", {"foundation.points=5"})),
              ElementsAre("contact_nodes []", "contact_force [N/mm]", "max_pressure [MPa]",
                          "worn_volume [mm^2]", "wear_flux [mm^2/s]", "contact_half_width [mm]",
                          "wear_depth [mm]"));
}

TEST(Observation, OfATestEquation) {
  EXPECT_THAT(headings(*model_of("dahlquist/decay.toml")),
              ElementsAre("real []", "imaginary []", "magnitude []", "error []"));
}

// ---- by name

TEST(Observation, IsKnownByItsNames) {
  const Observation observed = {{"worn_volume", "mm^3", 2}, {"own", "mm", 0.5}};
  EXPECT_EQ(value_of(observed, "own"), 0.5);
  EXPECT_FALSE(value_of(observed, "wear_flux"));
  EXPECT_EQ(find_scalar(observed, "wear_flux"), nullptr);
  EXPECT_EQ(dimension_of(observed), 3);
  EXPECT_EQ(dimension_of(Observation{common("worn_volume", 2)}), 2);
  EXPECT_EQ(dimension_of(Observation{}), 2);
}

TEST(Observation, BalancesWhatIsWornAgainstTheRate) {
  EXPECT_FALSE(wear_difference({}));
  EXPECT_FALSE(wear_difference({common("worn_volume", 2.25)}));
  EXPECT_EQ(wear_difference({common("worn_volume", 2.25), common("wear_integral", 2)}), 0.25);
}

// ---- the wear flux of a point

void check_flux(const Model& model) {
  Counters counters;
  const State state = model.start(counters);
  const double flux = model.wear_flux({.t = 0, .y = state.y, .branch = state.own_branch()});
  EXPECT_GT(flux, 0);
  EXPECT_EQ(flux, observed(model, state, "wear_flux"));
  // There is no wear on the branch on which all nodes are open.
  const ActiveSet open(model.system().structure().switch_node.size(), 0);
  EXPECT_EQ(model.wear_flux({.t = 0, .y = state.y, .branch = &open}), 0);
}

TEST(WearFlux, IsThatOfTheStateOnItsBranch) {
  check_flux(*pin_model({elements(8)}));
  check_flux(*model_of(ball_small, ball_mesh(3, 2, 3)));
}

TEST(WearFlux, IsProportionalToTheForceOfSprings) {
  const auto model = model_of("winkler/pin.toml", {"foundation.points=41"});
  Counters counters;
  const State state = model->start(counters);
  EXPECT_NEAR(model->wear_flux({.t = 0, .y = state.y}), 1e-7 * 1000 * 20, 1e-12);  // k v F
}

TEST(WearFlux, IsNoneOfATestEquation) {
  EXPECT_FALSE(model_of("dahlquist/decay.toml")->wear_flux);
}

}  // namespace
}  // namespace gnomon::observation_test
