// The observations of a state: typed members, and the named columns for files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// A named number with its unit: one column of a history or summary.
struct Scalar {
  std::string name;
  std::string unit;
  double value = 0;
};

/// The observations of a state; each member is present if the model has it. Forces and volumes are
/// those of the whole body, and per unit thickness in 2D: their units depend on the dimension.
struct Observation {
  int dim = 2;  ///< 2 or 3; 3 for a body of revolution, too

  std::optional<double> contact_nodes{};          ///< number of nodes in contact
  std::optional<double> contact_force{};          ///< integral of the pressure [N/mm | N]
  std::optional<double> max_pressure{};           ///< [MPa]
  std::optional<double> worn_volume{};            ///< volume that the shape has lost [mm^2 | mm^3]
  std::optional<double> wear_flux{};              ///< volume that wears per time [mm^2/s | mm^3/s]
  std::optional<double> element_quality{};        ///< least scaled Jacobian of the worn mesh
  std::optional<double> element_volume{};         ///< least, relative to the initial element
  std::optional<double> groove_section{};         ///< worn area of a groove's section [mm^2]
  std::optional<double> approach{};               ///< w, of the counter-body [mm]
  std::optional<double> displacement_gradient{};  ///< its largest norm, with small strains
  std::optional<double> contact_half_width{};     ///< [mm]
  /// Integral of wear_flux over the run [mm^2 | mm^3]; computed by the run loop, not by a model.
  std::optional<double> wear_integral{};
  std::optional<double> wear_depth{};  ///< largest of a contact node [mm]

  /// Observations of a single problem (the error against its exact solution), with names different
  /// from those above.
  std::vector<Scalar> others{};

  /// worn_volume minus wear_integral, if both are known: zero for a run that conserves volume.
  std::optional<double> wear_difference() const;
};

/// One member of Observation and its column.
struct Quantity {
  using Member = std::optional<double> Observation::*;
  Member member;
  const char* name;
  const char* unit_2d;
  const char* unit_3d;
  const char* meaning;  ///< a few words

  const char* unit(int dim) const { return dim == 2 ? unit_2d : unit_3d; }
};

/// All quantities, in the order of their columns.
std::span<const Quantity> quantities();
/// The unit of a member in this observation.
std::string unit_of(const Observation& observation, Quantity::Member member);

/// The columns of the present members: the quantities, then the others.
std::vector<Scalar> columns_of(const Observation& observation);
/// The observation from the columns of a file. Names that are not among quantities() go to
/// `others`; the dimension follows from the units.
Observation observation_of(const std::vector<Scalar>& columns);

}  // namespace gnomon
