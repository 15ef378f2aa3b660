// Two methods agree: the two-dimensional pin in plane strain, and the same pin as a
// three-dimensional body whose points do not move along its axis, with a separate shape at every
// node or with the shape of its cross-section.

#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/model/wear_model.hpp>

#include "support/pin.hpp"

namespace gnomon::extruded_pin_test {
namespace {

using namespace testing;

constexpr double thickness = 0.7;

/// The pin, extruded along x by `thickness`; (x, y) of the plane becomes (y, z).
AssemblyParts<3> extruded(const Assembly<2>& pin, bool as_section) {
  const Extrusion extrusion = extrude(pin.mesh, {0, 0.3 * thickness, thickness});
  const std::vector<int>& of = extrusion.section_node;
  const Mesh<3>& mesh = extrusion.mesh;
  const auto nodes = static_cast<Eigen::Index>(of.size());
  NodalFlags<3> held = NodalFlags<3>::Ones(nodes, 3), shape_held = held;
  Field::Values forces = Field::Values::Zero(nodes, 3);
  for (Eigen::Index node = 0; node < nodes; ++node) {
    const double x = mesh.nodes[node][0];
    const double share = x == 0 ? 0.15 : x == thickness ? 0.35 : 0.5;  // of the thickness
    held.row(node).tail<2>() = pin.supports.held.row(of[node]);
    shape_held.row(node).tail<2>() = pin.shape.held.row(of[node]);
    forces.row(node).tail<2>() = share * thickness * pin.loads.front().forces.row(of[node]);
  }
  const Load<3> load{.forces = forces, .presses = true};
  AssemblyParts<3> parts{.mesh = mesh,
                         .bodies = pin.bodies,
                         .supports = {.held = held},
                         .loads = {load},
                         .interface = {.surfaces = {{"bottom", mesh.boundary.at("bottom"),
                                                     pin.interface.surfaces.front().wear}},
                                       .rho = pin.interface.rho},
                         .shape = {.held = shape_held, .law = {pin.shape.law.material}},
                         .scales = pin.scales};
  if (as_section) {
    CrossSection section{extrusion.section, std::vector<int>(pin.mesh.nodes.size(), -1), of,
                         thickness, thickness};
    for (Eigen::Index node = nodes - 1; node >= 0; --node)
      section.node[of[node]] = static_cast<int>(node);
    parts.cross_section = section;
  }
  parts.interface.partner.motion.velocity =
      Vector<3>(0, pin.interface.partner.motion.velocity[0], 0);
  parts.scales.force *= thickness;
  return parts;
}

void check(bool as_section, double tolerance) {
  const auto pin = pin_model({elements(8), "body.element=plain", "body.young_modulus=40"});
  const Assembly<2>& flat = dynamic_cast<const WearModel<2>&>(*pin).assembly();
  const WearModel<3> solid(extruded(flat, as_section));
  const ModelRun expected = run_model(*pin, "backward-euler", 100, 1e-3, 300);
  const ModelRun actual = run_model(solid, "backward-euler", 100, 1e-3, 300);
  const ContactSurface line = pin->contact(expected.last()).value();
  const ContactSurface sheet = solid.contact(actual.last()).value();
  ASSERT_EQ(sheet.node.size(), 3 * line.node.size());
  for (std::size_t c = 0; c < sheet.node.size(); ++c) {
    std::size_t k = 0;  // the node of the plane pin at the same place
    while (k < line.node.size() && line.initial[k][0] != sheet.initial[c][1]) ++k;
    ASSERT_LT(k, line.node.size());
    EXPECT_NEAR(sheet.worn[c][1], line.worn[k][0], tolerance);
    EXPECT_NEAR(sheet.worn[c][2], line.worn[k][1], tolerance);
    EXPECT_NEAR(sheet.pressure[c], line.pressure[k], 1e3 * tolerance);
  }
  EXPECT_GT(observed(*pin, expected.last(), "worn_volume"), 0.5);
  EXPECT_NEAR(observed(solid, actual.last(), "wear_flux") / thickness,
              observed(*pin, expected.last(), "wear_flux"), 1e-12);
}

TEST(ExtrudedPin, WithOneShapeForItsSectionIsThePlanePin) {
  check(true, 1e-9);
}

TEST(ExtrudedPin, WithAShapeOfItsOwnAtEveryNodeIsThePlanePin) {
  check(false, 1e-9);
}

}  // namespace
}  // namespace gnomon::extruded_pin_test
