// What a run is made for, and how far two runs differ in it.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gnomon/budget/budget.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <gnomon/system/system.hpp>
#include <limits>
#include <optional>
#include <set>

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
  SurfaceDifference difference = surface_difference(goals.surface, other.surface);
  for (std::size_t i = 0; i < difference.pressure.size(); ++i) {
    const double own = goals.surface.pressure[i], others = own - difference.pressure[i];
    difference.pressure[i] = own * goals.pressure_by_ends - others * other.pressure_by_ends;
  }
  const Eigen::Map<const Eigen::VectorXd> distance(
      difference.distance.data(), static_cast<Eigen::Index>(difference.distance.size()));
  return {distance.norm(), inner_norm(difference.pressure, goals.inner)};
}

/// `size`: between the ends of the contact. Where it is not the sum of the shares of nodes but for
/// the last closed ones, as that of several patches, or pressures are means over a cycle, nothing
/// is known.
void add_edge_pressure(double size, const Observation& observed, Goals& goals) {
  constexpr double typical = 0.5;  // of what is open at most
  const auto area = value_of(observed, "contact_area"),
             bound = value_of(observed, "contact_area_error");
  if (!area || !bound || !(size > 0) || std::abs(*area - size) > *bound) return;
  if (!goals.surface.phase_weight.empty()) return;
  const double even = budget::reaches_edges(goals.surface, goals.inner),
               off = even * (*area / size - 1);
  goals.pressure_by_ends = 1 + off;
  goals.pressure_open = std::max(std::abs(off), typical * even * *bound / size);
}

/// Goals::peak_at_edge.
double peak_at_edge(const ContactSurface& surface,
                    const std::vector<std::vector<std::size_t>>& neighbours) {
  double inside = 0, most = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const bool is_inside =
        std::ranges::all_of(neighbours[i], [&](std::size_t j) { return surface.pressure[j] > 0; });
    most = std::max(most, surface.pressure[i]);
    if (is_inside) inside = std::max(inside, surface.pressure[i]);
  }
  return inside > 0 ? 1 - inside / most : 0;
}

/// Goals::depth_at_edge.
double depth_at_edge(const ContactSurface& surface,
                     const std::vector<std::vector<std::size_t>>& neighbours) {
  const auto deepest = std::ranges::max_element(surface.wear_depth);
  if (surface.dim != 2 || deepest == surface.wear_depth.end() || !(*deepest > 0)) return 0;
  const auto end = static_cast<std::size_t>(deepest - surface.wear_depth.begin());
  if (end >= neighbours.size() || neighbours[end].size() != 1) return 0;
  const std::size_t near = neighbours[end].front();
  const auto far = std::ranges::find_if(neighbours[near], [&](std::size_t j) { return j != end; });
  if (far == neighbours[near].end()) return 0;
  const double slope = (surface.wear_depth[near] - surface.wear_depth[*far]) /
                       distance(surface.initial[near], surface.initial[*far]);
  const double goes_on =
      surface.wear_depth[near] + slope * distance(surface.initial[end], surface.initial[near]);
  return std::max(0.0, 1 - std::max(goes_on, surface.wear_depth[near]) / *deepest);
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

bool is_of_friction(const std::string& value) {
  return value == "friction_work" || value == "friction_power" || value.starts_with("creepage_");
}

/// How many bodies touch.
std::size_t touching_bodies(const Goals& goals) {
  std::set<int> bodies;
  for (std::size_t i = 0; i < goals.body.size(); ++i)
    if (goals.surface.pressure[i] > 0) bodies.insert(goals.body[i]);
  return bodies.size();
}

/// Whether contact in the plane is one straight line, on each of the bodies, so that it is as long
/// as its ends are apart.
bool is_one_line(const Goals& goals, const std::vector<std::vector<std::size_t>>& neighbours) {
  constexpr double straight = 0.98;  // cosine
  const auto at = [&](std::size_t i) {
    return Eigen::Vector3d::Map(goals.surface.current[i].data());
  };
  const auto patches = budget::patches_of(goals.surface, neighbours);
  if (patches.size() > std::max<std::size_t>(1, touching_bodies(goals))) return false;
  for (std::size_t k = 0; !neighbours.empty() && k < patches.size(); ++k) {
    std::optional<Eigen::Vector3d> first;
    for (const std::size_t i : patches[k])
      for (const std::size_t j : neighbours[i]) {
        if (!(goals.surface.pressure[j] > 0)) continue;
        const Eigen::Vector3d along = (at(j) - at(i)).normalized();
        if (!first) first = along;
        if (std::abs(along.dot(*first)) < straight) return false;
      }
  }
  return true;
}

}  // namespace

long nodes_of(const Model& model) {
  return model.grid ? static_cast<long>(model.grid->points.size())
                    : model.system().structure().size;
}

std::optional<Goals> goals_of(const Model& model, const State& state, const Observation& observed) {
  constexpr double rounding = 1e-12;  // of creepages
  std::optional<ContactSurface> surface = model.contact(state);
  if (!surface || !find_scalar(observed, "worn_volume")) return {};
  Goals goals{.time = state.t,
              .nodes = nodes_of(model),
              .nonzeros = static_cast<double>(model.system().structure().pattern.nonzeros()),
              .values = {},
              .surface = std::move(*surface)};
  const auto neighbours = budget::surface_neighbours(model.grid, goals.surface);
  goals.inner = budget::inner_nodes(goals.surface, neighbours);
  goals.peak_at_edge = peak_at_edge(goals.surface, neighbours);
  if (model.grid) add_edges(*model.grid, neighbours, goals);
  if (touching_bodies(goals) > 1) {
    goals.depth_at_edge = depth_at_edge(goals.surface, neighbours);
    goals.inner = budget::without_edges(goals.surface, neighbours, goals.inner);
  }
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
  goals.by_ends = in_plane && is_one_line(goals, neighbours);
  const double size = goals.by_ends ? 2 * *half_width : area ? area->value : 0;
  if (const auto bound = value_of(observed, "contact_area_error");
      bound && size > 0 && (!goals.by_ends || !goals.surface.phase_weight.empty()))
    goals.area = (goals.surface.dim == 2 ? 0.5 : 0.25) * *bound / size;
  if (goals.by_ends) add_edge_pressure(size, observed, goals);
  if (const auto force = value_of(observed, "contact_force")) {
    goals.values.push_back({"mean_pressure", "MPa", size > 0 ? *force / size : 0});
    goals.values.push_back(
        {"inner_pressure", "MPa", inner_norm(goals.surface.pressure, goals.inner)});
  }
  add("max_pressure");
  add("approach");
  for (Scalar scalar : observed) {
    if (!is_of_friction(scalar.name)) continue;
    if (std::abs(scalar.value) < rounding) scalar.value = 0;
    goals.values.push_back(scalar);
  }
  return goals;
}

bool is_norm(const std::string& value) {
  return value == "profile" || value == "inner_pressure";
}

std::vector<double> differences(const Goals& goals, const Goals& other) {
  const FieldDifferences fields = field_differences(goals, other);
  std::vector<double> result;
  for (const Scalar& scalar : goals.values) {
    const bool unlike = (scalar.name == "mean_pressure" || scalar.name == "inner_pressure") &&
                        goals.by_ends != other.by_ends;
    const double difference =
        unlike                     ? not_known
        : scalar.name == "profile" ? fields.profile
        : scalar.name == "inner_pressure"
            ? fields.inner_pressure
            : scalar.value - value_of(other.values, scalar.name).value_or(not_known);
    result.push_back(scalar.value == 0 ? not_known : difference / std::abs(scalar.value));
  }
  return result;
}

}  // namespace gnomon
