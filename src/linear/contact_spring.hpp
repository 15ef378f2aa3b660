// A contact node that is eliminated: the spring that it leaves on the displacements.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/linear/jacobian_block.hpp>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/low_rank_update.hpp"

namespace gnomon {

/// Letters as in contact_elimination.hpp.
struct ContactSpring {
  ContactEntries::OnSurface on;
  std::vector<ContactEntries::OnSurface> on_partners;
  std::vector<ContactEntries::Share> shares;
  double CB = 0;               ///< C.B; zero: open
  double CC = 0;               ///< C.C
  double D = 1;                ///< of D_0
  double a_m = 0, e_m = 0;     ///< of a shared surface node, else zero
  double own_stiffness = 0;    ///< of K at the nodes alone, along C
  double spring = 0;           ///< s of the J that is current
  double spring_at_setup = 0;  ///< s and C that add_springs() has added
  std::vector<ContactEntries::Share> shares_at_setup;
  bool has_moved = false;  ///< since then, so far that low_rank_terms() makes up for it

  /// From D, of which this takes the sign and the least size.
  void set_spring() {
    // Instead of a rigid constraint: a spring ten times as stiff as the node itself leaves the
    // preconditioned multipliers' spectrum within 10 % of one.
    constexpr double stiff = 10;
    spring = 0;
    if (CB == 0) {  // open
      if (D == 0) D = 1;
      return;
    }
    const double least = std::abs(CB) / (stiff * std::abs(own_stiffness));
    // Of the sign of C.B, so that the spring is positive and K with springs stays definite.
    D = std::copysign(std::max(std::copysign(1.0, CB) * D, least), CB);
    spring = CB / D;
  }

  /// n of add_springs(), numbered as the block.
  SparseVector direction_at_setup(const SymmetricPart& part) const {
    double square = 0;
    for (const auto& [group, u, B, C] : shares_at_setup) square += C.squaredNorm();
    SparseVector n;
    append_C(n, part, shares_at_setup, 1 / std::sqrt(square));
    return n;
  }

  /// To a vector of the block: C times a factor.
  static void append_C(SparseVector& vector, const SymmetricPart& part,
                       const std::vector<ContactEntries::Share>& shares, double factor) {
    for (const auto& [group, u, B, C] : shares)
      for (int k = 0; k < most_components; ++k)
        if (u[k] >= 0) {
          vector.index.push_back(part.number(u[k]));
          vector.value.push_back(factor * C[k]);
        }
  }
};

}  // namespace gnomon
