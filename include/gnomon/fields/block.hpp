// What solvers know of unknowns: the block that each belongs to, and the role of the block.
#pragma once

#include <string>

namespace gnomon {

/// What a block of unknowns is to a solver that treats the blocks of J apart (docs/linear.md). What
/// it is to physics, its name says.
enum class Role : char {
  stiffness,   ///< nodal components with an elliptic, nearly symmetric block of their own
  multiplier,  ///< one condition for each node of the `stiffness` block with the same owner
  evolution,   ///< differential rows, coupled node by node; a compliance of the multipliers
  extension,   ///< elliptic like `stiffness`, driven by `evolution` alone
  reaction,    ///< follows from all other blocks; its own block of J is diagonal
  rigid        ///< a scalar that is coupled with many unknowns
};

/// A set of unknowns with one role: what `gnomon check` lists.
struct Block {
  std::string name;    ///< "displacement", "contact_multiplier", ...
  std::string symbol;  ///< "u", "lambda", ...
  std::string where;   ///< "all nodes", "contact nodes", ...
  Role role = Role::stiffness;
  int owner = 0;  ///< the contact state or body that it belongs to
};

}  // namespace gnomon
