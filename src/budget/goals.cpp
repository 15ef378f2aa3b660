// What a run is made for, and how far two runs differ in it.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gnomon/budget/budget.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <gnomon/system/system.hpp>
#include <limits>

#include "budget/inner_contact.hpp"

namespace gnomon {

namespace {

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return (Eigen::Vector3d::Map(a.data()) - Eigen::Vector3d::Map(b.data())).norm();
}

double profile_norm(const ContactSurface& surface) {
  double sum = 0;
  for (std::size_t i = 0; i < surface.worn.size(); ++i)
    sum += std::pow(distance(surface.worn[i], surface.initial[i]), 2);
  return std::sqrt(sum);
}

/// Root mean square of a value of the nodes inside of the contact; none: 0.
double inner_norm(const std::vector<double>& values, const std::vector<std::size_t>& inner) {
  double sum = 0;
  for (const std::size_t i : inner) sum += std::pow(values[i], 2);
  return inner.empty() ? 0 : std::sqrt(sum / static_cast<double>(inner.size()));
}

/// Norms of differences between fields, as those of the fields above.
struct FieldDifferences {
  double profile = 0, inner_pressure = 0;
};

FieldDifferences field_differences(const Goals& goals, const Goals& other) {
  const SurfaceDifference difference = surface_difference(goals.surface, other.surface);
  const Eigen::Map<const Eigen::VectorXd> distance(
      difference.distance.data(), static_cast<Eigen::Index>(difference.distance.size()));
  return {distance.norm(), inner_norm(difference.pressure, goals.inner)};
}

/// With the sizes of the elements at the surface.
void add_edges(const Grid& grid, const std::vector<std::vector<std::size_t>>& neighbours,
               Goals& goals) {
  const ContactSurface& surface = goals.surface;
  const std::vector<int> body_of = connected_bodies(grid);
  for (std::size_t i = 0; i < surface.node.size(); ++i) {
    goals.body.push_back(body_of[static_cast<std::size_t>(surface.node[i])]);
    double edge = std::numeric_limits<double>::infinity();
    for (const std::size_t j : neighbours[i])
      edge = std::min(edge, distance(surface.initial[i], surface.initial[j]));
    goals.edge.push_back(edge);
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
  const auto neighbours = budget::surface_neighbours(model.grid, goals.surface);
  goals.inner = budget::inner_nodes(goals.surface, neighbours);
  if (model.grid) add_edges(*model.grid, neighbours, goals);
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
  if (const auto bound = value_of(observed, "contact_area_error"); bound && !in_plane && size > 0)
    goals.area = (goals.surface.dim == 2 ? 0.5 : 0.25) * *bound / size;
  if (const auto force = value_of(observed, "contact_force"))
    goals.values.push_back({"mean_pressure", "MPa", size > 0 ? *force / size : 0});
  goals.values.push_back(
      {"inner_pressure", "MPa", inner_norm(goals.surface.pressure, goals.inner)});
  add("max_pressure");
  add("approach");
  return goals;
}

bool is_norm(const std::string& value) {
  return value == "profile" || value == "inner_pressure";
}

std::vector<double> differences(const Goals& goals, const Goals& other) {
  const FieldDifferences fields = field_differences(goals, other);
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
