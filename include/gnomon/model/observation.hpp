// The observations of a state: numbers with names, by which results, histories and time.until know
// them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// A named number with its unit: one column of a history or summary.
struct Scalar {
  std::string name;
  std::string unit;
  double value = 0;
};

/// The scalars of a state, in the order of their columns. Forces and volumes are those of the whole
/// body, and per unit thickness in 2D.
using Observation = std::vector<Scalar>;

/// A scalar that several physics observe, with its name, unit and meaning in the table of
/// observation.cpp. `dim`: 3 in space and of a body of revolution, where the unit may differ.
/// Throws std::logic_error if the table has no such name.
Scalar common(std::string_view name, double value, int dim = 2);
/// A few words; empty for what a single physics observes.
std::string meaning_of(std::string_view name);

/// Null where it is not observed.
const Scalar* find_scalar(const Observation& observed, std::string_view name);
std::optional<double> value_of(const Observation& observed, std::string_view name);
/// 3 if the volume that is worn is one in space, otherwise 2.
int dimension_of(const Observation& observed);
/// worn_volume minus wear_integral, if both are known: zero for a run that conserves volume.
std::optional<double> wear_difference(const Observation& observed);

}  // namespace gnomon
