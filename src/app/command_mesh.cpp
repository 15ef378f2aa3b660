// gnomon mesh and gnomon new: what a mesh of one's own has, and a scene to begin with.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/terms/solid.hpp>

#include "app/commands.hpp"
#include "app/new_pair_scene.hpp"
#include "app/new_scene.hpp"
#include "app/plotting_script.hpp"
#include "app/text_table.hpp"
#include "part/stored_part.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

ImportedMesh read(const fs::path& file, std::optional<double> size) {
  if (size == 0)  // which would mean: as the geometry asks for
    throw InputError(file.string() + ": size 0: expected a positive length");
  return read_mesh_file(file, {.size = size.value_or(0)});
}

/// What `show` does with the body of a mesh, or of a result that has its mesh from a file.
template <class Show>
void with_body(const fs::path& file, std::optional<double> size, const Show& show) {
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
  const std::vector<std::string> bodies = separate_groups(mesh);
  if (mesh.dimension == 2)
    show(check_mesh<2>(std::move(mesh), {}, 0, bodies));
  else
    show(check_mesh<3>(std::move(mesh), {}, 0, bodies));
}

/// Names of the coordinates. A file with a mesh does not say what its plane is; a result does.
std::string axes_of(const fs::path& file, int dim) {
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
  TextTable table("lrrl", {"part", "facets", dim == 2 ? "length" : "area", "shape"});
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

/// A folder that is removed with all its contents.
class TemporaryFolder {
public:
  TemporaryFolder() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (error) throw Error("there is no folder for temporary files (TMPDIR)");
    std::string name = (parent / "gnomon-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw Error(fmt::format("cannot make a temporary folder {}: {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

void draw(const std::string& view, const fs::path& file) {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "mesh.xdmf";
  write_file(mesh, view, Earlier::refused);
  const ScriptEnd end = run_plotting_script(
      {"mesh", "--output=" + file.string(), "--", mesh.string()}, folder.path() / "log");
  if (end.exit_code != 0) throw Error("no picture: " + end.complaint);
}

/// Throws InputError for another ending than .png, .svg or .xdmf, a folder that is not there, and
/// an .xdmf file that is not gnomon's and would be replaced.
void check_drawing(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".svg" && ending != ".xdmf")
    throw InputError(
        fmt::format("--output: expected a name that ends in .png, .svg (pictures), .xdmf (for "
                    "ParaView) or .msh (for Gmsh), got {}",
                    file.string()));
  std::error_code ignored;
  if (file.has_parent_path() && !fs::is_directory(file.parent_path(), ignored))
    throw InputError(fmt::format("--output: there is no folder {}", file.parent_path().string()));
  if (ending == ".xdmf" && is_taken(file) && !is_mesh_view(file))
    throw InputError(fmt::format("{} exists and is not a mesh that gnomon wrote; give another name",
                                 file.string()));
}

/// A picture of the mesh and its named parts, or the same for ParaView. `axes`: names of the
/// coordinates, "x y". Throws InputError, and Error without Python or its packages.
template <int dim>
void draw_mesh(const ImportedBody<dim>& body, const std::string& axes, const fs::path& file) {
  Grid grid = grid_of(body.mesh);
  grid.parts = stored_parts(body);
  const std::string view = mesh_view(grid, axes);
  if (file.extension() == ".xdmf") {
    write_file(file, view, Earlier::replaced);
  } else {
    draw(view, file);
  }
  fmt::print("{}\n", file.string());
}

}  // namespace

void mesh_command(const fs::path& file, std::optional<double> size, const fs::path& written) {
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
}

void new_command(const fs::path& file, std::optional<double> size, fs::path scene) {
  if (scene.empty()) scene = fs::path(file).replace_extension(".toml");
  if (is_taken(scene))
    throw InputError(scene.string() + " exists; give another name with --output");
  ImportedMesh mesh = read(file, size);
  const std::vector<std::string> bodies = bodies_that_meet(mesh);
  // Files of a scene are looked for from its folder.
  const fs::path beside = fs::proximate(fs::absolute(file), fs::absolute(scene).parent_path());
  const auto text_of = [&]<int dim>(const ImportedBody<dim>& body) {
    return bodies.empty() ? new_scene(beside, size, body)
                          : new_pair_scene(beside, size, body, bodies);
  };
  const std::string text = mesh.dimension == 2
                               ? text_of(check_mesh<2>(std::move(mesh), {}, 0, bodies))
                               : text_of(check_mesh<3>(std::move(mesh), {}, 0, bodies));
  write_file(scene, text, Earlier::refused);
  fmt::print("{}: fill in {}, then: gnomon check {}\n", scene.string(),
             bodies.empty() ? "loads, counter-body and wear" : "materials, loads, motion and wear",
             scene.string());
}

}  // namespace gnomon::app
