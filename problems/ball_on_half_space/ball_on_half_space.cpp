// ball_on_half_space: the paper's sec. 4.3. A rigid ball is pressed into an elastic half-space that
// streams past it with friction and wears at every pass, as the disc of a pin-on-disc test does: a
// groove that is uniform along the sliding direction.
//
// The half-space is a block, by symmetry half of it, on a rigid base (the paper does not define
// depth and outer boundary).
// Its undeformed configuration is fixed in space and the material streams
// through it with v along x; the ball, which does not slide, moves down by w under its force. The
// shape is a field of the cross-section (y, z), and a point wears by the mean of the wear rate
// along its path of length L, of which the block is a part.
//
// The surface is z = 0, touched by the ball at the origin; y = 0 is the plane of symmetry.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/hertz.hpp>
#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/mesh/grid_lines.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

/// With sizes and numbers of elements alike; the number along the block stays even.
std::optional<Scene> with_scaled_elements(const Scene& scene, double factor) {
  std::vector<double> sizes = scene.reals("mesh.size");
  for (double& size : sizes) size *= factor;
  std::vector<long> counts = scene.integers("mesh.elements");
  for (long& count : counts)
    count = std::max(2L, 2 * std::lround(static_cast<double>(count) / (2 * factor)));
  return scene.with("mesh.size", sizes).with("mesh.elements", counts);
}

std::vector<Key> keys() {
  std::vector<Key> result = {
      length_key("ball.radius", "radius R of the ball"),
      length_key("block.length", "length of the block, along the sliding direction"),
      length_key("block.half_width", "half the width of the block"),
      length_key("block.depth", "depth of the block, down to a rigid base"),
      text_key("block.sides", by_default("held"),
               "displacement of the two ends and of the outer side: held at zero, or free",
               {"held", "free"}),
      length_key("path.length",
                 "sliding length L of a cycle: length of the groove along which the ball slides in "
                 "each turn"),
      integers_key("mesh.elements", by_default(std::vector<long>{40, 82, 20}),
                   {.min = 2, .max = 2000},
                   "elements along the block (even), across its half width, in its depth", 3),
      controlling(reals_key("mesh.size", "mm", required(), positive_quantity,
                            "sizes of the elements at the origin, in the same order", 3),
                  ErrorSource::mesh, with_scaled_elements),
      reals_key(
          "mesh.fine", "mm", required(), non_negative,
          "distances from the origin up to which the elements have that size; beyond, they grow",
          3)};
  result.insert(result.end(), worn_body_keys(3).begin(), worn_body_keys(3).end());
  return result;
}

/// Grid lines of the mesh from the origin to `end` in direction `axis`, at distances that do not
/// decrease.
std::vector<double> grid_lines(const Scene& scene, int axis, double end) {
  const long elements = scene.integers("mesh.elements")[axis];
  const double size = scene.reals("mesh.size")[axis];
  constexpr const char* directions[] = {"along half of the block", "across its half width",
                                        "in its depth"};
  const auto refuse = [&](const std::string& why) {
    return InputError(fmt::format("{} with mesh.size and mesh.fine, {}: {}",
                                  scene.where("mesh.elements"), directions[axis], why));
  };
  std::vector<double> lines;
  try {
    lines = graded_grid_lines(size, scene.reals("mesh.fine")[axis], end,
                              static_cast<int>(axis == 0 ? elements / 2 : elements));
  } catch (const InputError& error) {
    throw refuse(error.what());
  }
  if (const std::size_t n = lines.size(); lines[n - 1] - lines[n - 2] < 0.999 * lines[1])
    throw refuse(fmt::format("expected elements that grow, {} of {:g} mm and more exceed {:g} mm",
                             n - 1, size, end));
  return lines;
}

/// With all displacements, of which some will be held.
MeshSize mesh_size(const Scene& scene) {
  double nodes = 1;
  for (const long elements : scene.integers("mesh.elements")) nodes *= double(elements + 1);
  return {.dim = 3, .nodes = nodes, .grid_lines = true, .displacements = 3 * nodes};
}

Extrusion make_block(const Scene& scene, const std::vector<double>& along) {
  const std::vector<double> y = grid_lines(scene, 1, scene.real("block.half_width"));
  const std::vector<double> depth = grid_lines(scene, 2, scene.real("block.depth"));
  const int ny = static_cast<int>(y.size()) - 1, nz = static_cast<int>(depth.size()) - 1;
  const Mesh<2> section = structured_quadrilaterals(ny, nz, [&](double s, double t) {
    return Vector<2>(y[std::lround(s * ny)], -depth[std::lround((1 - t) * nz)]);
  });
  return extrude(section, along);
}

/// The first node of each line along x carries the shape. The wear of a line is the mean over the
/// path.
CrossSection make_section(const Extrusion& block, double length, double path) {
  CrossSection section{block.section, std::vector<int>(block.section.nodes.size(), -1),
                       block.section_node, length, path};
  for (std::size_t node = 0; node < section.of.size(); ++node)
    if (int& carrier = section.node[section.of[node]]; carrier < 0)
      carrier = static_cast<int>(node);
  return section;
}

/// The base is held; the ends and the outer side are held or free, as the scene says.
NodalFlags<3> held_displacement(bool sides_held, const Mesh<3>& mesh) {
  NodalFlags<3> held = NodalFlags<3>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
  for (int node : mesh.boundary_nodes("left")) held(node, 1) = 1;
  for (int node : mesh.boundary_nodes("bottom")) held.row(node).setOnes();
  if (!sides_held) return held;
  for (const char* part : {"right", "begin", "end"})
    for (int node : mesh.boundary_nodes(part)) held.row(node).setOnes();
  return held;
}

/// On the base and the outer side, and along x.
NodalFlags<3> held_shape(const Mesh<3>& mesh) {
  NodalFlags<3> held = NodalFlags<3>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
  held.col(0).setOnes();
  for (const char* part : {"bottom", "right"})
    for (int node : mesh.boundary_nodes(part)) held.row(node).setOnes();
  for (int node : mesh.boundary_nodes("left")) held(node, 1) = 1;
  return held;
}

Scales make_scales(const Scene& scene, const WearLaw& wear) {
  const double R = scene.real("ball.radius"), force = scene.real("load.force");
  const HertzPoint hertz(force, R, scene.real("body.young_modulus"),
                         scene.real("body.poisson_ratio"));
  Scales scales;
  scales.duration = scene.real("time.end");
  const double hertz_pressure = force / (M_PI * hertz.radius * hertz.radius);
  const double groove = wear_by_pressure(scene, wear, hertz_pressure) * load_impulse(scene) /
                        scene.real("path.length");
  const double half_width = std::cbrt(1.5 * R * groove);  // of a rigid ball: 2 a^3/(3 R) = groove
  scales.force = force;
  scales.displacement = hertz.approach;
  scales.stress = force / (M_PI * hertz.radius * (hertz.radius + half_width));
  // Without friction there is no wear, by eq. (13).
  scales.wear_depth = groove > 0 ? depth_by_law(scene, wear, scales.stress,
                                                groove / (2 * std::max(half_width, hertz.radius)))
                                 : hertz.approach;
  scales.auxiliary_force = scales.wear_depth;
  return scales;
}

std::unique_ptr<Model> make(const Scene& scene) {
  if (scene.text("shape.constraint") == "multiplier")
    throw InputError(scene.where("shape.constraint") +
                     ": expected \"eliminated\": a groove has no multiplier form");
  if (const long along = scene.integers("mesh.elements")[0]; along % 2)
    throw InputError(fmt::format("{}: expected an even number of elements along the block, got {}",
                                 scene.where("mesh.elements"), along));
  const std::vector<double> half = grid_lines(scene, 0, scene.real("block.length") / 2);
  const std::vector<double> along = two_sided_grid_lines(half, half);
  const Extrusion block = make_block(scene, along);
  const Mesh<3>& mesh = block.mesh;
  const double radius = scene.real("ball.radius"), copies = 2;
  Interface<3> interface = read_interface(scene, mesh, mesh.boundary.at("top"));
  interface.partner.shape = ball<3>(Vector<3>(0, 0, radius), radius);
  interface.partner.approach = Vector<3>(0, 0, -1);
  interface.partner.guide();
  interface.streaming = Vector<3>(scene.real("wear.velocity"), 0, 0);
  interface.force = scene.real("load.force") / copies;
  interface.history = read_load_history(scene);
  const Scales scales = make_scales(scene, interface.surfaces.front().wear);
  return make_wear_model<3>(
      scene, scene.reals("mesh.size")[1],
      {.mesh = mesh,
       .bodies = {read_body(scene)},
       .supports = {.held = held_displacement(scene.text("block.sides") == "held", mesh)},
       .interface = std::move(interface),
       .shape = read_shape_motion(scene, held_shape(mesh)),
       .cross_section =
           make_section(block, along.back() - along.front(), scene.real("path.length")),
       .copies = copies,
       .scales = scales});
}

const Registration<Problem> registration({
    .name = "ball_on_half_space",
    .help =
        "3D rigid ball that wears a groove into a block streaming past, with friction (paper, sec. "
        "4.3)",
    .keys = keys(),
    .make = make,
    .mesh_size = mesh_size,
});

}  // namespace

}  // namespace gnomon
