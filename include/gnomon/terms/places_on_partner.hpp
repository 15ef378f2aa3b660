// Contact terms whose friction may stick: where the nodes are on their partner, and were before.
#pragma once

#include <gnomon/laws/friction_factor.hpp>
#include <gnomon/terms/slip_memory.hpp>
#include <vector>

namespace gnomon {

/// A row of a nodal field, times a factor.
struct PartOfPlace {
  FieldId field;
  Eigen::Index row;
  double factor = 1;
};

/// What friction that may stick adds to a contact state: a phase of a path, or steady rolling.
/// Fields are those at the contact nodes.
template <int dim>
struct StickingFriction {
  FieldId traction = FieldId::none;  ///< lambda_T
  /// Of each contact node, the sum of these without `passed` is r before, in the first phase s; in
  /// later ones beside a rigid partner u before; in rolling that upstream. None: it has no
  /// friction.
  std::vector<std::vector<PartOfPlace>> before{};
  /// By contact node: in rolling, how far the partner is passed by since. Empty: none [length].
  NodalField<dim> passed{};
  /// Of the phase before, of the first one that of the last; in rolling, where the pressure does
  /// not change, that of the state.
  FieldId lambda_before = FieldId::none;
  SlipMemory memory{};
  bool is_last = false;            ///< of its path: it has the rows of s
  double rho = 1;                  ///< of lambda_T [stress / length]
  std::vector<double> interval{};  ///< of each contact node, since the place before [time]
  /// Of the interval in the part of the mean over the cycle that the phase stands for: wear rates
  /// are those over the interval times this.
  double share = 1;
  FrictionFactor factor{};  ///< of the coefficients of friction; of pairs by the slave
};

template <int dim>
class PlacesOnPartner {
public:
  virtual ~PlacesOnPartner() = default;
  /// r of every contact node, contact nodes x dim [length].
  virtual NodalField<dim> places(const Evaluation<dim>& at) const = 0;
};

}  // namespace gnomon
