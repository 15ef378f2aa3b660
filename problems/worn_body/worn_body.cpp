// worn_body: a part of one's own, from a mesh with named surfaces, against a rigid counter-body of
// any shape.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/model/worn_body_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <limits>
#include <map>

#include "conflicts.hpp"
#include "gross_sliding.hpp"
#include "groups.hpp"
#include "histories.hpp"
#include "keys.hpp"
#include "loads.hpp"
#include "magnitudes.hpp"
#include "model/stored_part.hpp"
#include "nominal_speed.hpp"
#include "phases.hpp"
#include "shape_support.hpp"
#include "supports.hpp"
#include "surface_laws.hpp"

namespace gnomon {

namespace {

using namespace part;

/// The file that a key names: beside the scene, unless its path is absolute.
std::filesystem::path file_of(const Scene& scene, const std::string& key) {
  return scene.path().parent_path() / scene.text(key);
}

ImportedMesh read_mesh(const Scene& scene) {
  const bool file = scene.has("mesh.file"), geometry = scene.has("mesh.geometry");
  if (file == geometry)
    throw InputError(
        file ? scene.where("mesh.geometry") +
                   ": expected either mesh.file or mesh.geometry, got both"
             : scene.path().string() +
                   ": section [mesh]: expected `file`, a mesh, or `geometry`, which Gmsh meshes");
  const std::string key = file ? "mesh.file" : "mesh.geometry";
  try {
    return read_mesh_file(file_of(scene, key), {.size = scene.real_if("mesh.size").value_or(0),
                                                .factor = scene.real("mesh.factor")});
  } catch (const InputError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

template <int dim>
using Facets = std::vector<typename Mesh<dim>::Facet>;

/// Facets of all wearing surfaces. Throws where two of them share one.
template <int dim>
Facets<dim> wearing_facets(const Scene& scene, const ImportedBody<dim>& part) {
  Facets<dim> facets;
  std::map<typename Mesh<dim>::Facet, std::string> surface_of;  // by sorted nodes
  for (const std::string& name : scene.texts("wear.on"))
    for (const auto& facet : group_facets(scene, "wear.on", name, part)) {
      auto sorted = facet;
      std::sort(sorted.begin(), sorted.end());
      const auto [first, is_new] = surface_of.try_emplace(sorted, name);
      if (is_new)
        facets.push_back(facet);
      else if (first->second != name)  // a name given twice is reported by find_conflicts()
        throw InputError(
            fmt::format("{}: expected groups that share no facet, but \"{}\" and \"{}\" do",
                        scene.where("wear.on"), first->second, name));
    }
  if (facets.empty())
    throw InputError(scene.where("wear.on") + ": expected one group of the mesh or more");
  return facets;
}

/// Where the scene gives no direction, the counter-body is met along the mean normal of the contact
/// surface.
template <int dim>
void choose_approach(const Scene& scene, WornBody<dim>& body) {
  Vector<dim> outward = Vector<dim>::Zero();
  for (const auto& patch : body.contact_nodes) outward += patch.initial_area * patch.initial_normal;
  Vector<dim>& approach = body.contact.counter_body.approach;
  if (!given(scene, "counter_body.press.direction") && outward.norm() > 0)
    approach = -outward.normalized();
}

/// How far the bodies are brought into each other where no force presses them.
template <int dim>
double given_overlap(const Scene& scene, const WornBody<dim>& body) {
  double most = 0;
  const auto take = [&](const LoadHistory& history, double value) {
    for (double t : history.times()) most = std::max(most, std::abs(value * history.factor(t)));
  };
  for (const PrescribedValues& held : body.prescribed_displacement)
    for (const auto& entry : held.entries) take(held.history, entry.value);
  for (const std::string& support : entries_of(scene, "support", support_keys(), {"on"}))
    if (given(scene, support + ".stiffness") && given(scene, support + ".value"))
      for (double value : scene.reals(support + ".value"))
        take(read_history(scene, support), value);
  if (body.contact.counter_body.travel) take(*body.contact.counter_body.travel, 1);
  return most;
}

/// Contact of a few nodes says little about pressures.
template <int dim>
void warn_of_coarse_contact(const Magnitudes& magnitudes, WornBody<dim>& body) {
  const double width = dim == 2 ? magnitudes.contact_nodes : std::sqrt(magnitudes.contact_nodes);
  if (width < 4)
    body.remarks.push_back(
        fmt::format("contact is about {:.0f} {} wide at the start: pressures there mean little "
                    "before it has grown; a finer mesh near the contact helps",
                    std::max(1.0, width), width < 1.5 ? "node" : "nodes"));
}

template <int dim>
void take_counter_body(const Scene& scene, WornBody<dim>& body) {
  const PressedCounterBody<dim> other = read_counter_body<dim>(scene, body.element.section);
  body.contact.counter_body = other.body;
  body.counter_force = other.force;
  if (other.force) body.load_history = read_load_history(scene, "counter_body.press");
  choose_approach(scene, body);
}

/// The body, or all mistakes that can be found without solving anything.
template <int dim>
std::shared_ptr<WornBody<dim>> make_body(Scene scene, const ImportedBody<dim>& part) {
  auto body = std::make_shared<WornBody<dim>>();
  body->mesh = part.mesh;
  body->parts = stored_parts(part);
  body->remarks = part.remarks;
  Mistakes mistakes;
  find_unknown_groups(scene, part, mistakes);
  find_conflicts(scene, mistakes);
  Facets<dim> wearing;
  if (dim == 2) body->element.section = section_of(scene);
  const bool wears = mistakes.collect([&] {
    wearing = wearing_facets(scene, part);
    body->contact_nodes =
        contact_patches<dim>(body->mesh, wearing, part.exterior, body->element.section);
  });
  std::optional<PartCycle<dim>> cycle;
  const bool presses = mistakes.collect([&] {
    take_counter_body(scene, *body);
    cycle = read_part_cycle(scene, *body);
  });
  if (wears && presses)
    mistakes.collect([&] {
      scene = with_speed(scene, cycle, *body);
      if (cycle) make_phases(scene, *cycle, *body);
    });
  if (!scene.has("wear.velocity")) scene = scene.with("wear.velocity", 1.0);  // after a mistake
  mistakes.collect([&] { read_supports(scene, part, *body); });
  Vector<dim> load = Vector<dim>::Zero();
  mistakes.collect([&] { load = read_loads(scene, part, *body); });
  if (wears) mistakes.collect([&] { require_free_contact(scene, part, *body); });
  if (wears) mistakes.collect([&] { read_wear_laws(scene, part, *body); });
  mistakes.require_none();
  double most_load = body->cycle.empty() ? 1 : 0;
  for (const Phase<dim>& phase : body->cycle) most_load = std::max(most_load, phase.load);
  const double force = body->counter_force.value_or(
      most_load * std::abs(load.dot(body->contact.counter_body.approach)));
  const double overlap = given_overlap(scene, *body);
  if (force == 0 && overlap == 0)
    throw InputError(scene.path().string() +
                     ": expected something that presses the bodies on each other: "
                     "counter_body.press.force or .approach, a [[load]] against the counter-body, "
                     "or a [[support]] with value");
  const Magnitudes magnitudes = find_magnitudes(
      scene, force, overlap, force * body->load_history.integral(scene.real("time.end")), *body);
  body->scales = magnitudes.scales;
  if (cycle) require_gross_sliding(scene, *cycle, *body);
  body->shape_fixed = NodalFlags<dim>::Zero(body->displacement_fixed.rows(), dim);
  if constexpr (dim == 2)
    if (body->element.section == Section::meridian) hold_on_axis(*body);
  const double reach = read_shape_support(scene, part, wearing, magnitudes.deepest, *body);
  if (std::isfinite(reach))
    body->remarks.push_back(fmt::format(
        "the mesh moves within {:.3g} mm of the wearing surfaces (shape.reach)", reach));
  warn_of_coarse_contact(magnitudes, *body);
  remark_on_loads(scene, *body);
  remark_on_speeds(scene, cycle, *body);
  read_worn_body(scene, magnitudes.facet, *body);
  require_surface_laws(scene, *body);
  require_moving_shape(scene, *body);
  require_held(scene, part, *body);
  return body;
}

template <int dim>
std::unique_ptr<Model> make_part(const Scene& scene, const ImportedBody<dim>& part) {
  const auto with = [&](long phases) { return make_body<dim>(with_phases(scene, phases), part); };
  return std::make_unique<WearModel<dim>>(
      chooses_phases(scene) ? with_chosen_phases<dim>(scene, with) : make_body<dim>(scene, part));
}

template <int dim>
std::unique_ptr<Model> make_from_file(const Scene& scene, ImportedMesh mesh) {
  return make_part<dim>(scene, check_mesh<dim>(std::move(mesh), scene.texts("wear.on")));
}

/// 2 or 3 by the numbers of the counter-body's vectors; 0 if it has none.
std::size_t dimension_of(const Scene& scene) {
  for (const char* key : {"counter_body.press.direction", "counter_body.motion.velocity",
                          "counter_body.center", "counter_body.point"})
    if (given(scene, key)) return scene.reals(key).size();
  return 0;
}

/// The mistakes that can be found without the mesh.
void find_mistakes_without_mesh(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  find_mistakes_of_supports(scene, mistakes);
  find_mistakes_of_loads(scene, mistakes);
  const std::size_t dim = dimension_of(scene);
  if (dim == 2) mistakes.collect([&] { read_counter_body<2>(scene, section_of(scene)); });
  if (dim == 3) mistakes.collect([&] { read_counter_body<3>(scene, Section::plane); });
}

std::unique_ptr<Model> make(const Scene& scene) {
  ImportedMesh mesh;
  Mistakes mistakes;
  if (!mistakes.collect([&] { mesh = read_mesh(scene); }))
    find_mistakes_without_mesh(scene, mistakes);
  mistakes.require_none();
  return mesh.dimension == 2 ? make_from_file<2>(scene, std::move(mesh))
                             : make_from_file<3>(scene, std::move(mesh));
}

std::unique_ptr<Model> remake(const Scene& scene, const Grid& grid) {
  if (grid.cell == Grid::Cell::quadrilateral)
    return make_part<2>(scene, part_of_grid<2>(grid, scene.path().string()));
  return make_part<3>(scene, part_of_grid<3>(grid, scene.path().string()));
}

/// Where keys are mistaken, names of groups can be looked up all the same.
void find_mistakes_of_groups(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  mistakes.collect([&] {
    ImportedMesh mesh = read_mesh(scene);
    if (mesh.dimension == 2)
      find_unknown_groups(scene, check_mesh<2>(std::move(mesh)), mistakes);
    else
      find_unknown_groups(scene, check_mesh<3>(std::move(mesh)), mistakes);
  });
}

const Registration<Problem> registration({
    .name = "worn_body",
    .help = "a part from a mesh with named surfaces (Gmsh), against a rigid counter-body",
    .keys = part_keys(),
    .make = make,
    .remake = remake,
    .registered_keys = [] { return counter_body_keys(); },
    .further_mistakes = find_mistakes_of_groups,
});

}  // namespace

}  // namespace gnomon
