#include "results/stored_mesh.hpp"

#include <algorithm>
#include <array>

#include "results/hdf5_values.hpp"
#include "results/layout.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;

namespace {

/// In the order of MeshPart::Kind.
constexpr std::array part_kinds = {"exterior", "facets", "points", "cells"};

void write_parts(hid_t mesh, const std::vector<MeshPart>& parts) {
  const Handle group = create_group(mesh, "parts", parts.size());
  std::vector<std::string> kinds, names;
  for (const MeshPart& part : parts) {
    hdf5::write_dataset(group.id(), std::to_string(kinds.size()), {part.nodes.size()},
                        part.nodes.data(), hdf5::Storage::compressed);
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

/// Throws where a part has nodes that the mesh does not have.
void read_parts(hid_t parent, Grid& grid) {
  const Handle group =
      hdf5::own(H5Gopen2(parent, "mesh/parts", H5P_DEFAULT), H5Gclose, "read the mesh");
  const auto kinds = hdf5::read_texts_attribute(group.id(), "kinds");
  const auto names = hdf5::read_texts_attribute(group.id(), "names");
  if (kinds.size() != names.size())
    throw Failure("cannot read the mesh: its parts have kinds and names of different number");
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    MeshPart part{kind_of(kinds[k]), names[k], hdf5::read_ints(group.id(), std::to_string(k))};
    const bool of_cells = part.kind == MeshPart::Kind::cells;
    const auto count = static_cast<int>(of_cells ? grid.cell_count() : grid.points.size());
    if (std::ranges::any_of(part.nodes, [=](int k) { return k < 0 || k >= count; }))
      throw Failure("cannot read the mesh: a part has nodes that the mesh does not have");
    grid.parts.push_back(std::move(part));
  }
}

}  // namespace

void write_mesh(hid_t parent, const Grid& grid) {
  const Handle mesh = create_group(parent, "mesh", 2);
  hdf5::write_dataset(mesh.id(), "points", {grid.points.size(), 3},
                      grid.points.empty() ? nullptr : grid.points.front().data(),
                      hdf5::Storage::compressed);
  hdf5::write_dataset(mesh.id(), "cells", {grid.cell_count(), grid.corners()}, grid.cells.data(),
                      hdf5::Storage::compressed);
  if (!grid.parts.empty()) write_parts(mesh.id(), grid.parts);
}

std::optional<Grid> read_grid(hid_t parent) {
  if (!hdf5::exists(parent, "mesh")) return std::nullopt;
  Grid grid;
  const auto points = hdf5::read_doubles(parent, "mesh/points");
  const Handle cells =
      hdf5::own(H5Dopen2(parent, "mesh/cells", H5P_DEFAULT), H5Dclose, "read the mesh");
  const auto extents = hdf5::extents_of(cells.id());
  const bool known = extents.size() == 2 && (extents[1] == 4 || extents[1] == 8);
  if (!known || points.extents.size() != 2 || points.extents[1] != 3) {
    throw Failure("cannot read the mesh: its extents are wrong");
  }
  grid.cell = extents[1] == 4 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
  grid.cells = hdf5::read_ints(parent, "mesh/cells");
  for (std::size_t i = 0; i < points.values.size(); i += 3) {
    grid.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
  }
  if (hdf5::exists(parent, "mesh/parts")) read_parts(parent, grid);
  return grid;
}

}  // namespace gnomon::layout
