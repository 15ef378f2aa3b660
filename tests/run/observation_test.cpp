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
  return headings(columns_of(at_rest(model)));
}

// ---- columns. Results of gnomon 0.1.0 have these names, units and order.

TEST(Observation, HasColumnsInOneOrder) {
  Observation all;
  for (const Quantity& quantity : quantities()) all.*quantity.member = 1;
  all.others = {{"error", "", 2}};
  EXPECT_THAT(headings(columns_of(all)),
              ElementsAre("contact_nodes []", "contact_force [N/mm]", "max_pressure [MPa]",
                          "worn_volume [mm^2]", "wear_flux [mm^2/s]", "element_quality []",
                          "element_volume []", "groove_section [mm^2]", "approach [mm]",
                          "displacement_gradient []", "contact_half_width [mm]",
                          "wear_integral [mm^2]", "wear_depth [mm]", "error []"));
  all.dim = 3;
  EXPECT_THAT(headings(columns_of(all)),
              ElementsAre("contact_nodes []", "contact_force [N]", "max_pressure [MPa]",
                          "worn_volume [mm^3]", "wear_flux [mm^3/s]", "element_quality []",
                          "element_volume []", "groove_section [mm^2]", "approach [mm]",
                          "displacement_gradient []", "contact_half_width [mm]",
                          "wear_integral [mm^3]", "wear_depth [mm]", "error []"));
}

TEST(Observation, OfAPin) {
  EXPECT_THAT(headings(*pin_model({elements(4), "body.kinematics=small"})),
              ElementsAre("contact_nodes []", "contact_force [N/mm]", "max_pressure [MPa]",
                          "worn_volume [mm^2]", "wear_flux [mm^2/s]", "element_quality []",
                          "element_volume []", "displacement_gradient []",
                          "contact_half_width [mm]", "wear_depth [mm]"));
}

TEST(Observation, OfABall) {
  EXPECT_THAT(headings(*model_of(ball_small, ball_mesh(3, 2, 3))),
              ElementsAre("contact_nodes []", "contact_force [N]", "max_pressure [MPa]",
                          "worn_volume [mm^3]", "wear_flux [mm^3/s]", "element_quality []",
                          "element_volume []", "approach [mm]", "wear_depth [mm]"));
}

TEST(Observation, OfAGroove) {
  EXPECT_THAT(headings(*model_of(groove_small, block_mesh(4, 4, 2, 0.06))),
              ElementsAre("contact_nodes []", "contact_force [N]", "max_pressure [MPa]",
                          "worn_volume [mm^3]", "wear_flux [mm^3/s]", "element_quality []",
                          "element_volume []", "groove_section [mm^2]", "approach [mm]",
                          "wear_depth [mm]"));
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

// ---- and back

TEST(Observation, IsReadFromItsColumns) {
  for (const int dim : {2, 3}) {
    Observation observed{.dim = dim};
    double value = 0;
    for (const Quantity& quantity : quantities()) observed.*quantity.member = ++value;
    observed.others = {{"error", "mm", 0.5}};
    const Observation read = observation_of(columns_of(observed));
    EXPECT_EQ(read.dim, dim);
    for (const Quantity& quantity : quantities())
      EXPECT_EQ(read.*quantity.member, observed.*quantity.member) << quantity.name;
    ASSERT_THAT(read.others, SizeIs(1));
    EXPECT_EQ(read.others[0].name, "error");
    EXPECT_EQ(read.others[0].unit, "mm");
    EXPECT_EQ(read.others[0].value, 0.5);
  }
}

TEST(Observation, HasNoMemberWithoutItsColumn) {
  const Observation read = observation_of({{"worn_volume", "mm^3", 2}});
  EXPECT_EQ(read.dim, 3);
  for (const Quantity& quantity : quantities())
    EXPECT_EQ((read.*quantity.member).has_value(), quantity.member == &Observation::worn_volume)
        << quantity.name;
  EXPECT_EQ(unit_of(read, &Observation::wear_flux), "mm^3/s");
}

TEST(Observation, BalancesWhatIsWornAgainstTheRate) {
  Observation observed;
  EXPECT_FALSE(observed.wear_difference());
  observed.worn_volume = 2.25;
  EXPECT_FALSE(observed.wear_difference());
  observed.wear_integral = 2;
  EXPECT_EQ(observed.wear_difference(), 0.25);
}

// ---- the wear flux of a point

void check_flux(const Model& model) {
  Counters counters;
  const State state = model.start(counters);
  const double flux = model.wear_flux({.t = 0, .y = state.y, .branch = state.own_branch()});
  EXPECT_GT(flux, 0);
  EXPECT_EQ(flux, model.observe(state).wear_flux);
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
