// pin_on_flat: the paper's two-dimensional example, sec. 4.1. A parabolic pin y >= x^2/(2R), plane
// strain, pressed on a rigid plane y = 0 that slides past; frictionless contact, wear rate k v
// |T_N|.
//
// Left and right sides are held laterally; a uniform traction acts on the top. The shape is held on
// the top, and its component normal to the sides is held on the sides; along the sides it is free,
// so that the end nodes of the contact surface wear like all others. (The paper does not define
// this; pin.sides = "held" holds both components.)

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/distortion.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

std::vector<Key> keys() {
  std::vector<Key> result = {
      controlling_by_count(integers_key("mesh.elements", by_default(std::vector<long>{40, 40}),
                                        {.min = 2, .max = 4000},
                                        "elements across and along the height of the pin", 2)),
      real_key(
          "mesh.distortion", "", by_default(0.0), {.min = 0, .max = 1},
          "largest displacement of the inner nodes, relative to the shortest edge at the node"),
      length_key("pin.radius", "radius of curvature R of the contact surface y = x^2/(2R)"),
      length_key("pin.width", "width L of the pin"),
      length_key("pin.height", "largest height H of the pin, at its centre line"),
      text_key(
          "pin.sides", by_default("sliding"),
          "shape of the left and right side: sliding along the side, so that the end nodes of the "
          "contact surface wear, or held",
          {"sliding", "held"})};
  result.insert(result.end(), worn_body_keys(2).begin(), worn_body_keys(2).end());
  return result;
}

void require_convex_elements(const Scene& scene, const Mesh<2>& mesh) {
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    if (scaled_jacobian<2>(mesh.positions(mesh.cells[cell])) <= 0)
      throw InputError(
          fmt::format("{}: expected less (values below 0.25 are safe), {:g} inverts element {}",
                      scene.where("mesh.distortion"), scene.real("mesh.distortion"), cell));
}

Mesh<2> make_mesh(const Scene& scene) {
  const double R = scene.real("pin.radius"), L = scene.real("pin.width");
  const double H = scene.real("pin.height");
  if (const double side = L * L / (8 * R); side >= H)
    throw InputError(fmt::format(
        "{}: expected more than L^2/(8R) = {:g} mm, so that the pin has sides, got {:g}",
        scene.where("pin.height"), side, H));
  const auto& elements = scene.integers("mesh.elements");
  Mesh<2> mesh = structured_quadrilaterals(
      static_cast<int>(elements[0]), static_cast<int>(elements[1]), [=](double s, double t) {
        const double x = (s - 0.5) * L, bottom = x * x / (2 * R);
        return Vector<2>(x, bottom + t * (H - bottom));
      });
  distort(mesh, scene.real("mesh.distortion"));
  require_convex_elements(scene, mesh);
  return mesh;
}

MeshSize mesh_size(const Scene& scene) {
  const auto& elements = scene.integers("mesh.elements");
  return {2, double(elements[0] + 1) * double(elements[1] + 1)};
}

/// With sliding sides the shape of their nodes follows the wear along the side, so that the corner
/// nodes wear too.
NodalFlags<2> held_shape(bool sliding_sides, const Mesh<2>& mesh) {
  NodalFlags<2> held = NodalFlags<2>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 2);
  for (const char* side : {"left", "right"})
    for (int node : mesh.boundary_nodes(side)) {
      held(node, 0) = 1;
      if (!sliding_sides) held(node, 1) = 1;
    }
  for (int node : mesh.boundary_nodes("top")) held.row(node).setOnes();
  return held;
}

Scales make_scales(const Scene& scene, const WearLaw& wear) {
  const double nu = scene.real("body.poisson_ratio"), force = scene.real("load.force");
  const double reduced_modulus = scene.real("body.young_modulus") / (1 - nu * nu);
  const double width = scene.real("pin.width");
  Scales scales;
  scales.force = force;
  scales.displacement = force / reduced_modulus;
  scales.stress = force / width;
  scales.duration = scene.real("time.end");
  const double k_v = wear_by_pressure(scene, wear, scales.stress);
  // Not more than the height, so that a run with more wear than that has a useful tolerance.
  scales.wear_depth =
      std::min(depth_by_law(scene, wear, scales.stress, k_v * load_impulse(scene) / width),
               scene.real("pin.height"));
  if (scales.wear_depth == 0) scales.wear_depth = scales.displacement;  // a law without wear
  scales.auxiliary_force = scales.wear_depth;
  return scales;
}

std::unique_ptr<Model> make(const Scene& scene) {
  const Mesh<2> mesh = make_mesh(scene);
  const auto& surface = mesh.boundary.at("bottom");
  Interface<2> interface = read_interface(scene, mesh, surface);
  interface.partner.motion.velocity = Vector<2>(scene.real("wear.velocity"), 0);
  const Scales scales = make_scales(scene, interface.surfaces.front().wear);
  return make_wear_model<2>(
      scene, scene.real("pin.width") / static_cast<double>(surface.size()),
      {.mesh = mesh,
       .bodies = {read_body(scene)},
       .supports = {.held = held_sides(mesh)},
       .loads = {read_load_on_top(scene, mesh)},
       .interface = std::move(interface),
       .shape = read_shape_motion(scene, held_shape(scene.text("pin.sides") == "sliding", mesh)),
       .scales = scales});
}

const Registration<Problem> registration({
    .name = "pin_on_flat",
    .help =
        "2D parabolic pin on a sliding rigid flat, plane strain, frictionless (paper, sec. 4.1)",
    .keys = keys(),
    .make = make,
    .mesh_size = mesh_size,
});

}  // namespace

}  // namespace gnomon
