// The mesh in a result: /mesh, and the named parts of one that came from a file.
#pragma once

#include <hdf5.h>

#include <gnomon/model/model.hpp>
#include <optional>

namespace gnomon::layout {

void write_mesh(hid_t file, const Grid& grid);
/// Throws Failure where it is damaged; nothing where there is none.
std::optional<Grid> read_grid(hid_t file);

}  // namespace gnomon::layout
