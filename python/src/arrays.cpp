// A part whose mesh is given by arrays, with named groups to which its scene refers.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/part/part_scene.hpp>
#include <map>
#include <span>

#include "bindings.hpp"

namespace gnomon::python {

namespace {

using Groups = std::map<std::string, py::object>;

struct Rows {
  std::vector<int> values;
  std::size_t columns = 1;
};

/// The numbers at which an array of `end` booleans is true.
Rows rows_of_mask(const py::array& given, std::size_t end, const std::string& what) {
  const auto mask = py::array_t<bool, py::array::c_style>::ensure(given);
  if (mask.ndim() != 1 || static_cast<std::size_t>(mask.size()) != end)
    throw InputError(fmt::format("{}: expected numbers, or {} booleans", what, end));
  Rows rows;
  for (std::size_t k = 0; k < end; ++k)
    if (mask.data()[k]) rows.values.push_back(static_cast<int>(k));
  return rows;
}

/// An array of whole numbers from 0 to `end` - 1, or a mask where it has one dimension.
Rows rows_of(const py::object& given, int dimensions, std::size_t end, const std::string& what) {
  const auto as_given = py::array::ensure(given);  // numpy would round the numbers of a list
  const char kind = as_given ? as_given.dtype().kind() : ' ';
  if (kind == 'b' && dimensions == 1) return rows_of_mask(as_given, end, what);
  using Whole = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
  const bool whole = kind == 'i' || kind == 'u';
  const auto array = whole ? Whole::ensure(as_given) : py::reinterpret_steal<Whole>(py::handle());
  if (!as_given) PyErr_Clear();
  if (!array || array.ndim() != dimensions)
    throw InputError(what + ": expected whole numbers in " +
                     (dimensions == 1 ? "one dimension" : "two dimensions"));
  Rows rows;
  if (dimensions == 2) rows.columns = static_cast<std::size_t>(array.shape(1));
  for (const std::int64_t number :
       std::span(array.data(), static_cast<std::size_t>(array.size()))) {
    if (number < 0 || number >= static_cast<std::int64_t>(end))
      throw InputError(what + ": expected numbers from 0 to " + std::to_string(end - 1) + ", got " +
                       std::to_string(number));
    rows.values.push_back(static_cast<int>(number));
  }
  return rows;
}

/// Adds elements of this dimension; what they are follows from the number of their corners.
/// Messages number them as the array does.
void add_elements(const Rows& rows, int dimension, const std::string& what, ElementList& list) {
  for (int k = 0; k < element_kinds; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    if (dimension_of(kind) != dimension || node_count(kind) != static_cast<int>(rows.columns))
      continue;
    for (std::size_t at = 0; at < rows.values.size(); at += rows.columns)
      list.add(kind, static_cast<std::int64_t>(at / rows.columns),
               std::span(rows.values).subspan(at, rows.columns));
    return;
  }
  throw InputError(what + ": no element of " + std::to_string(dimension) + " dimensions has " +
                   std::to_string(rows.columns) + " corners");
}

void set_nodes(const py::object& given, ImportedMesh& mesh) {
  const Reals points = real_numbers(given);
  if (!points || points.ndim() != 2 || points.shape(0) == 0 ||
      (points.shape(1) != 2 && points.shape(1) != 3))
    throw InputError("points: expected numbers in rows of two, in the plane, or three");
  // Other programs give points of a plane a third coordinate.
  bool flat = true;
  if (points.shape(1) == 3)
    for (py::ssize_t row = 0; row < points.shape(0); ++row)
      flat = flat && *points.data(row, 2) == 0;
  mesh.dimension = flat ? 2 : 3;
  for (py::ssize_t row = 0; row < points.shape(0); ++row) {
    std::copy_n(points.data(row, 0), mesh.dimension, mesh.nodes.emplace_back().begin());
    mesh.node_tags.push_back(row);
  }
}

ImportedMesh mesh_of(const py::object& points, const py::object& cells, const Groups& facets,
                     const Groups& nodes, const Groups& bodies) {
  ImportedMesh mesh;
  mesh.file = "the arrays";
  set_nodes(points, mesh);
  const std::size_t count = mesh.nodes.size();
  add_elements(rows_of(cells, 2, count, "cells"), mesh.dimension, "cells", mesh.cells);
  for (const auto& [name, given] : facets) {
    const std::string what = "facets of \"" + name + "\"";
    MeshGroup group{name, mesh.dimension - 1, {}};
    const int before = mesh.facets.size();
    add_elements(rows_of(given, 2, count, what), group.dimension, what, mesh.facets);
    for (int facet = before; facet < mesh.facets.size(); ++facet) group.members.push_back(facet);
    mesh.groups.push_back(std::move(group));
  }
  for (const auto& [name, given] : nodes)
    mesh.groups.push_back({name, 0, rows_of(given, 1, count, "nodes of \"" + name + "\"").values});
  const auto all = static_cast<std::size_t>(mesh.cells.size());
  for (const auto& [name, given] : bodies)
    mesh.groups.push_back(
        {name, mesh.dimension, rows_of(given, 1, all, "cells of \"" + name + "\"").values});
  return mesh;
}

/// As a result keeps it, so that a run can be resumed from its result alone.
template <int dim>
Grid grid_of(const ImportedBody<dim>& body) {
  const auto numbers_of = [](const auto& rows) {
    std::vector<int> values;
    for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
    return values;
  };
  Grid grid;
  if (dim == 3) grid.cell = Grid::Cell::hexahedron;
  grid.cells = numbers_of(body.mesh.cells);
  grid.parts.push_back({MeshPart::Kind::exterior, "", numbers_of(body.exterior)});
  for (const auto& X : body.mesh.nodes)
    std::copy_n(X.begin(), dim, grid.points.emplace_back().begin());
  for (const auto& [name, facets] : body.mesh.boundary)
    grid.parts.push_back({MeshPart::Kind::facets, name, numbers_of(facets)});
  for (const auto& [name, nodes] : body.point_groups)
    grid.parts.push_back({MeshPart::Kind::points, name, nodes});
  for (const auto& [name, cells] : body.cell_groups)
    grid.parts.push_back({MeshPart::Kind::cells, name, cells});
  return grid;
}

using Assembled = std::pair<std::shared_ptr<SharedModel>, std::vector<std::string>>;

/// The model, and what was repaired in the mesh.
template <int dim>
Assembled assembled(const Scene& scene, ImportedMesh mesh, const Groups& facets) {
  const ImportedBody<dim> body =
      check_mesh<dim>(std::move(mesh), scene.texts("wear.on"),
                      static_cast<int>(scene.integer("mesh.split")), separate_bodies(scene));
  for (const auto& [name, unused] : facets) boundary_part(body, name);
  return {std::make_shared<SharedModel>(set_up_again(scene, grid_of(body))), body.remarks};
}

Assembled assemble(const Scene& scene, const py::object& points, const py::object& cells,
                   const Groups& facets, const Groups& nodes, const Groups& bodies) {
  if (!Problems::find(scene.text("problem"), "problem").remake)
    throw InputError(scene.where("problem") + ": expected \"worn_body\", which takes a mesh");
  // Scene.with_ of Python gives all keys, those with defaults too.
  for (const char* key : {"mesh.file", "mesh.factor", "mesh.contact_size", "accuracy.within"})
    if (scene.has(key) && !scene.is_default(key))
      throw InputError(scene.where(key) + ": expected none beside arrays");
  ImportedMesh mesh = mesh_of(points, cells, facets, nodes, bodies);
  const py::gil_scoped_release without_interpreter;
  return mesh.dimension == 2 ? assembled<2>(scene, std::move(mesh), facets)
                             : assembled<3>(scene, std::move(mesh), facets);
}

}  // namespace

void add_arrays(py::module_& module) {
  module.def("_assemble", held(assemble));
}

}  // namespace gnomon::python
