#include "app/mesh_drawing.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/results/mesh_view.hpp>

#include "app/plotting_script.hpp"
#include "part/stored_part.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

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

}  // namespace

void check_drawing(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending != ".png" && ending != ".svg" && ending != ".xdmf")
    throw InputError(
        fmt::format("--output: expected a name that ends in .png, .svg (pictures), .xdmf (for "
                    "ParaView) or .msh "
                    "(for Gmsh), got {}",
                    file.string()));
  std::error_code ignored;
  if (file.has_parent_path() && !fs::is_directory(file.parent_path(), ignored))
    throw InputError(fmt::format("--output: there is no folder {}", file.parent_path().string()));
  if (ending == ".xdmf" && is_taken(file) && !is_mesh_view(file))
    throw InputError(fmt::format("{} exists and is not a mesh that gnomon wrote; give another name",
                                 file.string()));
}

template <int dim>
void draw_mesh(const ImportedBody<dim>& body, const std::string& axes, const fs::path& file) {
  const std::string view = mesh_view(grid_of(body), axes);
  if (file.extension() == ".xdmf") {
    write_file(file, view, Earlier::replaced);
  } else {
    draw(view, file);
  }
  fmt::print("{}\n", file.string());
}

template void draw_mesh(const ImportedBody<2>&, const std::string&, const fs::path&);
template void draw_mesh(const ImportedBody<3>&, const std::string&, const fs::path&);

}  // namespace gnomon::app
