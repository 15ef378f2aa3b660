#include "run/end_warnings.hpp"

#include <fmt/format.h>

#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/stability/stability.hpp>

#include "run/wear_integral.hpp"

namespace gnomon {

std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator) {
  std::vector<std::string> warnings;
  const auto explicit_method = [&] {
    const auto table = integrator.table({});
    return table && is_explicit(*table);
  };
  if (chattering_nodes > 0 && explicit_method())
    warnings.push_back(
        fmt::format("{} contact nodes left contact twice or more: steps seem to exceed the "
                    "critical one of {} (gnomon stability)",
                    chattering_nodes, integrator.name));
  if (has_lost_wear(last, invisible))
    warnings.push_back(fmt::format(
        "the worn volume is {:.3g}, the wear integral is {:.3g}: contact may have reached a place "
        "where the surface cannot wear, the end of the contact zone or a held side; then pressures "
        "and shape are worthless",
        *value_of(last, "worn_volume"), *value_of(last, "wear_integral")));
  return warnings;
}

std::string phase_warning(const PhaseError& at_start, double tolerance) {
  if (at_start.error <= tolerance) return {};
  return fmt::format(
      "the mean over {} has an error of about {:.1g}, more than {:g}, the tolerance of the steps, "
      "and "
      "so may the worn shape: more phases make it smaller (cycle.phases)",
      phases_text(at_start.phases), at_start.error, tolerance);
}

}  // namespace gnomon
