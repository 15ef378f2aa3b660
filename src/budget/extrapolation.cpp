#include "budget/extrapolation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "budget/trial.hpp"

namespace gnomon::budget {

namespace {

/// The edge at the node of the same body that is nearest to a place; none: no number.
double edge_near(const std::array<double, 3>& place, int body, const Goals& goals) {
  double edge = not_known, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < goals.body.size(); ++k) {
    if (goals.body[k] != body) continue;
    const auto& node = goals.surface.initial[k];
    const double away = std::hypot(node[0] - place[0], node[1] - place[1], node[2] - place[2]);
    if (away < least) least = away, edge = goals.edge[k];
  }
  return edge;
}

/// Of the nodes that touch on the coarse mesh, those near which edges of the fine one are as long.
double part_as_coarse(const Goals& coarse, const Goals& fine) {
  constexpr double shorter = 0.8;
  double touching = 0, unrefined = 0;
  for (std::size_t i = 0; i < coarse.body.size(); ++i) {
    if (!(coarse.surface.pressure[i] > 0)) continue;
    const double edge = edge_near(coarse.surface.initial[i], coarse.body[i], fine);
    ++touching;
    unrefined += edge > shorter * coarse.edge[i];
  }
  return touching > 0 ? unrefined / touching : 0;
}

/// The order with which differences fall; not a number where it is unknown, or above 2.
double log_of_fall(double fine, double coarse) {
  constexpr double most = 2;
  const double observed = std::log2(coarse / fine);  // not a number where the signs differ
  return observed <= most ? observed : not_known;
}

/// Whether a value may be that of an edge of a body, where pressure may be singular.
bool is_of_edge(const std::string& value) {
  return value == "wear_depth" || value == "profile" || value == "max_pressure";
}

void add_doubt(const std::string& text, std::string& doubt) {
  doubt += (doubt.empty() ? "" : "; ") + text;
}

Extrapolated with_order(double fine, double coarse, double order) {
  const double difference =
      std::isnan(coarse) ? std::abs(fine) : std::max(std::abs(fine), std::abs(coarse) / 8);
  return {difference / (std::exp2(order) - 1), order};
}

}  // namespace

std::string why_not_refined(const Goals& one, const Goals& other) {
  constexpr double clearly = 1.25, most = 0.25;
  const auto& [coarse, fine] =
      one.nodes > other.nodes ? std::tie(other, one) : std::tie(one, other);
  if (static_cast<double>(touching_nodes(fine)) <
      clearly * static_cast<double>(touching_nodes(coarse)))
    return "about as many nodes touch on elements of another size: the geometry fixes them, or "
           "there are too few";
  if (part_as_coarse(coarse, fine) > most)
    return "elements of another size are as large in a part of the contact";
  return {};
}

void require_refined_contact(const Goals& one, const Goals& other) {
  if (const std::string why = why_not_refined(one, other); !why.empty()) throw MeshUnchanged(why);
}

std::vector<double> mesh_differences(const Goals& coarse, const Goals& fine) {
  std::vector<double> errors = differences(coarse, fine);
  if (std::ranges::none_of(errors, [](double error) { return std::isnan(error); })) return errors;
  const std::vector<double> other = differences(fine, coarse);
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (std::isnan(errors[i])) errors[i] = is_norm(coarse.values[i].name) ? other[i] : -other[i];
  return errors;
}

std::vector<double> errors_of_coarser(const Goals& coarse, const Goals& fine) {
  std::vector<double> errors = mesh_differences(coarse, fine);
  for (double& error : errors)
    error = extrapolated(error, not_known).error * std::exp2(usual_order);
  return errors;
}

void respect_area(const Goals& goals, std::vector<double>& errors) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (std::isnan(errors[i])) continue;
    const std::string& name = goals.values[i].name;
    if (name == "contact_area" || name == "contact_half_width" || name == "mean_pressure")
      errors[i] = std::max(std::abs(errors[i]), goals.area);
    if (name == "max_pressure") errors[i] = std::max(std::abs(errors[i]), goals.peak_at_edge);
    if (name == "wear_depth") errors[i] = std::max(std::abs(errors[i]), goals.depth_at_edge);
    if (name == "inner_pressure") errors[i] = std::abs(errors[i]) + goals.pressure_open;
  }
}

void respect_profile(const std::vector<Scalar>& values, std::vector<double>& errors) {
  const auto depth = std::ranges::find(values, "wear_depth", &Scalar::name),
             profile = std::ranges::find(values, "profile", &Scalar::name);
  if (depth == values.end() || profile == values.end()) return;
  double& error = errors[static_cast<std::size_t>(depth - values.begin())];
  const double least = errors[static_cast<std::size_t>(profile - values.begin())];
  if (std::abs(error) < least) error = least;
}

Extrapolated extrapolated(double fine, double coarse) {
  constexpr double least = 0.5;
  const double observed = log_of_fall(fine, coarse);
  return with_order(fine, coarse, observed >= least ? std::max(observed, 1.0) : usual_order);
}

Extrapolated extrapolated_at_edge(double fine, double coarse) {
  constexpr double least = 0.25, lowest = 0.5, small = 0.01;
  const double observed = log_of_fall(fine, coarse);
  if (std::isnan(observed) || std::abs(fine) < small) return extrapolated(fine, coarse);
  if (observed < least) return {not_known, not_known};
  return with_order(fine, coarse, std::max(observed, lowest));
}

void forget_without_value(const Goals& companion, const std::vector<Scalar>& values,
                          std::vector<double>& differences, std::string& doubt) {
  constexpr double nothing = 1e-3;  // of the value of the run
  std::vector<std::string> absent;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto other = value_of(companion.values, values[i].name);
    if (!other || !(std::abs(*other) < nothing * std::abs(values[i].value))) continue;
    differences[i] = not_known;
    absent.push_back(values[i].name);
  }
  if (!absent.empty())
    add_doubt(fmt::format("the companion with larger elements has nothing of {}, where the run has "
                          "some: the error is not known",
                          fmt::join(absent, ", ")),
              doubt);
}

void extrapolate(BudgetPart& part, const std::vector<Scalar>& values,
                 const std::vector<double>& fine, const std::vector<double>& coarse, double finer) {
  std::vector<std::string> growing;
  part.errors.clear();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto [error, order] = is_of_edge(values[i].name)
                                    ? extrapolated_at_edge(fine[i], coarse[i])
                                    : extrapolated(fine[i], coarse[i]);
    part.errors.push_back(error * std::pow(finer, -order));
    if (std::isnan(error) && !std::isnan(fine[i]))
      growing.push_back(fmt::format("{} (by {:.2g} %, then {:.2g} %)", values[i].name,
                                    100 * std::abs(coarse[i]), 100 * std::abs(fine[i])));
  }
  if (!growing.empty())
    add_doubt(
        fmt::format("the changes of {} from larger to smaller elements hardly fall: the error is "
                    "not known, and may be several times as large",
                    fmt::join(growing, ", ")),
        part.doubt);
}

void respect_run(const std::vector<double>& fine, const std::vector<double>& coarse, double times,
                 std::vector<double>& errors) {
  constexpr double safe = 3;
  for (std::size_t i = 0; times > 1 && i < errors.size(); ++i) {
    const double most =
        safe * std::max(std::abs(fine[i]) / (times - 1), std::abs(coarse[i]) / (2 * times - 1));
    if (!std::isnan(fine[i] + coarse[i]) && most < std::abs(errors[i])) errors[i] = most;
  }
}

}  // namespace gnomon::budget
