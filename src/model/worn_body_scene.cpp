#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/same_time.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <gnomon/model/added_term.hpp>
#include <gnomon/model/worn_body_scene.hpp>
#include <gnomon/terms/material_law.hpp>

namespace gnomon {

namespace {

using Preconditioner = LinearSolverChoice::Preconditioner;

/// For a plane body factors are always inexpensive; in space, above some size, they cost more time
/// and far more memory than multigrid, which takes fewer iterations along grid lines than without
/// (docs/linear.md).
Preconditioner preconditioner_by_size(const MeshSize& mesh) {
  const double many_displacements = mesh.grid_lines ? 100'000 : 300'000;
  return mesh.dim == 3 && mesh.dim * mesh.nodes >= many_displacements && has_multigrid()
             ? Preconditioner::multigrid
             : Preconditioner::factor;
}

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

template <int dim>
MeshSize size_of(const WornBody<dim>& body) {
  MeshSize size{.dim = dim,
                .nodes = double(body.mesh.nodes.size()),
                .phases = std::max(1.0, double(body.cycle.size()))};
  if (dim == 2) return size;
  size.grid_lines = !semi_coarsening(body.mesh).empty();
  size.displacements = double((body.displacement_fixed.array() == 0).count());
  if (!body.section) size.shapes = double((body.shape_fixed.array() == 0).count());
  return size;
}

/// Factors are analysed only where they are used.
template <int dim>
void choose_solver(const Scene& scene, WornBody<dim>& body) {
  MeshSize size = size_of(body);
  body.solver = linear_solver_of(scene, size);
  if (dim == 3 && body.solver.uses_factors()) {
    size.displacement_factor = factor_entries_of<dim>(body.mesh, body.displacement_fixed);
    if (size.shapes > 0) size.shape_factor = factor_entries_of<dim>(body.mesh, body.shape_fixed);
  }
  body.memory = estimated_memory(size, body.solver);
  require_memory(scene, size, body.solver);
}

}  // namespace

template <int dim>
WearCircumstances wear_circumstances(const WornBody<dim>& body) {
  WearCircumstances at{body.scales.stress, body.contact.friction, body.scales.wear_depth, {}};
  for (const ContactPatch<dim>& patch : body.contact_nodes) {
    std::array<double, 3>& position = at.initial.emplace_back();
    std::copy(patch.initial_position.begin(), patch.initial_position.end(), position.begin());
  }
  return at;
}

template <int dim>
void read_worn_body(const Scene& scene, double facet, WornBody<dim>& body) {
  const double young = scene.real("body.young_modulus");
  const double shape_young = scene.real("shape.young_modulus");
  body.material = read_material(scene, "body.material");
  body.mesh_motion = {read_material(scene, "shape.energy"), scene.real("shape.stiffening")};
  body.scales.auxiliary_force *= body.mesh_motion.material.collapse_force;
  body.element.technology = technology_of(scene.text("body.element"));
  body.element.kinematics =
      scene.text("body.kinematics") == "small" ? Kinematics::small : Kinematics::finite;
  body.contact.friction = scene.real("friction.coefficient");
  require_law(scene, body.contact.wear, wear_circumstances(body));
  choose_solver(scene, body);
  body.contact.rho =
      scene.real("contact.regularization") * regularization_unit(young, facet, body.scales);
  const std::string& normal = scene.text("wear.normal");
  body.contact.normal_rule = normal == "averaged"     ? NormalRule::averaged
                             : normal == "normalised" ? NormalRule::normalised
                                                      : NormalRule::conservative;
  for (ContactPatch<dim>& patch : body.contact_nodes)
    patch.shape_free = body.shape_free(patch.node);
  body.constraint = scene.text("shape.constraint") == "eliminated" ? ConstraintForm::eliminated
                                                                   : ConstraintForm::multiplier;
  CounterBody<dim>& counter_body = body.contact.counter_body;
  const Vector<dim> apart = scene.real("contact.initial_gap") * counter_body.approach;
  counter_body.position -= apart;
  for (Phase<dim>& phase : body.cycle) phase.counter_body.position -= apart;
  if (scene.knows("load.times")) body.load_history = read_load_history(scene);
  for (auto& term : added_terms<dim>(scene)) body.added_terms.push_back(std::move(term));
  body.augmentation = scene.real("shape.augmentation") * shape_young / facet * body.scales.duration;
}

template <int dim>
std::vector<ContactPatch<dim>> read_contact_patches(
    const Scene& scene, const Mesh<dim>& mesh,
    const std::vector<typename Mesh<dim>::Facet>& surface, Section section) {
  std::vector<typename Mesh<dim>::Facet> boundary;
  if (scene.text("wear.normal") == "conservative")
    for (const auto& [name, part] : mesh.boundary)
      boundary.insert(boundary.end(), part.begin(), part.end());
  return contact_patches<dim>(mesh, surface, boundary, section);
}

void hold_on_axis(WornBody<2>& body) {
  for (int node : axis_nodes(body.mesh)) {
    body.displacement_fixed(node, 0) = 1;
    body.shape_fixed(node, 0) = 1;
  }
}

LoadHistory read_load_history(const Scene& scene, const std::string& prefix) {
  const std::string times_key = prefix + ".times", factors_key = prefix + ".factors";
  if (!scene.has(times_key) && !scene.has(factors_key)) return {};
  const double shortest = shortest_ramp * scene.real("time.end");
  const std::vector<double>& times = scene.reals(times_key);
  const std::vector<double>& factors = scene.reals(factors_key);
  if (times.size() != factors.size())
    throw InputError(fmt::format("{}: expected as many as {}, {}, got {}", scene.where(factors_key),
                                 times_key, times.size(), factors.size()));
  if (times.empty()) return {};
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] - times[k - 1] >= 0.999 * shortest))
      throw InputError(
          fmt::format("{}: expected ascending times, at least {:g} of time.end = {:g} s apart, got "
                      "{} after {}",
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

void require_memory(const Scene& scene, const MeshSize& mesh, const LinearSolverChoice& solver) {
  if (const std::string missing = missing_memory_text(mesh, solver, available_memory());
      !missing.empty())
    throw InputError(fmt::format("{}: its mesh needs {}", scene.path().string(), missing));
}

LinearSolverChoice linear_solver_of(const Scene& scene, const MeshSize& mesh) {
  const bool direct = scene.has("solver.method") && scene.text("solver.method") == "direct";
  Preconditioner preconditioner = preconditioner_by_size(mesh);
  if (scene.has("solver.preconditioner"))
    preconditioner = scene.text("solver.preconditioner") == "factor" ? Preconditioner::factor
                                                                     : Preconditioner::multigrid;
  return {direct ? LinearSolverChoice::Method::direct : LinearSolverChoice::Method::block,
          preconditioner, mesh.dim == 2};
}

NodalField<2> uniform_load(const Mesh<2>& mesh, const std::string& part, const Vector<2>& resultant,
                           Section section) {
  NodalField<2> load = NodalField<2>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 2);
  double total = 0;
  if (section == Section::meridian) {
    for (const auto& patch : contact_patches<2>(mesh, mesh.boundary.at(part), {}, section)) {
      total += patch.initial_area;
      load.row(patch.node) = patch.initial_area * resultant.transpose();
    }
    return load / total;
  }
  for (const auto& facet : mesh.boundary.at(part)) {
    const double length = (mesh.nodes[facet[1]] - mesh.nodes[facet[0]]).norm();
    total += length;
    for (int node : facet) load.row(node) += length / 2 * resultant.transpose();
  }
  return load / total;
}

template <int dim>
NodalField<dim> volume_load(const Mesh<dim>& mesh, const Vector<dim>& density, Section section) {
  const auto& basis = CellBasis<dim>::instance();
  NodalField<dim> load = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  for (const auto& cell : mesh.cells) {
    const CellNodal<dim> X = mesh.positions(cell);
    for (int g = 0; g < CellBasis<dim>::points; ++g) {
      const auto& N = basis.gauss_values[g];
      double volume = (X.transpose() * basis.gauss[g]).determinant();
      if (section == Section::meridian) volume *= 2 * M_PI * N.dot(X.col(0));
      for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
        load.row(cell[a]) += volume * N[a] * density.transpose();
    }
  }
  return load;
}

template NodalField<2> volume_load(const Mesh<2>&, const Vector<2>&, Section);
template NodalField<3> volume_load(const Mesh<3>&, const Vector<3>&, Section);
template std::vector<ContactPatch<2>> read_contact_patches(const Scene&, const Mesh<2>&,
                                                           const std::vector<Mesh<2>::Facet>&,
                                                           Section);
template std::vector<ContactPatch<3>> read_contact_patches(const Scene&, const Mesh<3>&,
                                                           const std::vector<Mesh<3>::Facet>&,
                                                           Section);
template WearCircumstances wear_circumstances(const WornBody<2>&);
template WearCircumstances wear_circumstances(const WornBody<3>&);
template void read_worn_body(const Scene&, double, WornBody<2>&);
template void read_worn_body(const Scene&, double, WornBody<3>&);

}  // namespace gnomon
