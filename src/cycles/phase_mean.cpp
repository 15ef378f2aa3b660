#include <fmt/format.h>

#include <gnomon/cycles/phase_mean.hpp>
#include <limits>

namespace gnomon {

ChosenPhases choose_phases(double tolerance, const std::function<long(int times)>& count,
                           const std::function<double(int times)>& error) {
  for (int times = 1;; times *= 2) {
    const long phases = count(times);
    if (phases >= most_chosen_phases) return {phases, std::numeric_limits<double>::infinity()};
    const double found = error(times);
    if (found <= tolerance) return {phases, found};
  }
}

std::string phases_text(long count) {
  return fmt::format("{} phase{}", count, count == 1 ? "" : "s");
}

std::string remark_on_choice(const ChosenPhases& chosen, double tolerance) {
  const std::string why =
      std::isfinite(chosen.error)
          ? fmt::format("the mean over them has an error of about {:.1g}", chosen.error)
          : fmt::format(
                "the mean over fewer has an error of more than {:g}, and more are not tried",
                tolerance);
  return fmt::format("cycle.phases = \"auto\": {} phases, {}", chosen.count, why);
}

std::string remark_on_motion(double error, double tolerance, long phases, int parts) {
  if (!(error > tolerance)) return {};
  const std::string in_parts =
      parts > 0 ? fmt::format(" (the cycle has {} corners and reversals)", parts) : "";
  return fmt::format(
      "cycle.phases: the mean of speed or force over {} has an error of {:.2g} %{}; take more "
      "phases",
      phases_text(phases), 100 * error, in_parts);
}

}  // namespace gnomon
