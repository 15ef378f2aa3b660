#include <algorithm>
#include <array>
#include <gnomon/model/observation.hpp>
#include <string_view>

namespace gnomon {

namespace {

using O = Observation;

// Results of earlier versions have columns with these names, units and order.
constexpr std::array table = {
    Quantity{&O::contact_nodes, "contact_nodes", "", "", "contact nodes in contact"},
    Quantity{&O::contact_force, "contact_force", "N/mm", "N", "sum of area times pressure"},
    Quantity{&O::max_pressure, "max_pressure", "MPa", "MPa", "largest pressure at a contact node"},
    Quantity{&O::worn_volume, "worn_volume", "mm^2", "mm^3",
             "volume that the body has lost, from its geometry"},
    Quantity{&O::wear_flux, "wear_flux", "mm^2/s", "mm^3/s", "sum of area times wear rate"},
    Quantity{&O::element_quality, "element_quality", "", "",
             "smallest scaled Jacobian of an element in the worn configuration"},
    Quantity{
        &O::element_volume, "element_volume", "", "",
        "smallest volume of an element in the worn configuration, divided by its initial volume"},
    Quantity{&O::groove_section, "groove_section", "mm^2", "mm^2", "worn section of a groove"},
    Quantity{&O::approach, "approach", "mm", "mm", "distance by which the counter-body has moved"},
    Quantity{&O::displacement_gradient, "displacement_gradient", "", "",
             "largest norm of the displacement gradient at the centre of an element"},
    Quantity{&O::contact_half_width, "contact_half_width", "mm", "mm",
             "half the distance between the ends of contact"},
    Quantity{&O::wear_integral, "wear_integral", "mm^2", "mm^3",
             "integral of the wear flux over time"},
    Quantity{&O::wear_depth, "wear_depth", "mm", "mm", "largest depth of wear at a contact node"},
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
