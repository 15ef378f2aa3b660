// Physical groups of a script that name what the geometry does not have.
#pragma once

#include <string>
#include <vector>

namespace gnomon::gmsh_reader {

/// Gmsh leaves out, without a word, curves and surfaces of a physical group that do not exist.
/// Reads the groups in the text of a script (.geo) that are lists of plain numbers, and returns a
/// sentence for each with numbers that the current model does not have.
std::vector<std::string> absent_members(const std::string& file);

}  // namespace gnomon::gmsh_reader
