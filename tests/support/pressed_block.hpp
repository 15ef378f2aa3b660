// A three-dimensional body made without a scene: a block whose bottom is a paraboloid, pressed on a
// plane that slides past, without friction. Quarter symmetry, load on the top.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <memory>

namespace gnomon::testing {

struct PressedBlock {
  int across = 8, high = 8;    ///< elements along each side and along the height
  double radius = 5;           ///< mm
  double size = 2;             ///< mm, of side and height
  double young_modulus = 640;  ///< MPa
  double poisson_ratio = 0.3;
  double force = 20;       ///< N
  double wear = 1e-4;      ///< mm/(MPa s), k v
  double duration = 1000;  ///< s
  Element element{};
};

inline Mesh<3> block_mesh(const PressedBlock& block) {
  const int n = block.across, m = block.high;
  Mesh<3> mesh;
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  for (int k = 0; k <= m; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double x = block.size * i / n, y = block.size * j / n;
        const double bottom = (x * x + y * y) / (2 * block.radius);
        mesh.nodes.push_back(Vector<3>(x, y, bottom + (block.size - bottom) * k / m));
      }
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        mesh.cells.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                              node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                              node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      mesh.boundary["bottom"].push_back(
          {node(i, j, 0), node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0)});
  return mesh;
}

inline AssemblyParts<3> pressed_block(const PressedBlock& block) {
  const Mesh<3> mesh = block_mesh(block);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalFlags<3> held = NodalFlags<3>::Zero(nodes, 3), shape_held = held;
  Field::Values forces = Field::Values::Zero(nodes, 3);
  const int n = block.across;
  for (Eigen::Index node = 0; node < nodes; ++node) {
    const Eigen::Index i = node % (n + 1), j = node / (n + 1) % (n + 1);
    const bool top = node / ((n + 1) * (n + 1)) == block.high;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Index along = axis == 0 ? i : j;
      if (along == 0) held(node, axis) = 1;
      if (along == 0 || along == n) shape_held(node, axis) = 1;
    }
    if (!top) continue;
    shape_held.row(node).setOnes();
    const double edge = (i == 0 || i == n ? 0.5 : 1) * (j == 0 || j == n ? 0.5 : 1);
    forces(node, 2) = -block.force * edge / (n * n);
  }
  const double area = block.size * block.size;
  const Load<3> load{.forces = forces, .presses = true};
  Scales scales;
  scales.force = block.force / (n * n);
  scales.displacement = block.force / (block.young_modulus * block.size);
  scales.stress = block.force / area;
  scales.duration = block.duration;
  scales.wear_depth = block.wear * scales.stress * scales.duration;
  scales.auxiliary_force = scales.wear_depth * block.size;
  AssemblyParts<3> parts{
      .mesh = mesh,
      .bodies = {{.material = make_material(
                      "neo-hookean",
                      ElasticModuli::from_young_poisson(block.young_modulus, block.poisson_ratio)),
                  .element = block.element}},
      .supports = {.held = held},
      .loads = {load},
      .interface = {.surfaces = {{"bottom", mesh.boundary.at("bottom"), archard(block.wear)}},
                    .rho = 0.01 * regularization_unit(block.young_modulus, block.size / n, scales)},
      .shape = {.held = shape_held,
                .law = {make_material("neo-hookean", ElasticModuli::from_young_poisson(1, 0.3))}},
      .scales = scales};
  parts.interface.partner.motion.velocity = Vector<3>::Unit(0);
  return parts;
}

}  // namespace gnomon::testing
