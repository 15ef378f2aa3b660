#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/cycles/phase_mean.hpp>
#include <limits>

#include "run/guards.hpp"

namespace gnomon {

namespace {

/// Not only that of numbers beside zero.
bool has_worn(const Observation& last, const IntegratorSettings& settings) {
  constexpr double nothing = 1e-9;
  return value_of(last, "wear_depth").value_or(0) > nothing * settings.scale;
}

/// Where atol is that of the expected depth.
std::string tolerance_warning(const Observation& last, const IntegratorSettings& settings) {
  constexpr double much = 5;
  const double depth = value_of(last, "wear_depth").value_or(0);
  if (settings.step > 0 || !has_worn(last, settings) ||
      settings.atol != settings.rtol * settings.scale || settings.scale <= much * depth)
    return {};
  return fmt::format(
      "steps were allowed errors for a mean wear depth of {:.2g}, which was expected, and the "
      "largest depth is {:.2g}: integrator.atol = {:.1g} allows {:.2g} of that",
      settings.scale, depth, settings.rtol * depth, settings.rtol);
}

/// Of a difference of volumes that hardly differ.
std::string rounding_warning(const Observation& last, double invisible,
                             const IntegratorSettings& settings) {
  constexpr double most = 0.05;
  const double integral = value_of(last, "wear_integral").value_or(0),
               difference = std::abs(wear_difference(last).value_or(0));
  if (integral == 0 || !has_worn(last, settings) || difference > invisible ||
      difference <= most * std::abs(integral))
    return {};
  return fmt::format(
      "the worn volume of {:.3g} is lost in the rounding of the volume of the bodies; the wear "
      "integral, {:.3g}, is not",
      *value_of(last, "worn_volume"), integral);
}

/// Of a worn volume that differs from the wear integral.
std::string ledger_warning(const Observation& last) {
  const double volume = *value_of(last, "worn_volume"), integral = *value_of(last, "wear_integral");
  return fmt::format(
      "the worn volume is {:.3g}, the wear integral is {:.3g}: {}", volume, integral,
      volume > integral
          ? "the elements beside an end of the wearing surface may lose the step there, too, less "
            "where they are smaller; else the depth is wrong"
          : "contact may have reached a place where the surface cannot wear, the end of the "
            "contact zone or a held side; then pressures and shape are worthless");
}

}  // namespace

std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator,
                                      const IntegratorSettings& settings) {
  std::vector<std::string> warnings;
  if (chattering_nodes > 0 && integrator.is_explicit())
    warnings.push_back(
        fmt::format("{} contact nodes left contact twice or more: steps seem to exceed the "
                    "critical one of {} (gnomon stability)",
                    chattering_nodes, integrator.name));
  if (has_lost_wear(last, invisible)) warnings.push_back(ledger_warning(last));
  for (std::string text :
       {tolerance_warning(last, settings), rounding_warning(last, invisible, settings)})
    if (!text.empty()) warnings.push_back(std::move(text));
  return warnings;
}

std::string phase_warning(const PhaseError& at_start, double tolerance) {
  if (at_start.error <= tolerance) return {};
  return fmt::format(
      "the mean over {} has an error of about {:.1g}, more than the tolerance of {:g}, and so may "
      "the worn shape: more phases make it smaller (cycle.phases)",
      phases_text(at_start.phases), at_start.error, tolerance);
}

double invisible_volume(const std::optional<Grid>& grid, int dim) {
  if (!grid || grid->points.empty()) return 0;
  constexpr double sums = 100;  // many cells add their rounding errors
  std::array<double, 3> low = grid->points.front(), high = low;
  for (const auto& point : grid->points)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  const bool flat = grid->cell == Grid::Cell::quadrilateral;
  double volume = (high[0] - low[0]) * (high[1] - low[1]) * (flat ? 1 : high[2] - low[2]);
  if (flat && dim == 3) volume *= 2 * M_PI * high[0];
  return sums * std::numeric_limits<double>::epsilon() * volume;
}

bool has_lost_wear(const Observation& observed, double invisible) {
  constexpr double most =
      0.1;  // part of the integral; on the coarsest meshes a few hundredths differ
  const std::optional<double> difference = wear_difference(observed);
  if (!difference) return false;
  const double integral = *value_of(observed, "wear_integral");
  return !(std::abs(*difference) <= most * std::abs(integral) + invisible);
}

}  // namespace gnomon
