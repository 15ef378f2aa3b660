// Two bodies made without a scene: blocks on each other, in the plane, of revolution or in space.
// The upper one is the slave if nothing else is said; its top is loaded, the bottom of the lower
// one is held, and so are the sides across them.
#pragma once

#include <cmath>
#include <functional>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/assembly_scene.hpp>

#include "support/structured_hexahedra.hpp"

namespace gnomon::testing {

struct BlockOfPair {
  int along = 4, high = 4;  ///< elements
  int across = 3;           ///< elements along y, in space
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
  double thick = 1;   ///< mm, along y, in space
  double speed = 1;   ///< mm / s, of the lower body, along x, of revolution across
  double friction = 0;
  double duration = 100;
  Kinematics kinematics = Kinematics::finite;
  Section section = Section::plane;
  NormalRule normal = NormalRule::conservative;
  bool lower_is_slave = false;
};

/// A place of a block, from coordinates in the unit square; `upper`: the surface is its bottom.
inline Vector<2> place_in(const BlockOfPair& block, bool upper, double s, double t) {
  const double x = block.from + (block.to - block.from) * std::pow(s, block.grading);
  const double y = block.surface(x);
  if (upper) return {x, y + (block.size - y) * std::pow(t, block.grading)};
  return {x, y - (block.size + y) * std::pow(1 - t, block.grading)};
}

template <int dim>
Mesh<dim> block_of(const TwoBodies& pair, bool upper) {
  const BlockOfPair& block = upper ? pair.upper : pair.lower;
  if constexpr (dim == 2) {
    return structured_quadrilaterals(
        block.along, block.high, [&](double s, double t) { return place_in(block, upper, s, t); });
  } else {
    return structured_hexahedra(block.along, block.across, block.high,
                                [&](double r, double s, double t) {
                                  const Vector<2> place = place_in(block, upper, r, t);
                                  return Vector<3>(place[0], pair.thick * s, place[1]);
                                });
  }
}

/// Boundary parts of the lower block have "lower" before their names.
template <int dim>
Mesh<dim> mesh_of(const TwoBodies& pair) {
  Mesh<dim> mesh = block_of<dim>(pair, true);
  const Mesh<dim> lower = block_of<dim>(pair, false);
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

/// Where displacements and shapes are held.
template <int dim>
struct HeldInPair {
  NodalFlags<dim> displacement, shape;

  HeldInPair(const TwoBodies& pair, const Mesh<dim>& mesh) {
    displacement = NodalFlags<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
    if constexpr (dim == 2)
      if (pair.section == Section::meridian) displacement = held_on_axis(mesh);
    shape = displacement;
    const auto hold = [&](const std::string& side, int i) {
      for (const std::string& body : {std::string(), std::string("lower ")})
        for (const int node : mesh.boundary_nodes(body + side))
          displacement(node, i) = shape(node, i) = 1;
    };
    hold("left", 0), hold("right", 0);
    if (dim == 3) hold("front", 1), hold("back", 1);
    for (const int node : mesh.boundary_nodes("lower bottom")) displacement.row(node).setOnes();
    for (const char* far : {"top", "lower bottom"})
      for (const int node : mesh.boundary_nodes(far)) shape.row(node).setOnes();
  }
};

inline std::vector<Body> bodies_of(const TwoBodies& pair, std::size_t upper, std::size_t cells) {
  std::vector<Body> bodies;
  for (const BlockOfPair* block : {&pair.upper, &pair.lower}) {
    Body body{
        .material = make_material("neo-hookean", ElasticModuli::from_young_poisson(
                                                     block->young_modulus, block->poisson_ratio)),
        .element = {ElementTechnology::plain, pair.kinematics, pair.section}};
    body.name = block == &pair.upper ? "upper" : "lower";
    const std::size_t from = block == &pair.upper ? 0 : upper;
    for (std::size_t cell = from; cell < (block == &pair.upper ? upper : cells); ++cell)
      body.cells.push_back(static_cast<int>(cell));
    bodies.push_back(std::move(body));
  }
  return bodies;
}

inline Scales scales_of(const TwoBodies& pair, double area) {
  Scales scales;
  scales.force = pair.force / pair.upper.along;
  scales.stress = pair.force / area;
  scales.displacement = scales.stress /
                        std::min(pair.upper.young_modulus, pair.lower.young_modulus) *
                        pair.upper.size;
  scales.duration = pair.duration;
  const double wear = pair.upper.wear + pair.lower.wear;
  scales.wear_depth =
      wear > 0 ? wear * pair.speed * scales.stress * scales.duration : scales.displacement;
  scales.auxiliary_force = scales.wear_depth;
  return scales;
}

template <int dim>
MortarPair<dim> contact_of(const TwoBodies& pair, const Mesh<dim>& mesh,
                           const NodalFlags<dim>& held) {
  MortarPair<dim> contact{.slave = mesh.boundary.at("bottom"),
                          .master = mesh.boundary.at("lower top"),
                          .friction = pair.friction,
                          .reach = pair.upper.size,
                          .numbers = {0, 1}};
  contact.boundary = {contact.slave, contact.master};
  if (dim == 2 && pair.section == Section::meridian)
    contact.motion.across = pair.speed;
  else
    contact.motion.velocity = pair.speed * Vector<dim>::Unit(0);
  if (pair.lower_is_slave) {
    std::swap(contact.slave, contact.master);
    std::swap(contact.boundary[0], contact.boundary[1]);
    std::swap(contact.numbers[0], contact.numbers[1]);
    contact.motion.velocity *= -1;
    contact.approach *= -1;
  }
  for (const auto& facet : contact.slave)
    for (const int node : facet)
      if (held.row(node).maxCoeff() != 0)
        contact.along[node] =
            (1 - held.row(node).template cast<double>().array()).matrix().asDiagonal();
  return contact;
}

template <int dim>
AssemblyParts<dim> two_bodies(const TwoBodies& pair) {
  const Mesh<dim> mesh = mesh_of<dim>(pair);
  const HeldInPair<dim> held(pair, mesh);
  const std::size_t upper = block_of<dim>(pair, true).cells.size();
  const double width = pair.upper.to - pair.upper.from, area = pair.section == Section::meridian
                                                                   ? M_PI * width * width
                                                               : dim == 3 ? width * pair.thick
                                                                          : width;
  const Scales scales = scales_of(pair, area);
  const auto surface = [&mesh](const char* name, double wear) {
    Surface<dim> made{.name = name, .facets = mesh.boundary.at(name), .wear = archard(wear)};
    made.wears = wear > 0;
    return made;
  };
  const Load<dim> load{
      .forces = surface_load<dim>(mesh, mesh.boundary.at("top"),
                                  Vector<dim>(-pair.force * Vector<dim>::Unit(dim - 1)), true,
                                  pair.section),
      .presses = true};
  AssemblyParts<dim> parts{
      .mesh = mesh,
      .bodies = bodies_of(pair, upper, mesh.cells.size()),
      .supports = {.held = held.displacement},
      .loads = {load},
      .interface = {.surfaces = {surface("bottom", pair.upper.wear),
                                 surface("lower top", pair.lower.wear)},
                    .boundary = exterior_facets(mesh),
                    .normal_rule = pair.normal,
                    .friction = pair.friction,
                    .rho = 0.1 * pair.upper.young_modulus / (width / pair.upper.along),
                    .speed = pair.speed},
      .shape = {.held = held.shape,
                .law = {make_material("neo-hookean", ElasticModuli::from_young_poisson(1, 0.3))}},
      .scales = scales};
  parts.pairs = {contact_of(pair, mesh, held.displacement)};
  return parts;
}

/// The upper body alone, on a rigid plane at y = 0.
inline AssemblyParts<2> upper_body(const TwoBodies& pair) {
  AssemblyParts<2> parts = two_bodies<2>(pair);
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
