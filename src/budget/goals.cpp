// What a run is made for, and how far two runs differ in it.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gnomon/budget/budget.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <gnomon/system/system.hpp>
#include <limits>

#include "base/spectrum.hpp"

namespace gnomon {

namespace {

Eigen::Vector3d vector_of(const std::array<double, 3>& point) {
  return {point[0], point[1], point[2]};
}

/// The nodes within 0.9 of the contact from its middle to its edge. An ellipse stands for the
/// contact: that of the covariance of its nodes, as large as the farthest of them.
std::vector<std::size_t> inner_nodes(const ContactSurface& surface) {
  std::vector<std::size_t> closed;
  for (std::size_t i = 0; i < surface.pressure.size(); ++i)
    if (surface.pressure[i] > 0) closed.push_back(i);
  Eigen::Vector3d middle(0, 0, 0);
  for (const std::size_t i : closed)
    middle += vector_of(surface.initial[i]) / static_cast<double>(closed.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3, 3);
  const auto apart = [&](std::size_t i) -> Eigen::Vector3d {
    return vector_of(surface.initial[i]) - middle;
  };
  for (const std::size_t i : closed) covariance += apart(i) * apart(i).transpose();
  const Eigen::Matrix3d metric = pseudo_inverse(covariance, 1e-6);
  const auto radius = [&](std::size_t i) { return std::sqrt(apart(i).dot(metric * apart(i))); };
  double edge = 0;
  for (const std::size_t i : closed) edge = std::max(edge, radius(i));
  std::erase_if(closed, [&](std::size_t i) { return radius(i) > 0.9 * edge; });
  return closed;
}

double profile_norm(const ContactSurface& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.worn.size(); ++i)
    sum += (vector_of(surface.worn[i]) - vector_of(surface.initial[i])).squaredNorm();
  return std::sqrt(sum);
}

double inner_pressure(const ContactSurface& surface) {
  double sum = 0;
  const std::vector<std::size_t> nodes = inner_nodes(surface);
  for (const std::size_t i : nodes) sum += std::pow(surface.pressure[i], 2);
  return nodes.empty() ? 0 : std::sqrt(sum / static_cast<double>(nodes.size()));
}

/// Norms of differences between fields, as those of the fields above.
struct FieldDifferences {
  double profile = 0, inner_pressure = 0;
};

FieldDifferences field_differences(const ContactSurface& surface, const ContactSurface& other) {
  const SurfaceDifference difference = surface_difference(surface, other);
  const std::vector<std::size_t> inner = inner_nodes(surface);
  double sum = 0;
  for (const std::size_t i : inner) sum += std::pow(difference.pressure[i], 2);
  const Eigen::Map<const Eigen::VectorXd> distance(
      difference.distance.data(), static_cast<Eigen::Index>(difference.distance.size()));
  return {distance.norm(), inner.empty() ? 0 : std::sqrt(sum / static_cast<double>(inner.size()))};
}

/// With the sizes of the elements at the surface.
void add_edges(const Grid& grid, Goals& goals) {
  const ContactSurface& surface = goals.surface;
  constexpr double far = std::numeric_limits<double>::infinity();
  goals.edge.assign(surface.node.size(), far);
  const std::vector<int> body_of = connected_bodies(grid);
  std::vector<int> place_of(grid.points.size(), -1);
  for (std::size_t i = 0; i < surface.node.size(); ++i) {
    const auto node = static_cast<std::size_t>(surface.node[i]);
    place_of[node] = static_cast<int>(i);
    goals.body.push_back(body_of[node]);
  }
  const auto corners = grid.corners();
  std::vector<std::size_t> of_cell;
  for (std::size_t first = 0; first < grid.cells.size(); first += corners) {
    of_cell.clear();
    for (std::size_t k = first; k < first + corners; ++k)
      if (const int i = place_of[static_cast<std::size_t>(grid.cells[k])]; i >= 0)
        of_cell.push_back(static_cast<std::size_t>(i));
    for (const std::size_t i : of_cell)
      for (const std::size_t j : of_cell)
        if (i != j)
          goals.edge[i] =
              std::min(goals.edge[i],
                       (vector_of(surface.initial[i]) - vector_of(surface.initial[j])).norm());
  }
}

}  // namespace

long nodes_of(const Model& model) {
  return model.grid ? static_cast<long>(model.grid->points.size()) : 0;
}

std::optional<Goals> goals_of(const Model& model, const State& state, const Observation& observed) {
  std::optional<ContactSurface> surface = model.contact(state);
  if (!surface || !find_scalar(observed, "worn_volume")) return {};
  Goals goals{.time = state.t,
              .nodes = nodes_of(model),
              .nonzeros = static_cast<double>(model.system().structure().pattern.nonzeros()),
              .values = {},
              .surface = std::move(*surface)};
  if (model.grid) add_edges(*model.grid, goals);
  if (const auto difference = wear_difference(observed); difference && *difference != 0)
    goals.ledger = std::abs(*difference / *value_of(observed, "worn_volume"));
  const auto add = [&](const char* name) {
    if (const Scalar* const scalar = find_scalar(observed, name)) goals.values.push_back(*scalar);
  };
  add("worn_volume");
  add("wear_depth");
  goals.values.push_back({"profile", "mm", profile_norm(goals.surface)});
  const Scalar* const area = find_scalar(observed, "contact_area");
  const auto half_width = value_of(observed, "contact_half_width");
  const bool in_plane = half_width && !(area && area->unit == "mm^2");
  add(in_plane ? "contact_half_width" : "contact_area");
  const double size = in_plane ? 2 * *half_width : area ? area->value : 0;
  if (const auto force = value_of(observed, "contact_force"))
    goals.values.push_back({"mean_pressure", "MPa", size > 0 ? *force / size : 0});
  goals.values.push_back({"inner_pressure", "MPa", inner_pressure(goals.surface)});
  add("max_pressure");
  add("approach");
  return goals;
}

bool is_norm(const std::string& value) {
  return value == "profile" || value == "inner_pressure";
}

std::vector<double> differences(const Goals& goals, const Goals& other) {
  const FieldDifferences fields = field_differences(goals.surface, other.surface);
  std::vector<double> result;
  for (const Scalar& scalar : goals.values) {
    const double difference =
        scalar.name == "profile" ? fields.profile
        : scalar.name == "inner_pressure"
            ? fields.inner_pressure
            : scalar.value - value_of(other.values, scalar.name).value_or(not_known);
    result.push_back(scalar.value == 0 ? not_known : difference / std::abs(scalar.value));
  }
  return result;
}

}  // namespace gnomon
