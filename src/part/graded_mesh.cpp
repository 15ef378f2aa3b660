#include "part/graded_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>

#include "model/expected_contact.hpp"
#include "part/body_meshes.hpp"
#include "part/histories.hpp"
#include "part/pair_keys.hpp"

namespace gnomon::part {

namespace {

constexpr const char* size_key = "mesh.contact_size";
constexpr double across = 20;  // elements of the contact of a mesh to begin with

double away(const FineZone::Ball& ball, const std::array<double, 3>& place) {
  return std::hypot(place[0] - ball[0], place[1] - ball[1], place[2] - ball[2]);
}

/// Fewer balls that contain all: those whose centres lie in one before are added to it.
std::vector<FineZone::Ball> merged(const std::vector<FineZone::Ball>& balls, double size) {
  constexpr std::size_t most = 1500;
  std::vector<FineZone::Ball> result;
  for (double within = size;; within *= 2) {
    result.clear();
    for (const FineZone::Ball& ball : balls) {
      const std::array centre = {ball[0], ball[1], ball[2]};
      const auto near = std::ranges::find_if(
          result, [&](const FineZone::Ball& before) { return away(before, centre) < within; });
      if (near == result.end()) {
        result.push_back(ball);
        if (result.size() > most) break;
      } else {
        (*near)[3] = std::max((*near)[3], away(*near, centre) + ball[3]);
      }
    }
    if (result.size() <= most) return result;
  }
}

template <int dim>
std::vector<FineZone::Ball> zone_in(const Scene& scene, const ImportedMesh& mesh) {
  constexpr long phases = 16;  // where the program chooses their number
  const ImportedBody<dim> part = check_bodies<dim>(scene, mesh, 0);
  const AssemblyParts<dim> parts =
      read_part<dim>(chooses_phases(scene) ? with_phases(scene, phases) : scene, part);
  std::vector<FineZone::Ball> balls;
  for (const Ball<dim>& ball :
       expected_contact(parts, magnitudes_of(parts, parts.scales.duration))) {
    FineZone::Ball& now = balls.emplace_back();
    for (int i = 0; i < dim; ++i) now[static_cast<std::size_t>(i)] = ball.centre[i];
    now[3] = ball.radius;
  }
  return balls;
}

/// Where the bodies are expected to touch, on the mesh at hand.
std::vector<FineZone::Ball> zone_of(const Scene& scene, const ImportedMesh& mesh) {
  return mesh.dimension == 2 ? zone_in<2>(scene, mesh) : zone_in<3>(scene, mesh);
}

/// Of the box around the balls, which are one or more [length].
double extent_of(const FineZone& fine) {
  std::vector<Vector<3>> ends;
  for (const auto& [x, y, z, radius] : fine.balls)
    for (const double side : {-radius, radius}) ends.emplace_back(x + side, y + side, z + side);
  return Box<3>::around(ends).diagonal();
}

/// Of facets in the zone.
void require_moderate_number(const Scene& scene, double extent, int dimension) {
  constexpr double most = 1e5;
  const double least = extent / std::pow(most, 1.0 / (dimension - 1)) / scene.real("mesh.factor");
  if (scene.real(size_key) < least)
    throw InputError(fmt::format(
        "{}: expected a size that is not so small beside the contact, which may extend over {:.3g} "
        "mm: {:.2g} or more",
        scene.where(size_key), extent, least));
}

bool is_in(const FineZone& fine, const std::array<double, 3>& place) {
  return std::ranges::any_of(
      fine.balls, [&](const FineZone::Ball& ball) { return away(ball, place) <= ball[3]; });
}

/// Longest edges of facets in the zone; 0 where there is none.
double mean_edge(const ImportedMesh& mesh, const FineZone& fine) {
  double sum = 0;
  int count = 0;
  for (int k = 0; k < mesh.facets.size(); ++k) {
    const auto nodes = mesh.facets.at(k);
    const auto& first = mesh.nodes[static_cast<std::size_t>(nodes[0])];
    if (!is_in(fine, first)) continue;
    double longest = 0;
    for (const int node : nodes)
      longest = std::max(longest, away({first[0], first[1], first[2], 0},
                                       mesh.nodes[static_cast<std::size_t>(node)]));
    sum += longest;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Of the boundary in the zone, which reaches out of the body: how far two of its nodes are apart,
/// found from the one that is farthest from any [length].
double width_of(const ImportedMesh& mesh, const FineZone& fine) {
  std::vector<std::array<double, 3>> places;
  for (int k = 0; k < mesh.facets.size(); ++k)
    for (const int node : mesh.facets.at(k))
      if (const auto& place = mesh.nodes[static_cast<std::size_t>(node)]; is_in(fine, place))
        places.push_back(place);
  double width = 0;
  for (std::size_t from = 0, sweep = 0; sweep < 3 && !places.empty(); ++sweep) {
    const FineZone::Ball start{places[from][0], places[from][1], places[from][2]};
    for (std::size_t i = 0; i < places.size(); ++i)
      if (const double apart = away(start, places[i]); apart > width) width = apart, from = i;
  }
  return width;
}

/// Whether the geometry gives the number of elements of the contact: edges are as long as those of
/// a mesh of a size twice as large or more.
bool is_fixed(const Scene& scene, FineZone fine, double size, double edge) {
  constexpr double finer = 0.5, clearly = 0.75;
  fine.size = finer * size;
  fine.balls = merged(fine.balls, fine.size);
  const double now = mean_edge(read_mesh(scene, fine), fine);
  return now == 0 || now > clearly * edge;
}

/// What `check` and `run` print of the mesh.
std::string told(const ImportedMesh& mesh, const FineZone& fine, double factor) {
  constexpr double much = 1.7;
  const double edge = mean_edge(mesh, fine), wanted = fine.size * factor;
  return fmt::format(
      "where the bodies are expected to touch, over {:.3g} mm, edges are about {:.3g} "
      "mm (mesh.contact_size{})",
      width_of(mesh, fine), edge,
      edge > much * wanted
          ? fmt::format(" asks for {:.3g}, but the geometry gives their number", wanted)
          : "");
}

}  // namespace

ImportedMesh read_graded_mesh(const Scene& scene) {
  if (scene.given(size_key) && !has_geometry(scene))
    refuse(scene, size_key, "a geometry (.geo, .step or .stp), which gnomon meshes");
  if (!scene.given(size_key)) return read_mesh(scene);
  // A mesh says where the next one has to be fine only as well as it is fine itself. Those before
  // the last one do not depend on a moderate factor, so that they are kept for other factors.
  constexpr double finer = 6, moderate = 3;
  const double factor = scene.real("mesh.factor"), wanted = factor * scene.real(size_key);
  const Scene before = scene.with("mesh.factor", factor > moderate ? factor : 1.0);
  ImportedMesh mesh = read_mesh(before);
  FineZone fine{.balls = zone_of(scene, mesh)};
  for (double size = 0; !fine.balls.empty(); fine.balls = zone_of(scene, mesh)) {
    const bool last = size > 0 && size <= finer * wanted;
    size = size > 0 ? size / finer : extent_of(fine) / across;
    fine.size = last ? scene.real(size_key) : size / before.real("mesh.factor");
    fine.balls = merged(fine.balls, fine.size);
    require_moderate_number(scene, extent_of(fine), mesh.dimension);
    mesh = read_mesh(last ? scene : before, fine);
    if (!last) continue;
    mesh.remarks.push_back(told(mesh, fine, factor));
    return mesh;
  }
  return read_mesh(scene);
}

std::optional<Scene> with_contact_size(const Scene& scene) {
  if (scene.is_set("mesh.factor") || scene.given(size_key) || !has_geometry(scene)) return {};
  ImportedMesh mesh = read_mesh(scene);
  const bool has_sizes = mesh.has_sizes || scene.is_set("mesh.size");
  FineZone fine{.balls = zone_of(scene, mesh)};
  if (fine.balls.empty()) return {};
  const double own_edge = has_sizes ? mean_edge(mesh, fine) : 0;
  for (int pass = 0; pass < 2; ++pass) {
    fine.size = extent_of(fine) / across;
    fine.balls = merged(fine.balls, fine.size);
    mesh = read_mesh(scene, fine);
    fine.balls = zone_of(scene, mesh);
    if (fine.balls.empty()) return {};
  }
  double size = extent_of(fine) / across;
  if (own_edge > 0) size = std::min(size, own_edge);
  if (has_sizes && is_fixed(scene, fine, size, mean_edge(mesh, fine))) return {};
  const double digit = std::pow(10, std::floor(std::log10(size)));
  return scene.with(size_key, std::round(10 * size / digit) * digit / 10);
}

}  // namespace gnomon::part
