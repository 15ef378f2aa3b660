// Wearing surfaces with laws of their own on one body: the left half of the pin's contact surface
// wears by one law, the right half by another.

#include <gnomon/model/wear_scene.hpp>

#include "support/pin.hpp"

namespace gnomon::two_surfaces_test {
namespace {

using namespace testing;

constexpr const char* plain_law = "wear.rate=k * p * v";
constexpr const char* threshold_law = "wear.rate='2 * k * max(p - 0.5, 0) * v'";  // one kink more

AssemblyParts<2> pin_parts() {
  const auto pin = pin_model({elements(21), "wear.normal=conservative"});
  return dynamic_cast<const WearModel<2>&>(*pin).assembly();
}

WearLaw law(const char* rate) {
  return read_wear_law(pin_scene({rate}));
}

/// No node is on the axis of symmetry; the facet there belongs to the left half.
AssemblyParts<2> halves(const char* left, const char* right) {
  AssemblyParts<2> parts = pin_parts();
  Surface<2> left_half{"left", {}, law(left)}, right_half{"right", {}, law(right)};
  for (const auto& facet : parts.interface.surfaces.front().facets)
    (parts.mesh.nodes[facet[0]][0] > 0 && parts.mesh.nodes[facet[1]][0] > 0 ? right_half
                                                                            : left_half)
        .facets.push_back(facet);
  parts.interface.surfaces = {right_half, left_half};  // what they share wears as the right half
  return parts;
}

Eigen::VectorXd worn_heights(const Model& model) {
  const ModelRun run = run_model(model, "esdirk-4", 0, 1e-4, 100);
  const ContactSurface surface = model.contact(run.last()).value();
  Eigen::VectorXd heights(surface.worn.size());
  for (Eigen::Index c = 0; c < heights.size(); ++c) heights[c] = surface.worn[c][1];
  return heights;
}

TEST(TwoWearingSurfaces, OfOneLawAreOneSurface) {
  AssemblyParts<2> one = pin_parts();
  one.interface.surfaces.front().wear = law(threshold_law);
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
    const bool right = model.assembly().surface_of[c] == 0;
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
  const std::size_t nodes = model.assembly().contact_nodes.size();
  EXPECT_EQ(model.system().structure().switch_node.size(), nodes + nodes / 2);
  const Eigen::VectorXd worn = worn_heights(model), mirror = worn_heights(exchanged).reverse();
  EXPECT_LT((worn - mirror).norm(), 1e-7);
  EXPECT_GT((worn - worn_heights(same)).norm(), 1e-3);
}

}  // namespace
}  // namespace gnomon::two_surfaces_test
