// Wearing surfaces with laws of their own on one body: the left half of the pin's contact surface
// wears by one law, the right half by another.

#include <gnomon/model/wear_scene.hpp>

#include "support/pin.hpp"

namespace gnomon::two_surfaces_test {
namespace {

using namespace testing;

constexpr const char* plain_law = "wear.rate=k * p * v";
constexpr const char* threshold_law = "wear.rate='2 * k * max(p - 0.5, 0) * v'";  // one kink more

std::shared_ptr<WornBody<2>> pin_body() {
  const auto pin = pin_model({elements(21), "wear.normal=conservative"});
  return std::make_shared<WornBody<2>>(dynamic_cast<const WearModel<2>&>(*pin).body());
}

WearLaw law(const char* rate) {
  return read_wear_law(pin_scene({rate}));
}

/// No node is on the axis of symmetry.
std::shared_ptr<WornBody<2>> halves(const char* left, const char* right) {
  auto body = pin_body();
  body->contact.wear = law(left);
  body->further_wear = {law(right)};
  for (const auto& patch : body->contact_nodes)
    body->wear_surface.push_back(patch.initial_position[0] > 0);
  return body;
}

Eigen::VectorXd worn_heights(const Model& model) {
  const ModelRun run = run_model(model, "esdirk-4", 0, 1e-4, 100);
  const ContactSurface surface = model.contact(run.last()).value();
  Eigen::VectorXd heights(surface.worn.size());
  for (Eigen::Index c = 0; c < heights.size(); ++c) heights[c] = surface.worn[c][1];
  return heights;
}

TEST(TwoWearingSurfaces, OfOneLawAreOneSurface) {
  auto one = pin_body();
  one->contact.wear = law(threshold_law);
  EXPECT_EQ(worn_heights(WearModel<2>(halves(threshold_law, threshold_law))),
            worn_heights(WearModel<2>(one)));
}

TEST(TwoWearingSurfaces, WearByTheirOwnLaws) {
  const WearModel<2> model(halves(plain_law, threshold_law));
  Counters counters;
  const State start = model.start(counters);
  const auto nodes = model.equations().contact_nodes(
      model.system(), model.system().values(0, start.y), {.t = 0, .y = start.y});
  const Scene scene = pin_scene();
  const double k_v = scene.real("wear.coefficient") * scene.real("wear.velocity");
  int worn_left = 0, worn_right = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    const double p = -nodes[c].traction;
    const bool right = model.body().wear_surface[c] == 1;
    EXPECT_NEAR(nodes[c].wear_rate, right ? 2 * k_v * std::max(p - 0.5, 0.0) : k_v * p, 1e-12)
        << "node " << c << ", p = " << p;
    (right ? worn_right : worn_left) += nodes[c].wear_rate > 0;
  }
  EXPECT_GT(worn_left, 0);
  EXPECT_GT(worn_right, 0);
}

// Each node has the switching functions of its own law; laws exchanged between the halves give the
// mirror image.
TEST(TwoWearingSurfaces, HaveTheirOwnSwitchingFunctions) {
  const WearModel<2> model(halves(plain_law, threshold_law)),
      exchanged(halves(threshold_law, plain_law)), same(halves(plain_law, plain_law));
  const std::size_t nodes = model.body().contact_nodes.size();
  EXPECT_EQ(model.system().structure().switch_node.size(), nodes + nodes / 2);
  const Eigen::VectorXd worn = worn_heights(model), mirror = worn_heights(exchanged).reverse();
  EXPECT_LT((worn - mirror).norm(), 1e-7);
  EXPECT_GT((worn - worn_heights(same)).norm(), 1e-3);
}

}  // namespace
}  // namespace gnomon::two_surfaces_test
