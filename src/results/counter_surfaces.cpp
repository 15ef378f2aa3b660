#include "results/counter_surfaces.hpp"

#include <algorithm>

#include "results/hdf5_values.hpp"
#include "results/layout.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;

namespace {

constexpr const char* kPoints = "counter_points";
constexpr const char* kFacets = "counter_facets";

hsize_t corners(int dim) {
  return dim == 2 ? 2 : 4;
}

}  // namespace

std::optional<StoredSurface> CounterSurfaces::put(hid_t parent, const std::string& name,
                                                  const std::string& path,
                                                  const std::optional<CounterSurface>& surface) {
  if (!surface || surface->facets.empty()) return std::nullopt;
  const bool moved = surface->points != last_.points, other = surface->facets != last_.facets;
  if (moved || other) {
    const Handle group = create_group(parent, name, 2);
    if (moved) {
      hdf5::write_dataset(group.id(), "points", {surface->points.size(), 3},
                          surface->points.front().data());
      place_.points = path + "/points";
    }
    const hsize_t count = surface->facets.size() / corners(surface->dim);
    if (other) {
      hdf5::write_dataset(group.id(), "facets", {count, corners(surface->dim)},
                          surface->facets.data());
      place_.facets = path + "/facets";
    }
    place_ = {surface->dim, place_.points, place_.facets, surface->points.size(), count};
    last_ = *surface;
  }
  return place_;
}

void write_surface_names(hid_t step, const StoredSurface& surface) {
  hdf5::write_attribute(step, kPoints, surface.points);
  hdf5::write_attribute(step, kFacets, surface.facets);
}

std::optional<CounterSurface> read_surface(hid_t file, hid_t step) {
  const auto names = hdf5::attribute_names(step);
  if (std::find(names.begin(), names.end(), kPoints) == names.end()) return std::nullopt;
  const auto points = hdf5::read_doubles(file, hdf5::read_text_attribute(step, kPoints));
  const std::string path = hdf5::read_text_attribute(step, kFacets);
  const Handle facets =
      hdf5::own(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "read the counter-body");
  const auto extents = hdf5::extents_of(facets.id());
  const bool known = extents.size() == 2 && (extents[1] == 2 || extents[1] == 4);
  if (!known || points.extents.size() != 2 || points.extents[1] != 3)
    throw Failure("cannot read the counter-body: its extents are wrong");
  CounterSurface surface;
  surface.dim = extents[1] == 2 ? 2 : 3;
  surface.facets = hdf5::read_ints(file, path);
  for (std::size_t i = 0; i < points.values.size(); i += 3)
    surface.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
  const auto count = static_cast<int>(surface.points.size());
  if (std::any_of(surface.facets.begin(), surface.facets.end(),
                  [count](int point) { return point < 0 || point >= count; }))
    throw Failure("cannot read the counter-body: a facet has points that it does not have");
  return surface;
}

}  // namespace gnomon::layout
