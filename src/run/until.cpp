#include "run/until.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>

namespace gnomon {

double excess(const Until& until, const Observation& observed) {
  std::vector<std::string> names;
  for (const Scalar& scalar : observed) {
    if (scalar.name == until.observation)
      return until.above ? scalar.value - until.value : until.value - scalar.value;
    names.push_back(scalar.name);
  }
  const std::string near = nearest_name(until.observation, names);
  throw InputError(
      fmt::format("{}: no observation is called {}, {}", until.where, until.observation,
                  near.empty() ? fmt::format("expected one of {}", fmt::join(names, ", "))
                               : fmt::format("did you mean {}?", near)));
}

double part_until(double before, double after) {
  constexpr double shortly = 1e-3;
  const double part = before / (before - after);
  return part > 1 - shortly ? 1 : part + shortly / 2;
}

}  // namespace gnomon
