#include "gmsh/size_check.hpp"

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "gmsh/model_mesh.hpp"

namespace gnomon::gmsh_reader {

namespace {

double most_cells() {
  constexpr double bytes_per_cell = 2000;  // of the Jacobian alone, in the plane
  constexpr double limit = 20e6;
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  return std::min(limit, memory / bytes_per_cell);
}

gmsh::vectorpair entities(int dimension) {
  gmsh::vectorpair result;
  gmsh::model::getEntities(result, dimension);
  return result;
}

/// x, y, z of points along a curve.
std::vector<double> points_of(int curve) {
  constexpr int pieces = 64;
  std::vector<double> from, to, at, points;
  gmsh::model::getParametrizationBounds(1, curve, from, to);
  for (int k = 0; k <= pieces; ++k) at.push_back(from[0] + (to[0] - from[0]) * k / pieces);
  gmsh::model::getValue(1, curve, at, points);
  return points;
}

double length_of_curves() {
  double length = 0;
  for (const auto& [dimension, curve] : entities(1)) {
    const std::vector<double> p = points_of(curve);
    for (std::size_t k = 3; k + 2 < p.size(); k += 3)
      length += std::hypot(p[k] - p[k - 3], p[k + 1] - p[k - 2], p[k + 2] - p[k - 1]);
  }
  return length;
}

/// Of a surface in the plane z = 0, from its oriented outlines: half the integral of x dy - y dx.
double plane_area(int surface) {
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, surface}}, curves, true, true, false);
  double sum = 0;
  for (const auto& [dimension, curve] : curves) {
    const std::vector<double> p = points_of(std::abs(curve));
    for (std::size_t k = 3; k + 2 < p.size(); k += 3)
      sum += (curve < 0 ? -0.5 : 0.5) * (p[k - 3] * p[k + 1] - p[k] * p[k - 2]);
  }
  return std::abs(sum);
}

bool is_of_opencascade(int dimension) {
  gmsh::vectorpair found;
  gmsh::model::occ::getEntities(found, dimension);
  return !found.empty();
}

/// Least area (volume) of the model that is sure. Of a body of the built-in kernel in space it is
/// not known: a part of the box around it.
double measure(int dimension) {
  double sum = 0;
  if (is_of_opencascade(dimension)) {
    for (const auto& [d, entity] : entities(dimension)) {
      double mass = 0;
      gmsh::model::occ::getMass(d, entity, mass);
      sum += mass;
    }
    return sum;
  }
  if (dimension == 2) {
    for (const auto& [d, surface] : entities(2)) sum += plane_area(surface);
    return sum;
  }
  constexpr double filled = 1e-3;
  std::array<double, 3> low{}, high{};
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return filled * (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
}

}  // namespace

double elements_on_curves() {
  gmsh::model::mesh::clear();
  gmsh::model::mesh::generate(1);
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 1);
  gmsh::model::mesh::clear();
  double count = 0;
  for (const auto& list : tags) count += static_cast<double>(list.size());
  return count;
}

namespace {

/// Whether sizes set the number of elements on curves: not where the script does.
bool sizes_count(double edge) {
  constexpr double tried = 1e4, some = 0.3;
  const double length = length_of_curves();
  const double coarser = std::max(length / edge / tried, 1.0);
  double factor = 1;
  gmsh::option::getNumber("Mesh.MeshSizeFactor", factor);
  gmsh::option::setNumber("Mesh.MeshSizeFactor", factor * coarser);
  const double count = elements_on_curves();
  gmsh::option::setNumber("Mesh.MeshSizeFactor", factor);
  return count > some * length / (edge * coarser);
}

}  // namespace

void check_number_of_cells(int dimension, double size) {
  if (size <= 0) return;
  double factor = 1;
  gmsh::option::getNumber("Mesh.MeshSizeFactor", factor);
  const double edge = size * factor, most = most_cells();
  const double cells = measure(dimension) / std::pow(edge, dimension);
  if (cells <= most || !sizes_count(edge)) return;
  std::ostringstream text;
  text.precision(2);
  text << "size " << size << " asks for about " << cells
       << (dimension == 2 ? " quadrilaterals" : " hexahedra") << ", expected at most "
       << std::floor(most / 1e6) << " million, for which there may be memory here: a size of "
       << size * std::pow(cells / most, 1.0 / dimension) << " or more";
  throw Refusal(text.str());
}

}  // namespace gnomon::gmsh_reader
