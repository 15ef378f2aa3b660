// A mesh in a result, the group "mesh": of the root for the start, of an epoch for what follows its
// beginning; and the named parts of one that came from a file.
#pragma once

#include <hdf5.h>

#include <gnomon/model/model.hpp>
#include <optional>

namespace gnomon::layout {

/// In the group `parent`.
void write_mesh(hid_t parent, const Grid& grid);
/// Throws Failure where it is damaged; nothing where there is none.
std::optional<Grid> read_grid(hid_t parent);

}  // namespace gnomon::layout
