// gnomon mesh and gnomon new: what a mesh of one's own has, and a scene to begin with.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/terms/solid.hpp>

#include "app/commands.hpp"
#include "app/mesh_drawing.hpp"
#include "app/new_scene.hpp"
#include "app/program.hpp"
#include "app/text_table.hpp"
#include "part/stored_part.hpp"

namespace gnomon::app {

namespace {

using Align = TextTable::Align;

ImportedMesh read(const std::filesystem::path& file, std::optional<double> size) {
  if (size == 0)  // which would mean: as the geometry asks for
    throw InputError(file.string() + ": size 0: expected a positive length");
  return read_mesh_file(file, {.size = size.value_or(0)});
}

/// What `show` does with the body of a mesh, or of a result that has its mesh from a file.
template <class Show>
void with_body(const std::filesystem::path& file, std::optional<double> size, const Show& show) {
  if (is_result(file)) {
    const std::optional<Grid> grid = ResultReader(file).grid();
    if (size || !grid || grid->parts.empty())
      throw InputError(fmt::format(
          "{}: {}", file.string(),
          size ? "is a result, whose mesh is made already, so it takes no size"
               : "expected a result with a mesh from a file; gnomon made the mesh of this one"));
    if (grid->cell == Grid::Cell::quadrilateral)
      show(part_of_grid<2>(*grid, file.string()));
    else
      show(part_of_grid<3>(*grid, file.string()));
    return;
  }
  ImportedMesh mesh = read(file, size);
  if (mesh.dimension == 2)
    show(check_mesh<2>(std::move(mesh)));
  else
    show(check_mesh<3>(std::move(mesh)));
}

/// Names of the coordinates. A file with a mesh does not say what its plane is; a result does.
std::string axes_of(const std::filesystem::path& file, int dim) {
  if (dim == 3) return "x y z";
  if (!is_result(file)) return "x y";
  // As the scene of a result is written, so that results of other versions and plug-ins are told,
  // too.
  const bool turned =
      ResultReader(file).header().scene.find("\nplane = \"axisymmetric\"") != std::string::npos;
  return turned ? "r z" : "x y";
}

template <int dim>
std::string direction_text(const Mesh<dim>& mesh,
                           const std::vector<typename Mesh<dim>::Facet>& facets) {
  const FlatPart<dim> part = flat_part<dim>(mesh, facets);
  if (!part.flat) {
    const int planes = planes_of<dim>(mesh, facets);
    return planes > 1 ? fmt::format("{} planes", planes) : "curved";
  }
  std::vector<double> normal;
  for (int i = 0; i < dim; ++i)
    normal.push_back(std::abs(part.normal[i]) < 1e-9 ? 0 : part.normal[i]);
  return fmt::format("flat, normal [{:.3g}]", fmt::join(normal, ", "));
}

template <int dim>
void print_mesh(const ImportedBody<dim>& body) {
  double volume = 0, quality = 1;
  for (const auto& cell : body.mesh.cells) {
    const CellNodal<dim> X = body.mesh.positions(cell);
    volume += cell_volume<dim>(X);
    quality = std::min(quality, scaled_jacobian<dim>(X));
  }
  fmt::print("{} nodes, {} {}, {} {:.6g} mm^{}, least quality {:.2g} (1: squares)\n",
             body.mesh.nodes.size(), body.mesh.cells.size(),
             dim == 2 ? "quadrilaterals" : "hexahedra", dim == 2 ? "area" : "volume", volume, dim,
             quality);
  TextTable table({{"part"},
                   {"facets", Align::right},
                   {dim == 2 ? "length" : "area", Align::right},
                   {"shape"}});
  for (const auto& [name, facets] : body.mesh.boundary) {
    double area = 0;
    for (const auto& patch : contact_patches<dim>(body.mesh, facets)) area += patch.initial_area;
    table.add({name, fmt::format("{}", facets.size()), fmt::format("{:.6g}", area),
               direction_text<dim>(body.mesh, facets)});
  }
  fmt::print("{}", table.text());
  for (const auto& [name, nodes] : body.point_groups)
    fmt::print("points \"{}\": {}\n", name, nodes.size());
  std::vector<std::string> lines;
  for (const auto& [name, reason] : body.unusable)  // whole bodies and points are as they should be
    if (!body.cell_groups.contains(name) && !body.point_groups.contains(name))
      lines.push_back(fmt::format("\"{}\" {}", name, reason));
  for (const std::string& remark : body.remarks)
    if (std::ranges::find(lines, remark) == lines.end()) lines.push_back(remark);
  for (const std::string& line : lines) fmt::print("{}\n", line);
}

}  // namespace

int mesh_command(const std::filesystem::path& file, std::optional<double> size,
                 const std::filesystem::path& written) {
  const bool for_gmsh = written.extension() == ".msh";
  if (for_gmsh && is_taken(written))
    throw InputError(written.string() + " exists; give another name with --output");
  if (!written.empty() && !for_gmsh) check_drawing(written);
  with_body(file, size, [&]<int dim>(const ImportedBody<dim>& body) {
    print_mesh(body);
    if (for_gmsh) write_file(written, gmsh_text(body), Earlier::refused);
    if (for_gmsh) fmt::print("mesh: {}\n", written.string());
    if (!written.empty() && !for_gmsh) draw_mesh(body, axes_of(file, dim), written);
  });
  return success;
}

int new_command(const std::filesystem::path& file, std::optional<double> size,
                std::filesystem::path scene) {
  if (scene.empty()) scene = std::filesystem::path(file).replace_extension(".toml");
  if (is_taken(scene))
    throw InputError(scene.string() + " exists; give another name with --output");
  ImportedMesh mesh = read(file, size);
  const std::string text = mesh.dimension == 2
                               ? new_scene(file, size, check_mesh<2>(std::move(mesh)))
                               : new_scene(file, size, check_mesh<3>(std::move(mesh)));
  write_file(scene, text, Earlier::refused);
  fmt::print("{}: fill in loads, counter-body and wear, then: gnomon check {}\n", scene.string(),
             scene.string());
  return success;
}

}  // namespace gnomon::app
