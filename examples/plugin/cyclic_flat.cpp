// A problem: an elastic flat, clamped at its bottom and loaded by a pressure on its sides, that a
// cylinder wears, which moves to and fro. The part is plain data, AssemblyParts: all of it could as
// well come from arrays of another program.

#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/part/assembly_scene.hpp>

namespace {

using namespace gnomon;

constexpr double width = 0.8, height = 0.4, radius = 6;  // mm

std::vector<Key> keys() {
  std::vector<Key> keys = {{.name = "flat.pressure",
                            .unit = "MPa",
                            .range = {.min = 0, .max = 1e6},
                            .help = "on the sides of the flat"}};
  for (const auto& more :
       {worn_body_keys(2), cycle_keys()})  // bodies, wear laws, friction; [cycle]
    keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

/// The cylinder above the flat, free to come down under its force.
CounterBody<2> cylinder() {
  CounterBody<2> cylinder;
  cylinder.shape = ball<2>({0, radius}, radius);
  cylinder.approach = {0, -1};
  cylinder.motion.normal = cylinder.approach;  // where it touches, at the origin
  cylinder.guide();
  return cylinder;
}

std::unique_ptr<Model> make(const Scene& scene) {
  const Mesh<2> mesh = structured_quadrilaterals(
      24, 6, [](double s, double t) { return Vector<2>((s - 0.5) * width, (t - 1) * height); });
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalFlags<2> held = NodalFlags<2>::Zero(nodes, 2), shape_held = held_sides(mesh);
  for (const int node : mesh.boundary_nodes("bottom")) {
    held.row(node).setOnes();
    shape_held.row(node).setOnes();
  }
  AssemblyParts<2> parts{.mesh = mesh,
                         .bodies = {read_body(scene)},
                         .supports = {.held = held},
                         .interface = read_interface(scene, mesh, mesh.boundary.at("top")),
                         .shape = read_shape_motion<2>(scene, shape_held)};
  for (const char* side : {"left", "right"})
    parts.loads.push_back(
        {.facets = mesh.boundary.at(side), .pressure = scene.real("flat.pressure")});
  parts.interface.partner = cylinder();
  parts.interface.force = scene.real("load.force");
  parts.interface.speed = scene.real("wear.velocity");  // of s, in laws that read it
  if (const std::optional<Cycle> cycle = read_cycle(scene)) {
    // |v| has corners where the motion reverses.
    parts.cycle = CyclicContact<2>{{*cycle, {}}, read_cycle_quadrature(scene, {0.25, 0.75})};
    parts.phases = phases_of(*parts.cycle, parts.interface.partner, parts.interface.force);
  }
  const Magnitudes magnitudes = magnitudes_of(parts, scene.real("time.end"));
  parts.scales = magnitudes.scales;
  return make_wear_model<2>(scene, magnitudes.facet, std::move(parts));
}

const Registration<Problem> registration(
    {.name = "cyclic_flat",
     .help = "an elastic flat that a cylinder wears, which moves to and fro",
     .keys = keys(),
     .make = make});

}  // namespace
