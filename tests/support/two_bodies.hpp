// Two bodies made without a scene: blocks on each other, in the plane or of revolution. The upper
// one is the slave; its top is loaded, the bottom of the lower one is held, and so are the sides
// across, unless they are free.
#pragma once

#include <cmath>
#include <functional>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/assembly_scene.hpp>

namespace gnomon::testing {

struct BlockOfPair {
  int along = 4, high = 4;  ///< elements
  double from = 0, to = 2;  ///< mm, its sides
  double size = 2;          ///< mm, height
  double young_modulus = 1000, poisson_ratio = 0.3;
  double wear = 0;                                                     ///< 1/MPa, k
  std::function<double(double)> surface = [](double) { return 0.0; };  ///< height over x
  double grading = 1;  ///< exponent: elements are small near x = `from` and the surface
};

struct TwoBodies {
  BlockOfPair upper{}, lower{};
  double force = 20;  ///< N / mm, or N
  double speed = 1;   ///< mm / s, of the lower body, along x, of revolution across
  double friction = 0;
  double duration = 100;
  Kinematics kinematics = Kinematics::finite;
  Section section = Section::plane;
  NormalRule normal = NormalRule::conservative;
  bool sides_held = true;
};

inline Mesh<2> mesh_of(const TwoBodies& pair) {
  const auto made = [](const BlockOfPair& block, bool upper) {
    return structured_quadrilaterals(block.along, block.high, [=](double s, double t) {
      const double x = block.from + (block.to - block.from) * std::pow(s, block.grading);
      const double y = block.surface(x);
      if (upper) return Vector<2>(x, y + (block.size - y) * std::pow(t, block.grading));
      return Vector<2>(x, y - (block.size + y) * std::pow(1 - t, block.grading));
    });
  };
  Mesh<2> mesh = made(pair.upper, true);
  const Mesh<2> lower = made(pair.lower, false);
  const auto first = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), lower.nodes.begin(), lower.nodes.end());
  for (auto cell : lower.cells) {
    for (int& node : cell) node += first;
    mesh.cells.push_back(cell);
  }
  for (auto [name, facets] : lower.boundary) {
    for (auto& facet : facets)
      for (int& node : facet) node += first;
    mesh.boundary["lower " + name] = facets;
  }
  return mesh;
}

inline AssemblyParts<2> two_bodies(const TwoBodies& pair) {
  const Mesh<2> mesh = mesh_of(pair);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalFlags<2> held = pair.section == Section::meridian
                           ? held_on_axis(mesh)
                           : NodalFlags<2>(NodalFlags<2>::Zero(nodes, 2));
  NodalFlags<2> shape_held = held;
  for (const char* side : {"left", "right", "lower left", "lower right"})
    for (const int node : mesh.boundary_nodes(side)) {
      const bool right = std::string(side).find("right") != std::string::npos;
      if (pair.sides_held || !right) held(node, 0) = 1;
      shape_held(node, 0) = 1;
    }
  for (const int node : mesh.boundary_nodes("lower bottom")) held.row(node).setOnes();
  for (const char* far : {"top", "lower bottom"})
    for (const int node : mesh.boundary_nodes(far)) shape_held.row(node).setOnes();
  std::vector<Body> bodies;
  int cell = 0;
  for (const BlockOfPair* block : {&pair.upper, &pair.lower}) {
    Body body{
        .material = make_material("neo-hookean", ElasticModuli::from_young_poisson(
                                                     block->young_modulus, block->poisson_ratio)),
        .element = {ElementTechnology::plain, pair.kinematics, pair.section}};
    body.name = block == &pair.upper ? "upper" : "lower";
    for (int k = 0; k < block->along * block->high; ++k) body.cells.push_back(cell++);
    bodies.push_back(std::move(body));
  }
  const double width = pair.upper.to - pair.upper.from,
               area = pair.section == Section::meridian ? M_PI * width * width : width,
               young = std::min(pair.upper.young_modulus, pair.lower.young_modulus);
  Scales scales;
  scales.force = pair.force / pair.upper.along;
  scales.stress = pair.force / area;
  scales.displacement = scales.stress / young * pair.upper.size;
  scales.duration = pair.duration;
  scales.wear_depth = std::max(
      1e-9, (pair.upper.wear + pair.lower.wear) * pair.speed * scales.stress * scales.duration);
  if (pair.upper.wear + pair.lower.wear == 0) scales.wear_depth = scales.displacement;
  scales.auxiliary_force = scales.wear_depth;
  const auto surface = [&mesh](const char* name, double wear) {
    Surface<2> made{.name = name, .facets = mesh.boundary.at(name), .wear = archard(wear)};
    made.wears = wear > 0;
    return made;
  };
  const Load<2> load{.forces = uniform_load(mesh, "top", Vector<2>(0, -pair.force), pair.section),
                     .presses = true};
  AssemblyParts<2> parts{
      .mesh = mesh,
      .bodies = bodies,
      .supports = {.held = held},
      .loads = {load},
      .interface = {.surfaces = {surface("bottom", pair.upper.wear),
                                 surface("lower top", pair.lower.wear)},
                    .boundary = exterior_facets(mesh),
                    .normal_rule = pair.normal,
                    .friction = pair.friction,
                    .rho = 0.1 * young / (width / pair.upper.along),
                    .speed = pair.speed},
      .shape = {.held = shape_held,
                .law = {make_material("neo-hookean", ElasticModuli::from_young_poisson(1, 0.3))}},
      .scales = scales};
  MortarPair<2> contact{.slave = mesh.boundary.at("bottom"),
                        .master = mesh.boundary.at("lower top"),
                        .motion = {},
                        .friction = pair.friction,
                        .reach = pair.upper.size};
  if (pair.section == Section::meridian)
    contact.motion.across = pair.speed;
  else
    contact.motion.velocity = Vector<2>(pair.speed, 0);
  for (const auto& facet : contact.slave)
    for (const int node : facet)
      if (shape_held(node, 0)) contact.along[node] = Vector<2>(0, 1).asDiagonal();
  parts.pairs = {contact};
  return parts;
}

/// The upper body alone, on a rigid plane at y = 0.
inline AssemblyParts<2> upper_body(const TwoBodies& pair) {
  AssemblyParts<2> parts = two_bodies(pair);
  const Mesh<2> both = std::move(parts.mesh);
  const int nodes = (pair.upper.along + 1) * (pair.upper.high + 1);
  parts.mesh = {};
  parts.mesh.nodes.assign(both.nodes.begin(), both.nodes.begin() + nodes);
  parts.mesh.cells.assign(both.cells.begin(),
                          both.cells.begin() + pair.upper.along * pair.upper.high);
  for (const char* side : {"bottom", "top", "left", "right"})
    parts.mesh.boundary[side] = both.boundary.at(side);
  parts.bodies.pop_back();
  parts.pairs.clear();
  parts.interface.surfaces.pop_back();
  parts.interface.boundary = exterior_facets(parts.mesh);
  parts.interface.partner.motion.velocity = Vector<2>(pair.speed, 0);
  parts.supports.held.conservativeResize(nodes, 2);
  parts.shape.held.conservativeResize(nodes, 2);
  parts.loads.front().forces.conservativeResize(nodes, 2);
  return parts;
}

}  // namespace gnomon::testing
