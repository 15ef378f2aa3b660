#include <algorithm>
#include <array>
#include <gnomon/model/observation.hpp>
#include <string_view>

namespace gnomon {

namespace {

using O = Observation;

// Results of earlier versions have columns with these names, units and order.
constexpr std::array table = {
    Quantity{&O::contact_nodes, "contact_nodes", "", ""},
    Quantity{&O::contact_force, "contact_force", "N/mm", "N"},
    Quantity{&O::max_pressure, "max_pressure", "MPa", "MPa"},
    Quantity{&O::worn_volume, "worn_volume", "mm^2", "mm^3"},
    Quantity{&O::wear_flux, "wear_flux", "mm^2/s", "mm^3/s"},
    Quantity{&O::element_quality, "element_quality", "", ""},
    Quantity{&O::element_volume, "element_volume", "", ""},
    Quantity{&O::groove_section, "groove_section", "mm^2", "mm^2"},
    Quantity{&O::approach, "approach", "mm", "mm"},
    Quantity{&O::displacement_gradient, "displacement_gradient", "", ""},
    Quantity{&O::contact_half_width, "contact_half_width", "mm", "mm"},
    Quantity{&O::wear_integral, "wear_integral", "mm^2", "mm^3"},
};

bool tells_of_space(const Quantity& quantity, const std::string& unit) {
  return unit == quantity.unit_3d && unit != quantity.unit_2d;
}

}  // namespace

std::optional<double> Observation::wear_difference() const {
  if (!worn_volume || !wear_integral) return std::nullopt;
  return *worn_volume - *wear_integral;
}

std::span<const Quantity> quantities() {
  return table;
}

std::string unit_of(const Observation& observation, Quantity::Member member) {
  return std::ranges::find(table, member, &Quantity::member)->unit(observation.dim);
}

std::vector<Scalar> columns_of(const Observation& observation) {
  std::vector<Scalar> columns;
  for (const Quantity& quantity : table)
    if (const std::optional<double>& value = observation.*quantity.member)
      columns.push_back({quantity.name, quantity.unit(observation.dim), *value});
  columns.insert(columns.end(), observation.others.begin(), observation.others.end());
  return columns;
}

Observation observation_of(const std::vector<Scalar>& columns) {
  Observation observation;
  for (const Scalar& column : columns) {
    const auto quantity = std::ranges::find(table, std::string_view(column.name), &Quantity::name);
    if (quantity == table.end()) {
      observation.others.push_back(column);
      continue;
    }
    observation.*quantity->member = column.value;
    if (tells_of_space(*quantity, column.unit)) observation.dim = 3;
  }
  return observation;
}

}  // namespace gnomon
