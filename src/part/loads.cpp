#include "part/loads.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/pairs.hpp"

namespace gnomon::part {

std::vector<Key> load_keys() {
  return {
      text_key("load.#.on", absent("the whole body, for an acceleration"),
               "group of the mesh that the load acts on"),
      reals_key("load.#.force", "N/mm in plane strain, else N", absent("none"), any_quantity,
                "resultant, distributed evenly over the initial area; its direction stays"),
      reals_key("load.#.traction", "MPa", absent("none"), any_quantity,
                "force by initial area; its direction stays"),
      real_key("load.#.pressure", "MPa", absent("none"), any_quantity,
               "pressure, positive pushes on the body; follows the deformed surface"),
      reals_key("load.#.acceleration", "mm/s^2", absent("none"), any_quantity,
                "for example of gravity; needs body.density"),
      cycle_function_key("load.#.cycle", "",
                         "factor of the load over the cycle, an expression in tau or a file of "
                         "points (.csv), beside other loads that press; needs stick"),
      times_key("load.#", "the load"),
      factors_key("load.#", "the load"),
  };
}

namespace {

template <int dim>
NodalField<dim> weight(const Mesh<dim>& mesh, const std::vector<Body>& bodies,
                       const Vector<dim>& acceleration, Section section) {
  NodalField<dim> sum = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  for (const Body& body : bodies)
    sum += volume_load<dim>(mesh, Vector<dim>(body.density * acceleration), section,
                            body.cells.empty() ? nullptr : &body.cells);
  return sum;
}

/// The key of the load that is given. Throws unless it is one.
std::string kind_of(const Scene& scene, const std::string& load) {
  std::string kind;
  for (const char* name : {"force", "traction", "pressure", "acceleration"}) {
    if (!scene.given(load + "." + name)) continue;
    if (!kind.empty())
      throw InputError(fmt::format("{}: expected one kind of load, got also {}",
                                   scene.where(load + "." + name), kind));
    kind = name;
  }
  if (kind.empty())
    throw InputError(
        fmt::format("{}: {}: expected one of force, traction, pressure and acceleration",
                    scene.path().string(), load));
  if ((kind == "acceleration") == scene.given(load + ".on"))
    throw InputError(kind == "acceleration"
                         ? scene.where(load + ".on") +
                               ": expected none, for an acceleration acts on the whole body"
                         : fmt::format("{}: expected also `on`, the group that it acts on",
                                       scene.where(load + "." + kind)));
  return kind;
}

template <int dim>
Load<dim> read_load(const Scene& scene, const std::string& load, const ImportedBody<dim>& part,
                    const std::vector<Body>& bodies) {
  const std::string kind = kind_of(scene, load), key = load + "." + kind, on = load + ".on";
  Load<dim> result{.history = read_history(scene, load)};
  const Section section = section_of(scene);
  if (scene.given(on)) result.facets = group_facets(scene, on, scene.text(on), part);
  if (kind == "pressure") {
    result.pressure = scene.real(key);
    return result;
  }
  const Vector<dim> vector = read_point<dim>(scene, key);
  if (kind == "acceleration")
    for (const Body& body : bodies)
      if (body.density == 0)
        throw InputError(scene.where(key) + ": expected also body.density" +
                         (body.name.empty() ? "" : " of \"" + body.name + "\""));
  if (kind == "acceleration")
    result.forces = weight<dim>(part.mesh, bodies, vector, section);
  else
    result.forces = surface_load<dim>(part.mesh, result.facets, vector, kind == "force", section);
  return result;
}

/// Names of the tables with a factor of their own over the cycle, or of those without.
std::vector<std::string> tables_of_loads(const Scene& scene, bool swinging) {
  std::vector<std::string> tables;
  for (const std::string& load : entries_of(scene, "load", load_keys(), {}))
    if (scene.given(load + ".cycle") == swinging) tables.push_back(load);
  return tables;
}

}  // namespace

void find_mistakes_of_loads(const Scene& scene, Mistakes& mistakes) {
  mistakes.collect([&] {
    for (const std::string& load : entries_of(scene, "load", load_keys(), {})) {
      mistakes.collect([&] { kind_of(scene, load); });
      mistakes.collect([&] { read_history(scene, load); });
    }
  });
}

template <int dim>
std::vector<Load<dim>> read_loads(const Scene& scene, const ImportedBody<dim>& part,
                                  const std::vector<Body>& bodies) {
  std::vector<Load<dim>> loads;
  Mistakes mistakes;
  for (const std::string& load : tables_of_loads(scene, false))
    mistakes.collect([&] { loads.push_back(read_load(scene, load, part, bodies)); });
  mistakes.require_none();
  return loads;
}

template <int dim>
std::vector<SwingingLoad<dim>> read_swinging_loads(const Scene& scene,
                                                   const ImportedBody<dim>& part,
                                                   const std::vector<Body>& bodies) {
  std::vector<SwingingLoad<dim>> loads;
  const std::vector<std::string> tables = tables_of_loads(scene, true);
  const std::vector<CycleFunction> factors = factors_of_loads(scene);
  for (std::size_t k = 0; k < tables.size(); ++k)
    loads.push_back({read_load(scene, tables[k], part, bodies), factors[k]});
  return loads;
}

std::vector<CycleFunction> factors_of_loads(const Scene& scene) {
  std::vector<CycleFunction> factors;
  for (const std::string& load : tables_of_loads(scene, true)) {
    const std::string key = load + ".cycle";
    if (!may_stick(scene))
      throw InputError(scene.where(key) +
                       ": expected friction.stick = true, or stick of [[pair]], beside it; "
                       "cycle.load changes all loads that press");
    if (!scene.given("cycle.period"))
      throw InputError(scene.where(key) + ": expected also cycle.period");
    factors.push_back(*read_cycle_function(scene, key));
  }
  return factors;
}

template std::vector<SwingingLoad<2>> read_swinging_loads(const Scene&, const ImportedBody<2>&,
                                                          const std::vector<Body>&);
template std::vector<SwingingLoad<3>> read_swinging_loads(const Scene&, const ImportedBody<3>&,
                                                          const std::vector<Body>&);
template std::vector<Load<2>> read_loads(const Scene&, const ImportedBody<2>&,
                                         const std::vector<Body>&);
template std::vector<Load<3>> read_loads(const Scene&, const ImportedBody<3>&,
                                         const std::vector<Body>&);

}  // namespace gnomon::part
