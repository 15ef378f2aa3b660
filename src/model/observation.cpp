#include <algorithm>
#include <array>
#include <gnomon/model/observation.hpp>
#include <stdexcept>

namespace gnomon {

namespace {

struct Quantity {
  std::string_view name, unit_2d, unit_3d, meaning;
};

// Results of earlier versions have columns with these names and units.
constexpr std::array table = {
    Quantity{"contact_nodes", "", "", "contact nodes in contact"},
    Quantity{"contact_force", "N/mm", "N", "sum of area times pressure"},
    Quantity{"max_pressure", "MPa", "MPa", "largest pressure at a contact node"},
    Quantity{"worn_volume", "mm^2", "mm^3", "volume that the body has lost, from its geometry"},
    Quantity{"wear_flux", "mm^2/s", "mm^3/s", "sum of area times wear rate"},
    Quantity{"element_quality", "", "",
             "smallest scaled Jacobian of an element in the worn configuration"},
    Quantity{
        "element_volume", "", "",
        "smallest volume of an element in the worn configuration, divided by its initial volume"},
    Quantity{"groove_section", "mm^2", "mm^2", "worn section of a groove"},
    Quantity{"approach", "mm", "mm", "distance by which the counter-body has moved"},
    Quantity{"displacement_gradient", "", "",
             "largest norm of the displacement gradient at the centre of an element"},
    Quantity{"contact_half_width", "mm", "mm",
             "half the distance between the ends of the modelled contact"},
    Quantity{"wear_integral", "mm^2", "mm^3", "integral of the wear flux over time"},
    Quantity{"wear_difference", "mm^2", "mm^3", "worn volume minus wear integral"},
    Quantity{"wear_depth", "mm", "mm", "largest depth of wear at a contact node"},
    Quantity{"thickness_left", "", "",
             "where wear is a gap: smallest part of the thickness of a body that wear has left"},
    Quantity{"friction_work", "N", "N mm", "work of friction in a cycle, where it may stick"},
    Quantity{"slip_path", "mm", "mm",
             "longest slip of a contact node in a cycle, while it touches"},
    Quantity{"stroke", "mm", "mm",
             "range over a cycle in which the partner moves along the contact"},
    Quantity{"friction_force", "N/mm", "N", "largest force along the contact in a cycle"},
    Quantity{"twist", "rad", "rad", "range over a cycle of the angle by which the partner turns"},
    Quantity{"friction_moment", "N", "N mm",
             "largest moment about the axis of the partner in a cycle"},
    Quantity{"friction_power", "N/s", "N mm/s", "power that friction dissipates in rolling"},
    Quantity{"stick_area", "mm", "mm^2",
             "area of contact that sticks, in a cycle in the whole of it"},
    Quantity{"contact_area", "mm", "mm^2",
             "area of contact along the worn surface, in 2D its width"},
    Quantity{"contact_area_error", "mm", "mm^2",
             "half of the elements that are in contact in part: by this contact_area is not known"},
};

}  // namespace

Scalar common(std::string_view name, double value, int dim) {
  const auto quantity = std::ranges::find(table, name, &Quantity::name);
  if (quantity == table.end())
    throw std::logic_error("no common scalar is called " + std::string(name));
  return {std::string(name), std::string(dim == 2 ? quantity->unit_2d : quantity->unit_3d), value};
}

std::string meaning_of(std::string_view name) {
  if (name.starts_with("force_") || name.starts_with("torque_"))
    return "what loads, supports or contact exert on the bodies";
  const auto of_body = [name](std::string_view quantity) { return name.starts_with(quantity); };
  if (of_body("worn_volume_"))
    return "volume that this body has lost, from its geometry; of a track along all of its path";
  if (of_body("wear_flux_")) return "sum of area times wear rate of this body";
  if (of_body("creepage_"))
    return "velocity of the body's material relative to the counter-body, of pairs of the first "
           "body's relative to the second's, by that of rolling";
  const auto quantity = std::ranges::find(table, name, &Quantity::name);
  return quantity == table.end() ? std::string() : std::string(quantity->meaning);
}

const Scalar* find_scalar(const Observation& observed, std::string_view name) {
  const auto found = std::ranges::find(observed, name, &Scalar::name);
  return found == observed.end() ? nullptr : &*found;
}

std::optional<double> value_of(const Observation& observed, std::string_view name) {
  const Scalar* const found = find_scalar(observed, name);
  return found ? std::optional(found->value) : std::nullopt;
}

int dimension_of(const Observation& observed) {
  const Scalar* const worn = find_scalar(observed, "worn_volume");
  return worn && worn->unit == "mm^3" ? 3 : 2;
}

std::optional<double> wear_difference(const Observation& observed) {
  const auto worn = value_of(observed, "worn_volume"),
             integral = value_of(observed, "wear_integral");
  return worn && integral ? std::optional(*worn - *integral) : std::nullopt;
}

}  // namespace gnomon
