#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "gmsh/folded_cells.hpp"
#include "gmsh/model_mesh.hpp"

namespace gnomon::gmsh_reader {

namespace {

void set(const char* option, double value) {
  gmsh::option::setNumber(option, value);
}

double get(const char* option) {
  double value = 0;
  gmsh::option::getNumber(option, value);
  return value;
}

/// Whether all elements of the highest dimension are quadrilaterals or hexahedra.
bool is_of_bricks(int dimension) {
  constexpr int quadrilateral = 3, hexahedron = 5;
  const int brick = dimension == 2 ? quadrilateral : hexahedron;
  return std::ranges::all_of(element_types(dimension), [=](int type) { return type == brick; });
}

double most_cells() {
  constexpr double bytes_per_cell = 2000;  // of the Jacobian alone, in the plane
  constexpr double limit = 20e6;
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  return std::min(limit, memory / bytes_per_cell);
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
  for (int curve : entities_of(1)) {
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
    for (int entity : entities_of(dimension)) {
      double mass = 0;
      gmsh::model::occ::getMass(dimension, entity, mass);
      sum += mass;
    }
    return sum;
  }
  if (dimension == 2) {
    for (int surface : entities_of(2)) sum += plane_area(surface);
    return sum;
  }
  constexpr double filled = 1e-3;
  std::array<double, 3> low{}, high{};
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return filled * (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
}

/// Whether sizes set the number of elements on curves: not where the script does.
bool sizes_count(double edge) {
  constexpr double tried = 1e4, some = 0.3;
  const double length = length_of_curves();
  const double coarser = std::max(length / edge / tried, 1.0);
  const double factor = get("Mesh.MeshSizeFactor");
  set("Mesh.MeshSizeFactor", factor * coarser);
  const double count = elements_on_curves();
  set("Mesh.MeshSizeFactor", factor);
  return count > some * length / (edge * coarser);
}

/// Before the current model is meshed: throws Refusal where edges of `size` times the factor that
/// is set give more cells than this computer can hold, with an estimate of their number from the
/// area or volume: that of OpenCASCADE, or of the outlines of a plane geometry, or of the box
/// around it. Structured meshes, which sizes do not change, are not refused.
void check_number_of_cells(int dimension, double size) {
  if (size <= 0) return;
  const double edge = size * get("Mesh.MeshSizeFactor"), most = most_cells();
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

/// Cells that are subdivided may fold by chance where the geometry is curved: those of a slightly
/// smaller size do not.
void generate_unfolded(int dimension, double factor, std::vector<std::string>& remarks) {
  for (const double part : {1.0, 0.97, 0.94, 0.91, 0.88, 1.0}) {  // where all fold: as asked for
    gmsh::model::mesh::clear();
    set("Mesh.MeshSizeFactor", part * factor);
    gmsh::model::mesh::generate(dimension);
    if (has_folded_cells(dimension)) continue;
    if (part == 1) return;
    std::ostringstream text;
    text << "a cell of the size asked for is folded, so the mesh is one of " << part
         << " times the size";
    return remarks.push_back(text.str());
  }
}

}  // namespace

void ask_for_factor(double factor) {
  set("Mesh.MeshSizeFactor", factor);
}

void ask_for_zone(const std::string& zone) {
  constexpr double growth = 0.3, far = 1e22;
  std::istringstream numbers(zone);
  double size = 0;
  std::array<double, 4> ball{};  // centre and radius
  std::vector<std::array<double, 4>> balls;
  numbers >> size;
  while (numbers >> ball[0] >> ball[1] >> ball[2] >> ball[3]) balls.push_back(ball);
  gmsh::model::mesh::setSizeCallback([=](int, int, double x, double y, double z) {
    double away = far;
    for (const auto& [cx, cy, cz, radius] : balls)
      away = std::min(away, std::hypot(x - cx, y - cy, z - cz) - radius);
    return size + growth * std::max(0.0, away);
  });
}

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

bool curves_follow_sizes() {
  constexpr double smaller = 0.25;
  const double count = elements_on_curves(), factor = get("Mesh.MeshSizeFactor");
  set("Mesh.MeshSizeFactor", smaller * factor);
  const double more = elements_on_curves();
  set("Mesh.MeshSizeFactor", factor);
  return more > count;
}

void mesh_geometry(double size, double factor, bool has_options,
                   std::vector<std::string>& remarks) {
  const int dimension = gmsh::model::getDimension();
  if (dimension < 2)
    throw Refusal("has no surface and no volume to be meshed (a Plane Surface is missing?)");
  if (!element_types(dimension).empty()) {  // by the commands of the script
    if (size != 0 || factor != 1)
      throw Refusal("the script has commands that mesh, so it takes no size");
    return;
  }
  set("Mesh.ElementOrder", 1);
  if (size > 0) {
    set("Mesh.MeshSizeMax", std::min(size, get("Mesh.MeshSizeMax")));
    set("Mesh.MeshSizeMin", std::min(size, get("Mesh.MeshSizeMin")));
  }
  // A STEP file cannot ask for small elements at small holes and edges, where large ones fold.
  constexpr double by_turn = 24;
  if (!has_options) set("Mesh.MeshSizeFromCurvature", by_turn);
  const double there = get("Mesh.MeshSizeFactor");
  const double own_factor = there == factor ? factor : there * factor;  // a script has set its own
  set("Mesh.MeshSizeFactor", own_factor);
  // Subdivision is left to what does not come out as it should: it would refine structured meshes.
  set("Mesh.SubdivisionAlgorithm", 0);
  check_number_of_cells(dimension, size);
  if (dimension == 2) {
    set("Mesh.RecombineAll", 1);
    constexpr int full_quads_simple = 2;
    if (get("Mesh.RecombinationAlgorithm") > full_quads_simple)
      set("Mesh.RecombinationAlgorithm", 1);  // Gmsh 4.8.4 fails with that of full quads
  }
  gmsh::model::mesh::generate(dimension);
  if (is_of_bricks(dimension)) return;
  // Gmsh's own subdivision has its new nodes on the true geometry.
  set("Mesh.SubdivisionAlgorithm", dimension == 2 ? 1 : 2);
  generate_unfolded(dimension, 2 * own_factor, remarks);
  remarks.push_back(dimension == 2
                        ? "not all triangles could be paired, so the mesh is one of twice the "
                          "size with each cell subdivided into quadrilaterals"
                        : "not of hexahedra by itself, so the mesh is one of twice the size "
                          "with each cell subdivided into hexahedra");
}

}  // namespace gnomon::gmsh_reader
