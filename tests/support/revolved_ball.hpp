// An axisymmetric body made without a scene: the lower part of a ball, pressed on a plane that
// turns about its axis. Load on the top.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/assembly_scene.hpp>

namespace gnomon::testing {

struct RevolvedBall {
  int along = 8, high = 8;     ///< elements along r and z
  double radius = 5;           ///< mm, of the ball; infinite: a cylinder with a flat end
  double size = 2;             ///< mm, outer radius and height
  double grading = 1;          ///< exponent: elements are small near the pole
  double young_modulus = 640;  ///< MPa
  double poisson_ratio = 0.3;
  double force = 20;       ///< N
  double wear = 1e-4;      ///< 1/MPa, k
  double spin = 1;         ///< rad/s, of the plane
  double slide = 0;        ///< mm/s, to the circumference, the same at all radii
  double duration = 1000;  ///< s
  NormalRule normal = NormalRule::conservative;
  Element element{.section = Section::meridian};
};

inline Mesh<2> revolved_mesh(const RevolvedBall& ball) {
  return structured_quadrilaterals(ball.along, ball.high, [&](double s, double t) {
    const double r = ball.size * std::pow(s, ball.grading), slope = r / ball.radius;
    const double bottom = ball.radius * slope * slope / (1 + std::sqrt(1 - slope * slope));
    const double low = std::isfinite(bottom) ? bottom : 0;
    return Vector<2>(r, low + (ball.size - low) * std::pow(t, ball.grading));
  });
}

inline AssemblyParts<2> revolved_ball(const RevolvedBall& ball) {
  const Mesh<2> mesh = revolved_mesh(ball);
  NodalFlags<2> shape_held = held_on_axis(mesh);
  for (int node : mesh.boundary_nodes("right")) shape_held(node, 0) = 1;
  for (int node : mesh.boundary_nodes("top")) shape_held.row(node).setOnes();
  const Load<2> load{
      .forces = uniform_load(mesh, "top", Vector<2>(0, -ball.force), Section::meridian),
      .presses = true};
  Scales scales;
  scales.force = ball.force / ball.along;
  scales.displacement = ball.force / (ball.young_modulus * ball.size);
  scales.stress = ball.force / (M_PI * ball.size * ball.size);
  scales.duration = ball.duration;
  const double speed = ball.slide + ball.spin * ball.size;
  scales.wear_depth = ball.wear * speed * scales.stress * scales.duration;
  scales.auxiliary_force = scales.wear_depth;
  const double facet = ball.size / ball.along;
  AssemblyParts<2> parts{
      .mesh = mesh,
      .bodies = {{.material = make_material(
                      "neo-hookean",
                      ElasticModuli::from_young_poisson(ball.young_modulus, ball.poisson_ratio)),
                  .element = ball.element}},
      .supports = {.held = held_on_axis(mesh)},
      .loads = {load},
      .interface = {.surfaces = {{"bottom", mesh.boundary.at("bottom"), archard(ball.wear)}},
                    .boundary = exterior_facets(mesh),
                    .normal_rule = ball.normal,
                    .rho = 0.01 * regularization_unit(ball.young_modulus, facet, scales)},
      .shape = {.held = shape_held,
                .law = {make_material("neo-hookean", ElasticModuli::from_young_poisson(1, 0.3))}},
      .scales = scales};
  parts.interface.partner.motion.across_by_x = Vector<2>(ball.spin, 0);
  parts.interface.partner.motion.across = ball.slide;
  return parts;
}

}  // namespace gnomon::testing
