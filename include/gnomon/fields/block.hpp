// The information that solvers have about unknowns: their blocks, and the roles of the blocks.
#pragma once

#include <string>

namespace gnomon {

/// What a solver that treats the blocks of J separately (docs/linear.md) has to know. An
/// `extension` moves the mesh. Whether a block is differential it says itself.
enum class Role : char {
  stiffness,   ///< nodal components whose diagonal block is elliptic and nearly symmetric
  multiplier,  ///< one condition for each node of the `stiffness` block with the same owner
  evolution,   ///< rows of the shape, coupled node by node; a compliance of the multipliers
  extension,   ///< elliptic like `stiffness`, driven by `evolution` alone
  reaction,    ///< follows from all other blocks; its own block of J is diagonal
  rigid,       ///< a scalar that is coupled with many unknowns
  friction,    ///< further conditions for each node of a `multiplier`, along the surface
  memory       ///< values at the nodes of `friction` that change once in a cycle
};

/// A set of unknowns that a physics declares, as listed by `gnomon check`.
struct Block {
  std::string name;    ///< "displacement", "contact_multiplier", ...
  std::string symbol;  ///< "u", "lambda", ...
  std::string where;   ///< "all nodes", "contact nodes", ...
  Role role = Role::stiffness;
  int owner = 0;               ///< the contact state or body that it belongs to
  bool differential = false;   ///< whether ydot of its unknowns enters F
  double tolerance_scale = 1;  ///< of a differential block: its absolute tolerance in units of that
                               ///< of the run
};

}  // namespace gnomon
