#include "results/stored_mesh.hpp"

#include <algorithm>
#include <array>

#include "results/hdf5_values.hpp"
#include "results/layout.hpp"

namespace gnomon::layout {

using hdf5::check;
using hdf5::Failure;
using hdf5::Handle;

namespace {

/// In the order of MeshPart::Kind.
constexpr std::array part_kinds = {"exterior", "facets", "points", "cells"};

void write_parts(hid_t mesh, const std::vector<MeshPart>& parts) {
  const Handle group = create_group(mesh, "parts", parts.size());
  std::vector<std::string> kinds, names;
  for (const MeshPart& part : parts) {
    hdf5::write_dataset(group.id(), std::to_string(kinds.size()), H5T_NATIVE_INT,
                        {part.nodes.size()}, part.nodes.data(), hdf5::Storage::compressed);
    kinds.emplace_back(part_kinds[static_cast<std::size_t>(part.kind)]);
    names.push_back(part.name);
  }
  hdf5::write_attribute(group.id(), "kinds", kinds);
  hdf5::write_attribute(group.id(), "names", names);
}

MeshPart::Kind kind_of(const std::string& name) {
  const auto found = std::find(part_kinds.begin(), part_kinds.end(), name);
  if (found == part_kinds.end()) throw Failure("cannot read the mesh: a part is of no known kind");
  return static_cast<MeshPart::Kind>(found - part_kinds.begin());
}

bool all_below(const std::vector<int>& numbers, std::size_t count) {
  return std::ranges::all_of(numbers,
                             [=](int k) { return k >= 0 && static_cast<std::size_t>(k) < count; });
}

/// Throws where a part has nodes that the mesh does not have.
void read_parts(hid_t parent, Grid& grid) {
  const Handle group = hdf5::open_group(parent, "mesh/parts", "read the mesh");
  const auto kinds = hdf5::read_texts_attribute(group.id(), "kinds");
  const auto names = hdf5::read_texts_attribute(group.id(), "names");
  if (kinds.size() != names.size())
    throw Failure("cannot read the mesh: its parts have kinds and names of different number");
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    MeshPart part{kind_of(kinds[k]), names[k],
                  hdf5::read_numbers<int>(group.id(), std::to_string(k)).values};
    const bool of_cells = part.kind == MeshPart::Kind::cells;
    if (!all_below(part.nodes, of_cells ? grid.cell_count() : grid.points.size()))
      throw Failure("cannot read the mesh: a part has nodes that the mesh does not have");
    grid.parts.push_back(std::move(part));
  }
}

constexpr const char* kPoints = "counter_points";
constexpr const char* kFacets = "counter_facets";

void write_points(hid_t group, const std::vector<std::array<double, 3>>& points,
                  hdf5::Storage storage) {
  hdf5::write_dataset(group, "points", H5T_NATIVE_DOUBLE, {points.size(), 3}, points.data(),
                      storage);
}

struct Elements {
  std::vector<std::array<double, 3>> points;
  std::vector<int> nodes;
  hsize_t corners;
};

/// Elements in the plane have `flat` corners, those in space twice as many.
Elements read_elements(hid_t parent, const std::string& points_path, const std::string& nodes_path,
                       hsize_t flat, const std::string& what) {
  const auto points = hdf5::read_numbers<double>(parent, points_path);
  auto nodes = hdf5::read_numbers<int>(parent, nodes_path);
  const bool known =
      nodes.extents.size() == 2 && (nodes.extents[1] == flat || nodes.extents[1] == 2 * flat);
  if (!known || points.extents.size() != 2 || points.extents[1] != 3)
    throw Failure("cannot read " + what + ": its extents are wrong");
  Elements elements{{}, std::move(nodes.values), nodes.extents[1]};
  for (std::size_t i = 0; i < points.values.size(); i += 3)
    elements.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
  return elements;
}

}  // namespace

void write_mesh(hid_t parent, const Grid& grid) {
  const Handle mesh = create_group(parent, "mesh", 2);
  write_points(mesh.id(), grid.points, hdf5::Storage::compressed);
  hdf5::write_dataset(mesh.id(), "cells", H5T_NATIVE_INT, {grid.cell_count(), grid.corners()},
                      grid.cells.data(), hdf5::Storage::compressed);
  if (!grid.parts.empty()) write_parts(mesh.id(), grid.parts);
}

std::optional<Grid> read_grid(hid_t parent) {
  if (!hdf5::exists(parent, "mesh")) return std::nullopt;
  Elements cells = read_elements(parent, "mesh/points", "mesh/cells", 4, "the mesh");
  Grid grid{cells.corners == 4 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron,
            std::move(cells.points), std::move(cells.nodes)};
  if (hdf5::exists(parent, "mesh/parts")) read_parts(parent, grid);
  return grid;
}

std::optional<StoredSurface> CounterSurfaces::put(hid_t parent, const std::string& name,
                                                  const std::string& path,
                                                  const std::optional<CounterSurface>& surface) {
  if (!surface || surface->facets.empty()) return std::nullopt;
  const bool moved = surface->points != last_.points, other = surface->facets != last_.facets;
  if (moved || other) {
    const Handle group = create_group(parent, name, 2);
    if (moved) {
      write_points(group.id(), surface->points, hdf5::Storage::plain);
      place_.points = path + "/points";
    }
    const hsize_t corners = surface->dim == 2 ? 2 : 4, count = surface->facets.size() / corners;
    if (other) {
      hdf5::write_dataset(group.id(), "facets", H5T_NATIVE_INT, {count, corners},
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
  if (check(H5Aexists(step, kPoints), "read the counter-body") == 0) return std::nullopt;
  Elements facets = read_elements(file, hdf5::read_text_attribute(step, kPoints),
                                  hdf5::read_text_attribute(step, kFacets), 2, "the counter-body");
  if (!all_below(facets.nodes, facets.points.size()))
    throw Failure("cannot read the counter-body: a facet has points that it does not have");
  return CounterSurface{facets.corners == 2 ? 2 : 3, std::move(facets.points),
                        std::move(facets.nodes)};
}

}  // namespace gnomon::layout
