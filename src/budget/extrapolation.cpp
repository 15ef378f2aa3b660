#include "budget/extrapolation.hpp"

#include <algorithm>
#include <cmath>

#include "budget/trial.hpp"

namespace gnomon::budget {

void require_refined_contact(const Goals& one, const Goals& other) {
  constexpr double clearly = 1.25;
  const bool is_finer = one.nodes > other.nodes;
  const auto fine = static_cast<double>(touching_nodes(is_finer ? one : other)),
             coarse = static_cast<double>(touching_nodes(is_finer ? other : one));
  if (fine < clearly * coarse)
    throw MeshUnchanged(
        "about as many nodes touch on elements of another size: the geometry fixes them, or there "
        "are too few");
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

Extrapolated extrapolated(double fine, double coarse) {
  constexpr double least = 0.5, most = 2;
  const double difference =
      std::isnan(coarse) ? std::abs(fine) : std::max(std::abs(fine), std::abs(coarse) / 8);
  const double observed = std::log2(coarse / fine);  // not a number where the signs differ
  const double order = observed >= least && observed <= most ? observed : usual_order;
  return {difference / (std::exp2(order) - 1), order};
}

}  // namespace gnomon::budget
