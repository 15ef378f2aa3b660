#include "run/mesh_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/terms/solid.hpp>

namespace gnomon {

namespace {
constexpr double sound = 1;  // volume and quality where a model has no mesh
constexpr double nearly_folded = 0.1;

template <int dim>
double least_quality(const Grid& grid) {
  constexpr int corners = Mesh<dim>::cell_nodes;
  double least = sound;
  for (std::size_t first = 0; first + corners <= grid.cells.size(); first += corners) {
    CellNodal<dim> X;
    for (int a = 0; a < corners; ++a)
      for (int i = 0; i < dim; ++i) X(a, i) = grid.points[grid.cells[first + a]][i];
    least = std::min(least, scaled_jacobian<dim>(X));
  }
  return least;
}

std::string folding_text(double quality, double initial) {
  if (initial >= nearly_folded)
    return fmt::format(
        "an element of the worn mesh is nearly folded: its scaled Jacobian is {:.2g}", quality);
  if (quality < initial / 2)
    return fmt::format(
        "an element of the worn mesh is nearly folded: its scaled Jacobian is {:.2g}, that of the "
        "mesh was {:.2g} from the start",
        quality, initial);
  return fmt::format(
      "an element of the mesh is nearly folded, as it was from the start: its scaled Jacobian is "
      "{:.2g}, and was {:.2g} before any wear",
      quality, initial);
}
}  // namespace

double initial_quality(const std::optional<Grid>& grid) {
  if (!grid) return sound;
  return grid->cell == Grid::Cell::quadrilateral ? least_quality<2>(*grid)
                                                 : least_quality<3>(*grid);
}

void require_sound_mesh(const Observation& observed) {
  const double volume = value_of(observed, "element_volume").value_or(sound);
  const double quality = value_of(observed, "element_quality").value_or(sound);
  // With such an element steps would become ever shorter without an end.
  if (volume < 0.01)
    throw SolutionError(fmt::format(
        "an element is worn down to {:.2g} of its volume: the body is worn away, or its mesh too "
        "flat for that depth",
        volume));
  if (quality <= 0)
    throw SolutionError(fmt::format(
        "an element of the worn mesh is folded: its scaled Jacobian is {:.2g}", quality));
}

std::vector<MeshWarning> mesh_warnings(const Observation& observed, double initial) {
  const double volume = value_of(observed, "element_volume").value_or(sound);
  const double quality = value_of(observed, "element_quality").value_or(sound);
  std::vector<MeshWarning> warnings;
  if (volume < 0.1)
    warnings.push_back(
        {"wear",
         fmt::format("an element is worn down to {:.2g} of its volume; at 0.01 the run ends",
                     volume)});
  else if (quality < nearly_folded)
    warnings.push_back({initial < nearly_folded && quality >= initial / 2 ? "mesh" : "wear",
                        folding_text(quality, initial)});
  const double gradient = value_of(observed, "displacement_gradient").value_or(0);
  if (gradient > 0.5)
    warnings.push_back(
        {"strain",
         fmt::format("displacements have gradients up to {:.2g}, for which body.kinematics = "
                     "\"small\" is not meant: the result is worthless",
                     gradient)});
  return warnings;
}

}  // namespace gnomon
