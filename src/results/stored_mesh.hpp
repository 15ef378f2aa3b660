// Meshes in a result, as points and elements: that of the body, the group "mesh" of the root for
// the start and of an epoch for what follows its beginning, with the named parts of one that came
// from a file; and the surfaces of the counter-body below "counter_body", where points and facets
// are each written only if they are not those of the step before; attributes of the stored step
// name both.
#pragma once

#include <hdf5.h>

#include <gnomon/model/model.hpp>
#include <optional>
#include <string>

namespace gnomon::layout {

/// In the group `parent`.
void write_mesh(hid_t parent, const Grid& grid);
/// Throws Failure where it is damaged; nothing where there is none.
std::optional<Grid> read_grid(hid_t parent);

/// The surface of a stored step as it lies in the file.
struct StoredSurface {
  int dim = 2;
  std::string points, facets;  ///< paths of the datasets
  std::size_t point_count = 0, facet_count = 0;
};

class CounterSurfaces {
public:
  /// Writes what has changed to `group`, which is new, and is made only if something has: it is
  /// called `name` in `parent`, and has the path `path`. Empty without facets.
  std::optional<StoredSurface> put(hid_t parent, const std::string& name, const std::string& path,
                                   const std::optional<CounterSurface>& surface);

private:
  CounterSurface last_;
  StoredSurface place_;
};

/// The attributes of the group of a stored step.
void write_surface_names(hid_t step, const StoredSurface& surface);
/// Throws Failure for a surface that cannot be.
std::optional<CounterSurface> read_surface(hid_t file, hid_t step);

}  // namespace gnomon::layout
