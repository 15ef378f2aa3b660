// A mesh with its named parts as one XDMF file for ParaView, without a run.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/results/result_files.hpp>
#include <string>

namespace gnomon {

/// A spatial collection of grids: "body", its cells, and one grid with the name of each part, its
/// facets or points. Each has the nodes that it uses. All numbers are in the file itself. `axes`:
/// names of the coordinates, "x y".
std::string mesh_view(const Grid& grid, const std::string& axes);

/// Whether the file begins like those of mesh_view.
bool is_mesh_view(const std::filesystem::path& file);

}  // namespace gnomon
