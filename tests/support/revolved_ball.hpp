// An axisymmetric body made without a scene: the lower part of a ball, pressed on a plane that
// turns about its axis. Load on the top.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <gnomon/model/worn_body_scene.hpp>
#include <memory>

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

inline std::shared_ptr<WornBody<2>> revolved_ball(const RevolvedBall& ball) {
  auto body = std::make_shared<WornBody<2>>();
  body->mesh = revolved_mesh(ball);
  const Mesh<2>& mesh = body->mesh;
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  body->displacement_fixed = body->shape_fixed = NodalFlags<2>::Zero(nodes, 2);
  hold_on_axis(*body);
  for (int node : mesh.boundary_nodes("right")) body->shape_fixed(node, 0) = 1;
  for (int node : mesh.boundary_nodes("top")) body->shape_fixed.row(node).setOnes();
  body->load = uniform_load(mesh, "top", Vector<2>(0, -ball.force), Section::meridian);
  body->contact_nodes = contact_patches<2>(mesh, mesh.boundary.at("bottom"), exterior_facets(mesh),
                                           Section::meridian);
  for (auto& patch : body->contact_nodes) patch.shape_free = body->shape_free(patch.node);
  body->material = make_material(
      "neo-hookean", ElasticModuli::from_young_poisson(ball.young_modulus, ball.poisson_ratio));
  body->mesh_motion.material =
      make_material("neo-hookean", ElasticModuli::from_young_poisson(1, 0.3));
  body->element = ball.element;
  Scales& scales = body->scales;
  scales.force = ball.force / ball.along;
  scales.displacement = ball.force / (ball.young_modulus * ball.size);
  scales.stress = ball.force / (M_PI * ball.size * ball.size);
  scales.duration = ball.duration;
  const double speed = ball.slide + ball.spin * ball.size;
  scales.wear_depth = ball.wear * speed * scales.stress * scales.duration;
  scales.auxiliary_force = scales.wear_depth;
  body->contact.wear = archard(ball.wear);
  body->contact.normal_rule = ball.normal;
  body->contact.counter_body.motion.across_by_x = Vector<2>(ball.spin, 0);
  body->contact.counter_body.motion.across = ball.slide;
  const double facet = ball.size / ball.along;
  body->contact.rho = 0.01 * regularization_unit(ball.young_modulus, facet, scales);
  return body;
}

}  // namespace gnomon::testing
