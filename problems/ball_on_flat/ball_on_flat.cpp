// ball_on_flat: the paper's sec. 4.2. An elastic ball is pressed on a rigid flat that slides past
// with friction, and wears. The body is the half of the ball below its mid-plane, by symmetry a
// quarter.
//
// The mid-plane stays plane and does not move along the flat; a uniform normal displacement of it
// is conjugate to the prescribed force. Only the motion relative to the flat matters; therefore the
// mid-plane is at rest here and the flat moves up by w, one scalar unknown. The shape is an unknown
// only near the contact (Remark 2), within shape.reach of the pole.
//
// The ball touches the flat z = 0 at the origin; the flat moves along x, y = 0 is the plane of
// symmetry.

#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/hertz.hpp>
#include <gnomon/mesh/quarter_ball.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

std::vector<Key> keys() {
  std::vector<Key> result = {
      length_key("ball.radius", "radius R of the ball"),
      controlling_by_count(integers_key(
          "mesh.elements", by_default(std::vector<long>{20, 6, 9}), {.min = 1, .max = 500},
          "elements from the pole to the edge of the bottom patch, from there to the "
          "mid-plane, and from the core to the surface",
          3)),
      real_key("mesh.patch", "mm", by_default(2.5), positive_quantity,
               "arc from the pole to the edge of the bottom patch of equal elements"),
      real_key("contact.radius", "mm", by_default(3.0), positive_quantity,
               "distance from the axis up to which the ball may touch the flat"),
      real_key("shape.reach", "mm", by_default(4.0), positive_quantity,
               "distance from the pole up to which the shape is an unknown (Remark 2)")};
  result.insert(result.end(), worn_body_keys(3).begin(), worn_body_keys(3).end());
  return result;
}

QuarterBall read_ball(const Scene& scene) {
  const auto& elements = scene.integers("mesh.elements");
  return {.radius = scene.real("ball.radius"),
          .patch_half_width = scene.real("mesh.patch"),
          .contact_radius = scene.real("contact.radius"),
          .across = static_cast<int>(elements[0]),
          .height = static_cast<int>(elements[1]),
          .layers = static_cast<int>(elements[2])};
}

/// With all unknowns, of which some will be held.
MeshSize mesh_size(const Scene& scene) {
  const double nodes = read_ball(scene).nodes();
  return {.dim = 3,
          .nodes = nodes,
          .grid_lines = true,
          .displacements = 3 * nodes,
          .shapes = 3 * nodes};
}

/// The displacement is zero on the mid-plane, and normal to the plane of symmetry on that plane.
NodalFlags<3> held_displacement(const Mesh<3>& mesh) {
  NodalFlags<3> held = NodalFlags<3>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
  for (int node : mesh.boundary_nodes("top")) held.row(node).setOnes();
  for (int node : mesh.boundary_nodes("symmetry")) held(node, 1) = 1;
  return held;
}

/// The shape is zero beyond its reach and on the whole boundary except the contact surface and,
/// along it, the plane of symmetry.
NodalFlags<3> held_shape(double reach, const Mesh<3>& mesh) {
  NodalFlags<3> held = held_displacement(mesh);
  for (int node = 0; node < std::ssize(mesh.nodes); ++node)
    if (mesh.nodes[node].norm() > reach) held.row(node).setOnes();
  for (int node : mesh.boundary_nodes("free")) held.row(node).setOnes();
  return held;
}

Scales make_scales(const Scene& scene, const WearLaw& wear, double facet) {
  const double R = scene.real("ball.radius"), force = scene.real("load.force");
  const HertzPoint hertz(force, R, scene.real("body.young_modulus"),
                         scene.real("body.poisson_ratio"));
  Scales scales;
  scales.duration = scene.real("time.end");
  const double hertz_pressure = force / (M_PI * hertz.radius * hertz.radius);
  const double worn = wear_by_pressure(scene, wear, hertz_pressure) * load_impulse(scene);
  const double worn_area =
      std::sqrt(4 * R * worn * M_PI);  // pi a^2 of a rigid ball: pi a^4 = 4 R V
  scales.force = force;
  scales.displacement = hertz.approach;
  scales.stress = force / (M_PI * hertz.radius * hertz.radius + worn_area);
  // Without friction there is no wear, by eq. (13).
  scales.wear_depth =
      worn > 0 ? depth_by_law(scene, wear, scales.stress, worn / worn_area) : hertz.approach;
  scales.auxiliary_force = scales.wear_depth * facet;
  return scales;
}

std::unique_ptr<Model> make(const Scene& scene) {
  const QuarterBall ball = read_ball(scene);
  if (ball.patch_half_width >= ball.radius)
    throw InputError(fmt::format("{}: expected less than ball.radius = {:g} mm, got {:g}",
                                 scene.where("mesh.patch"), ball.radius, ball.patch_half_width));
  if (scene.real("shape.reach") < ball.contact_radius)
    throw InputError(fmt::format("{}: expected at least contact.radius = {:g} mm, got {:g}",
                                 scene.where("shape.reach"), ball.contact_radius,
                                 scene.real("shape.reach")));
  const Mesh<3> mesh = quarter_ball(ball);
  const double facet = ball.patch_half_width / ball.across, copies = 2;
  Interface<3> interface = read_interface(scene, mesh, mesh.boundary.at("contact"));
  interface.partner.motion.velocity = Vector<3>(scene.real("wear.velocity"), 0, 0);
  interface.partner.guide();
  interface.force = scene.real("load.force") / copies;
  interface.history = read_load_history(scene);
  const Scales scales = make_scales(scene, interface.surfaces.front().wear, facet);
  return make_wear_model<3>(
      scene, facet,
      {.mesh = mesh,
       .bodies = {read_body(scene)},
       .supports = {.held = held_displacement(mesh)},
       .interface = std::move(interface),
       .shape = read_shape_motion(scene, held_shape(scene.real("shape.reach"), mesh)),
       .copies = copies,
       .scales = scales});
}

const Registration<Problem> registration({
    .name = "ball_on_flat",
    .help = "3D elastic ball that wears on a sliding rigid flat, with friction (paper, sec. 4.2)",
    .keys = keys(),
    .make = make,
    .mesh_size = mesh_size,
});

}  // namespace

}  // namespace gnomon
