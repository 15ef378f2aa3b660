#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/same_time.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <gnomon/model/gap_motion.hpp>
#include <gnomon/model/memory_estimate.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/terms/material_law.hpp>
#include <map>

#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

/// Equations are solved to 1e-11 of load.force.
constexpr double least_load_factor = 1e-6;
/// Part of the time of the run: the change of the shape in a step has to be larger than rounding
/// errors.
constexpr double shortest_ramp = 1e-4;

/// Times of the load that differ only by rounding from an output time, or from the end, are
/// replaced by it.
std::vector<double> on_landings(std::vector<double> times, const Scene& scene) {
  std::vector<double> landings = scene.reals("output.times");
  landings.push_back(scene.real("time.end"));
  const double interval = scene.real_if("output.interval").value_or(0);
  for (double& time : times)
    if (interval > 0 && same_time(time, std::round(time / interval) * interval))
      time = std::round(time / interval) * interval;
  for (double& time : times)
    for (const double landing : landings)
      if (same_time(time, landing)) time = landing;
  return times;
}

/// Entries of the factors of a stiffness with the unknowns of the nodes that are not held.
template <int dim>
double factor_entries_of(const Mesh<dim>& mesh, const NodalFlags<dim>& held) {
  std::vector<int> number(mesh.nodes.size(), -1), numbers;
  int count = 0;
  for (Eigen::Index node = 0; node < held.rows(); ++node)
    if (held.row(node).minCoeff() == 0) number[node] = count++;
  PatternBuilder nodes(count);
  for (const auto& cell : mesh.cells) {
    numbers.clear();
    for (int node : cell) numbers.push_back(number[node]);
    nodes.add(numbers, numbers);
  }
  return dim * dim * factor_entries(nodes.build());
}

/// Valid while the parts are.
template <int dim>
MeshSize size_of(const AssemblyParts<dim>& parts) {
  MeshSize size{.dim = dim,
                .nodes = double(parts.mesh.nodes.size()),
                .phases = std::max(1.0, double(parts.phases.size()))};
  if (dim == 2) return size;
  size.grid_lines = !semi_coarsening(parts.mesh).empty();
  size.displacements = double((parts.supports.held.array() == 0).count());
  size.displacement_factor = [&] {
    return factor_entries_of<dim>(parts.mesh, parts.supports.held);
  };
  if (parts.cross_section) return size;
  size.shapes = double((parts.shape.held.array() == 0).count());
  size.shape_factor = [&] { return factor_entries_of<dim>(parts.mesh, parts.shape.held); };
  return size;
}

template <int dim>
ShapeMotion<dim> read_gap_motion(const Scene& scene, const AssemblyParts<dim>& parts) try {
  return gap_motion(parts);
} catch (const InputError& error) {
  throw InputError(scene.path().string() + ": " + error.what());
}

/// Whether the elasticity is condensed. Where the scene does not say so: where the condensed
/// matrix, which is full, has fewer entries than the stiffness; in the plane four times as many,
/// where factors of the stiffness fill in.
template <int dim>
bool read_condensed(const Scene& scene, const AssemblyParts<dim>& parts) {
  const std::string reason = varying_stiffness(parts);
  if (scene.has("solver.reduce")) {
    const bool condensed = scene.flag("solver.reduce");
    if (condensed && !reason.empty())
      throw InputError(scene.where("solver.reduce") + ": expected " + reason);
    return condensed;
  }
  const std::vector<int> connected = connected_parts(parts.mesh);
  std::map<int, double> rows;  // by connected part
  for (const int node : nodes_of_facets(facets_of(parts.interface.surfaces)))
    rows[connected[static_cast<std::size_t>(node)]] += dim;
  double entries = 0;
  for (const auto& [part, count] : rows) entries += count * count;
  const double row_of_stiffness = dim * std::pow(3, dim), fill = dim == 2 ? 4 : 1;  // entries
  return reason.empty() &&
         entries < fill * row_of_stiffness * dim * static_cast<double>(parts.mesh.nodes.size());
}

template <int dim>
void choose_solver(const Scene& scene, AssemblyParts<dim>& parts) {
  const MeshSize size = size_of(parts);
  parts.solver = linear_solver_kind(scene).make(scene, size);
  parts.memory = required_memory(scene, size);
}

}  // namespace

Body read_body(const Scene& scene, Section section, const std::string& table) {
  const auto given = [&](const std::string& key) { return scene.given(table + key); };
  Body body{.material = read_material(scene, table + ".material"), .element = {.section = section}};
  if (given(".element")) body.element.technology = technology_of(scene.text(table + ".element"));
  if (given(".material") && scene.text(table + ".material") == "linear")
    body.element.kinematics = Kinematics::small;
  if (given(".density")) body.density = scene.real(table + ".density");
  return body;
}

NormalRule read_normal_rule(const Scene& scene) {
  const std::string& normal = scene.text("wear.normal");
  return normal == "averaged"     ? NormalRule::averaged
         : normal == "normalised" ? NormalRule::normalised
                                  : NormalRule::conservative;
}

template <int dim>
Interface<dim> read_interface(const Scene& scene, const Mesh<dim>& mesh,
                              std::vector<typename Mesh<dim>::Facet> surface) {
  Interface<dim> interface {
    .surfaces = {{"", std::move(surface), read_wear_law(scene)}},
    .normal_rule = read_normal_rule(scene), .friction = scene.real("friction.coefficient")
  };
  if (interface.normal_rule == NormalRule::conservative)
    for (const auto& [name, part] : mesh.boundary)
      interface.boundary.insert(interface.boundary.end(), part.begin(), part.end());
  return interface;
}

template <int dim>
ShapeMotion<dim> read_shape_motion(const Scene& scene, NodalFlags<dim> held,
                                   NodalProjectors<dim> along) {
  return {.held = std::move(held),
          .along = std::move(along),
          .law = {read_material(scene, "shape.energy"), scene.real("shape.stiffening")},
          .constraint = scene.text("shape.constraint") == "eliminated"
                            ? ConstraintForm::eliminated
                            : ConstraintForm::multiplier};
}

template <int dim>
AssemblyParts<dim> completed(const Scene& scene, double facet, AssemblyParts<dim> parts) {
  Interface<dim>& interface = parts.interface;
  double young = parts.bodies.front().material.young_modulus;
  for (const Body& body : parts.bodies) young = std::min(young, body.material.young_modulus);
  const Scales& scales = parts.scales;
  interface.rho = scene.real("contact.regularization") * regularization_unit(young, facet, scales);
  const Vector<dim> apart = scene.real("contact.initial_gap") * interface.partner.approach;
  interface.partner.position -= apart;
  for (Phase<dim>& phase : parts.phases) phase.counter_body.position -= apart;
  if (scene.text("shape.motion") == "gap") {
    parts.following = parts.shape;
    parts.shape = read_gap_motion(scene, parts);
  }
  parts.condensed = read_condensed(scene, parts);
  choose_solver(scene, parts);
  return parts;
}

template <int dim>
std::unique_ptr<Model> make_wear_model(const Scene& scene, double facet, AssemblyParts<dim> parts) {
  WearLaw& law = parts.interface.surfaces.front().wear;
  law = required_law(scene, law, wear_circumstances(parts), parts.remarks);
  return std::make_unique<WearModel<dim>>(completed(scene, facet, std::move(parts)));
}

template <int dim>
WearCircumstances wear_circumstances(const AssemblyParts<dim>& parts) {
  double friction = parts.pairs.empty() ? parts.interface.friction : 0;
  for (const MortarPair<dim>& pair : parts.pairs) friction = std::max(friction, pair.friction);
  WearCircumstances at{.pressure = parts.scales.stress,
                       .friction = friction,
                       .speed = parts.nominal_speed(),
                       .duration = parts.scales.duration,
                       .initial = {},
                       .depth = parts.scales.wear_depth,
                       .rolls = parts.interface.rolling.has_value()};
  for (const ContactPatch<dim>& patch : contact_nodes_of(parts)) {
    std::array<double, 3>& position = at.initial.emplace_back();
    std::copy(patch.initial_position.begin(), patch.initial_position.end(), position.begin());
  }
  return at;
}

LoadHistory read_load_history(const Scene& scene, const std::string& prefix) {
  const std::string times_key = prefix + ".times", factors_key = prefix + ".factors";
  if (!scene.knows(times_key) || (!scene.has(times_key) && !scene.has(factors_key))) return {};
  const double shortest = shortest_ramp * scene.real("time.end");
  const std::vector<double>& times = scene.reals(times_key);
  const std::vector<double>& factors = scene.reals(factors_key);
  if (times.size() != factors.size())
    throw InputError(fmt::format("{}: expected as many as {}, {}, got {}", scene.where(factors_key),
                                 times_key, times.size(), factors.size()));
  if (times.empty()) return {};
  const std::size_t misplaced = LoadHistory::first_misplaced(times);
  for (std::size_t k = 1; k < times.size(); ++k)
    if (k == misplaced ||
        (times[k] > times[k - 1] && !(times[k] - times[k - 1] >= 0.999 * shortest)))
      throw InputError(
          fmt::format("{}: expected ascending times, at least {:g} of time.end = {:g} s apart, or "
                      "one twice for a jump, got {} after {}",
                      scene.where(times_key), shortest_ramp, shortest, times[k], times[k - 1]));
  for (const double factor : factors)
    if (!(factor >= least_load_factor))
      throw InputError(fmt::format(
          "{}: expected {:g} or more, got {:g}: only a force keeps the bodies together, and "
          "without it their distance is not determined",
          scene.where(factors_key), least_load_factor, factor));
  return {on_landings(times, scene), factors};
}

double load_impulse(const Scene& scene) {
  return scene.real("load.force") * read_load_history(scene).integral(scene.real("time.end"));
}

NodalFlags<2> held_sides(const Mesh<2>& mesh) {
  NodalFlags<2> held = NodalFlags<2>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 2);
  for (const char* side : {"left", "right"})
    for (int node : mesh.boundary_nodes(side)) held(node, 0) = 1;
  return held;
}

Load<2> read_load_on_top(const Scene& scene, const Mesh<2>& mesh) {
  return {.forces = uniform_load(mesh, "top", Vector<2>(0, -scene.real("load.force"))),
          .history = read_load_history(scene),
          .presses = true};
}

template <int dim>
NodalField<dim> surface_load(const Mesh<dim>& mesh,
                             const std::vector<typename Mesh<dim>::Facet>& facets,
                             const Vector<dim>& load, bool is_resultant, Section section) {
  NodalField<dim> forces = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  double area = 0;
  for (const auto& patch : contact_patches<dim>(mesh, facets, {}, section)) {
    area += patch.initial_area;
    forces.row(patch.node) = patch.initial_area * load.transpose();
  }
  return is_resultant ? NodalField<dim>(forces / area) : forces;
}

NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part, const Vector<2>& resultant,
                           Section section) {
  return surface_load<2>(mesh, mesh.boundary.at(part), resultant, true, section);
}

template <int dim>
NodalField<dim> volume_load(const Mesh<dim>& mesh, const Vector<dim>& density, Section section,
                            const std::vector<int>* cells) {
  const auto& basis = CellBasis<dim>::instance();
  NodalField<dim> load = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  const auto add = [&](const typename Mesh<dim>::Cell& cell) {
    const CellNodal<dim> X = mesh.positions(cell);
    for (int g = 0; g < CellBasis<dim>::points; ++g) {
      const auto& N = basis.gauss_values[g];
      double volume = (X.transpose() * basis.gauss[g]).determinant();
      if (section == Section::meridian) volume *= 2 * M_PI * N.dot(X.col(0));
      for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
        load.row(cell[a]) += volume * N[a] * density.transpose();
    }
  };
  if (cells)
    for (const int cell : *cells) add(mesh.cells[static_cast<std::size_t>(cell)]);
  else
    for (const auto& cell : mesh.cells) add(cell);
  return load;
}

template NodalField<2> surface_load(const Mesh<2>&, const std::vector<Mesh<2>::Facet>&,
                                    const Vector<2>&, bool, Section);
template NodalField<3> surface_load(const Mesh<3>&, const std::vector<Mesh<3>::Facet>&,
                                    const Vector<3>&, bool, Section);
template NodalField<2> volume_load(const Mesh<2>&, const Vector<2>&, Section,
                                   const std::vector<int>*);
template NodalField<3> volume_load(const Mesh<3>&, const Vector<3>&, Section,
                                   const std::vector<int>*);
template Interface<2> read_interface(const Scene&, const Mesh<2>&, std::vector<Mesh<2>::Facet>);
template Interface<3> read_interface(const Scene&, const Mesh<3>&, std::vector<Mesh<3>::Facet>);
template ShapeMotion<2> read_shape_motion(const Scene&, NodalFlags<2>, NodalProjectors<2>);
template ShapeMotion<3> read_shape_motion(const Scene&, NodalFlags<3>, NodalProjectors<3>);
template std::unique_ptr<Model> make_wear_model(const Scene&, double, AssemblyParts<2>);
template std::unique_ptr<Model> make_wear_model(const Scene&, double, AssemblyParts<3>);
template AssemblyParts<2> completed(const Scene&, double, AssemblyParts<2>);
template AssemblyParts<3> completed(const Scene&, double, AssemblyParts<3>);
template WearCircumstances wear_circumstances(const AssemblyParts<2>&);
template WearCircumstances wear_circumstances(const AssemblyParts<3>&);

}  // namespace gnomon
