// Synthetic results for the tests of the result file: fields with known values, no numerics.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <gnomon/results/results.hpp>
#include <string>
#include <vector>

namespace gnomon::synthetic {

/// A folder for this process, removed at its end.
struct Scratch {
  Scratch() { std::filesystem::create_directories(path); }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / ("gnomon_results_" + std::to_string(getpid()));
};

/// A separate folder for a test, empty at first.
inline std::filesystem::path folder(const std::string& name) {
  static const Scratch scratch;
  const auto path = scratch.path / name;
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path;
}

inline RunHeader header() {
  RunHeader header;
  header.problem = "pin_on_flat";
  header.integrator = "backward-euler";
  header.scene = "problem = \"pin_on_flat\"\n[mesh]\nelements = [4, 3]\n";
  header.versions = {{"gnomon", "0.1.0"}, {"HDF5", "1.10.8"}, {"SUNDIALS", "6.4.1"}};
  header.blocks = {{"displacement", "u", 40, "all nodes"}, {"shape", "d", 38, "near the contact"}};
  return header;
}

/// nx by ny quadrilaterals below a parabola: the outline of the pin.
inline Grid grid(int nx, int ny) {
  Grid grid;
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) {
      const double x = 10.0 * i / nx - 5;
      const double bottom = x * x / 20;
      grid.points.push_back({x, bottom + (10 - bottom) * j / ny, 0});
    }
  }
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int first = j * (nx + 1) + i;
      for (const int node : {first, first + 1, first + nx + 2, first + nx + 1}) {
        grid.cells.push_back(node);
      }
    }
  }
  return grid;
}

/// Two by one by one hexahedra.
inline Grid hexahedra() {
  Grid grid;
  grid.cell = Grid::Cell::hexahedron;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 3; ++i) {
        grid.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
      }
    }
  }
  grid.cells = {0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};
  return grid;
}

/// displacement = (t, node, 0), shape = (0, t * (1 - (x/5)^2)+, 0), pressure = node + t,
/// equivalent_stress = cell * t, element_quality = 1.
inline std::vector<GridField> fields(const Grid& grid, double t) {
  const std::size_t points = grid.points.size();
  const std::size_t cells = grid.cells.size() / (grid.cell == Grid::Cell::quadrilateral ? 4 : 8);
  GridField displacement{"displacement", "mm", GridField::On::nodes, 3, {}};
  GridField shape{"shape", "mm", GridField::On::nodes, 3, {}};
  GridField pressure{"pressure", "MPa", GridField::On::nodes, 1, {}};
  for (std::size_t i = 0; i < points; ++i) {
    const double x = grid.points[i][0] / 5;
    displacement.values.insert(displacement.values.end(), {t, static_cast<double>(i), 0});
    shape.values.insert(shape.values.end(), {0, t * std::fmax(0, 1 - x * x), 0});
    pressure.values.push_back(static_cast<double>(i) + t);
  }
  GridField stress{"equivalent_stress", "MPa", GridField::On::cells, 1, {}};
  for (std::size_t i = 0; i < cells; ++i) stress.values.push_back(static_cast<double>(i) * t);
  GridField quality{"element_quality", "", GridField::On::cells, 1,
                    std::vector<double>(cells, 1.0)};
  return {displacement, shape, pressure, stress, quality};
}

/// Five nodes at x = 0..4 whose wear depth is t and whose pressure is 10 i + t; of a cycle of two
/// phases.
inline ContactSurface contact(double t) {
  ContactSurface contact;
  for (int i = 0; i < 5; ++i) {
    contact.node.push_back(i);
    contact.initial.push_back({1.0 * i, 0, 0});
    contact.worn.push_back({1.0 * i, t, 0});
    contact.current.push_back({1.0 * i, t - 1, 0});
    contact.pressure.push_back(10.0 * i + t);
    contact.wear_depth.push_back(t);
    contact.active.push_back(i < 3 ? 1 : 0);
  }
  contact.phase_position = {0.25, 0.75};
  contact.phase_weight = {0.5, 0.5};
  for (int k = 0; k < 10; ++k) contact.phase_pressure.push_back(k + t);
  for (int k = 0; k < 20; ++k) {  // of two components
    contact.phase_traction.push_back(2 * k - t);
    contact.phase_slip.push_back(k * t);
  }
  for (int k = 0; k < 8; ++k) contact.phase_loop.push_back(k - t);
  return contact;
}

/// Two facets below the contact nodes that move down with every whole second.
inline CounterSurface counter_body(double t) {
  const double y = -std::floor(t);
  return {2, {{0, y, 0}, {2, y, 0}, {4, y, 0}}, {0, 1, 1, 2}};
}

/// Row number `step` of a history with t = step / 4.
inline HistoryRow row(int step) {
  HistoryRow row;
  row.t = step / 4.0;
  row.step = {0.25, 1 + step % 5, 3L + step % 2, step % 7 == 3, step % 4};
  row.counters = {step,      step / 10, step / 20, 4L * step, 5L * step,
                  4L * step, 4L * step, 6L * step, 7L * step, 2L * step};
  row.scalars = {{"worn_volume", "mm^2", 0.5 * step}, {"contact_force", "N", 10.0}};
  return row;
}

}  // namespace gnomon::synthetic
