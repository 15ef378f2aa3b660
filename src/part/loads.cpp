#include "part/loads.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/pair_keys.hpp"

namespace gnomon::part {

std::vector<Key> load_keys() {
  return {
      text_key("load.#.on", absent("the whole body, for an acceleration"),
               "group of the mesh that the load acts on"),
      reals_key("load.#.force", "N/mm in plane strain, else N", absent("none"), any_quantity,
                "resultant, distributed evenly over the initial area; its direction stays"),
      reals_key("load.#.traction", "MPa", absent("none"), any_quantity,
                "force by initial area; its direction stays"),
      real_key("load.#.moment", "N in plane strain, else N mm", absent("none"), any_quantity,
               "without a resultant, by forces that grow linearly from the centroid of the initial "
               "area; in the plane from x to y; its direction stays"),
      reals_key("load.#.axis", "", absent("none"), {},
                "in space: direction of the axis of the moment, of any length"),
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

/// Forces along w x r by area, r from the centroid: with the moment M about the axis, and without a
/// resultant. `about`: the rotation by one about the axis.
template <int dim>
NodalField<dim> moment_load(const Mesh<dim>& mesh, const Facets<dim>& facets,
                            const Tensor<dim>& about, double M, Section section) {
  const auto patches = contact_patches<dim>(mesh, facets, {}, section);
  double area = 0;
  Vector<dim> centre = Vector<dim>::Zero();
  for (const auto& patch : patches) {
    area += patch.initial_area;
    centre += patch.initial_area * patch.initial_position;
  }
  centre /= area;
  Tensor<dim> second = Tensor<dim>::Zero();  // moments of area
  for (const auto& patch : patches) {
    const Vector<dim> r = patch.initial_position - centre;
    second += patch.initial_area * r * r.transpose();
  }
  const double polar = second.trace();
  Tensor<dim> turn;
  if constexpr (dim == 2) {
    turn = M / polar * about;
  } else {
    const Vector<3> axis(about(2, 1), about(0, 2), about(1, 0));
    const Vector<3> w = (polar * Tensor<3>::Identity() - second).ldlt().solve(M * axis);
    turn << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  }
  NodalField<dim> forces = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  for (const auto& patch : patches)
    forces.row(patch.node) =
        (patch.initial_area * turn * (patch.initial_position - centre)).transpose();
  return forces;
}

/// Throws where the axis of a moment is missing, or belongs to none.
template <int dim>
void check_axis(const Scene& scene, const std::string& load, bool moment) {
  const bool axis = scene.given(load + ".axis");
  if (axis && (!moment || dim == 2))
    refuse(scene, load + ".axis",
           "none" + (moment ? " in the plane" : " without " + load + ".moment"));
  if (moment && dim == 3 && !axis) refuse(scene, load + ".moment", "also " + load + ".axis");
  if (moment && section_of(scene) == Section::meridian)
    refuse(scene, load + ".moment", "none in an axisymmetric scene");
}

/// The key of the load that is given. Throws unless it is one.
std::string kind_of(const Scene& scene, const std::string& load) {
  std::string kind;
  for (const char* name : {"force", "moment", "traction", "pressure", "acceleration"}) {
    if (!scene.given(load + "." + name)) continue;
    if (!kind.empty())
      throw InputError(fmt::format("{}: expected one kind of load, got also {}",
                                   scene.where(load + "." + name), kind));
    kind = name;
  }
  if (kind.empty())
    throw InputError(
        fmt::format("{}: {}: expected one of force, moment, traction, pressure and acceleration",
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
  check_axis<dim>(scene, load, kind == "moment");
  if (scene.given(on)) result.facets = group_facets(scene, on, scene.text(on), part);
  if (kind == "pressure") {
    result.pressure = scene.real(key);
    return result;
  }
  if (kind == "moment") {
    const Tensor<dim> about = rotation_spin<dim>(scene, 1, key, load + ".axis");
    result.forces = moment_load<dim>(part.mesh, result.facets, about, scene.real(key), section);
    return result;
  }
  const Vector<dim> vector = read_point<dim>(scene, key);
  if (kind == "acceleration")
    for (const Body& body : bodies)
      if (body.density == 0)
        refuse(scene, key,
               "also body.density" + (body.name.empty() ? "" : " of \"" + body.name + "\""));
  if (kind == "acceleration") {
    result.forces = weight<dim>(part.mesh, bodies, vector, section);
    for (const Body& body : bodies)
      result.weight = std::max(result.weight, body.density * vector.norm());
  } else
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
std::vector<Load<dim>> read_swinging_loads(const Scene& scene, const ImportedBody<dim>& part,
                                           const std::vector<Body>& bodies) {
  std::vector<Load<dim>> loads;
  const std::vector<std::string> tables = tables_of_loads(scene, true);
  const std::vector<CycleFunction> factors = factors_of_loads(scene);
  for (std::size_t k = 0; k < tables.size(); ++k) {
    loads.push_back(read_load(scene, tables[k], part, bodies));
    loads.back().swing = factors[k];
  }
  return loads;
}

std::vector<CycleFunction> factors_of_loads(const Scene& scene) {
  std::vector<CycleFunction> factors;
  for (const std::string& load : tables_of_loads(scene, true)) {
    const std::string key = load + ".cycle";
    if (!may_stick(scene))
      refuse(scene, key,
             "friction.stick = true, or stick of [[pair]], beside it; cycle.load changes all loads "
             "that press");
    if (!scene.given("cycle.period")) refuse(scene, key, "also cycle.period");
    factors.push_back(*read_cycle_function(scene, key));
  }
  return factors;
}

template std::vector<Load<2>> read_swinging_loads(const Scene&, const ImportedBody<2>&,
                                                  const std::vector<Body>&);
template std::vector<Load<3>> read_swinging_loads(const Scene&, const ImportedBody<3>&,
                                                  const std::vector<Body>&);
template std::vector<Load<2>> read_loads(const Scene&, const ImportedBody<2>&,
                                         const std::vector<Body>&);
template std::vector<Load<3>> read_loads(const Scene&, const ImportedBody<3>&,
                                         const std::vector<Body>&);

}  // namespace gnomon::part
