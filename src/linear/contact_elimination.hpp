// The worn surface and the contact multipliers of a coupled Jacobian, eliminated node by node.
#pragma once

#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/factored_block.hpp"
#include "linear/low_rank_update.hpp"

namespace gnomon {

/// A linear solve J z = r in the unknowns u (displacements), l (contact multipliers) and c (shape
/// of the worn surface), where z = (du, dl, dc). Indices of J are rows and columns, K = J_uu, and B
/// = J_ul. The influence of c upon the rows of u, J_uc, is neglected, and of J_cc only the block of
/// each surface node counts, so that it is inverted node by node:
///
///   (u)   K du + B dl                  = r_u
///   (l)   J_lu du + J_lc dc + J_ll dl  = r_l
///   (c)   J_cu du + J_cc dc + J_cl dl  = r_c
///
/// 1. dc from (c), put into (l), with a = J_lc J_cc^-1:
///
///   (l')  C du - D dl = r_l - a r_c,     C = J_lu - a J_cu,     D = a J_cl - J_ll
///
/// 2. dl = D^-1 (C du - r_l + a r_c) from (l'), put into (u):
///
///   (u')  (K + B D^-1 C) du = r_u + B D^-1 (r_l - a r_c)
///
/// The caller solves (u') between condense(), which makes its right side, and recover(), which
/// gives dl and dc. A closed contact node is thus a spring on its displacements. Its compliance D
/// is the wear that its pressure makes within the step. An open node has B = 0 or C = 0, no spring.
///
/// Springs are added to K as s n n^T with n = C / |C| and s = C.B / D, which keeps K symmetric: B
/// is parallel to C but for friction. Where nothing wears, D = 0 (a rigid constraint); |D| is kept
/// so large that no spring is stiffer than ten times its node.
///
/// D is diagonal where every contact node has a surface node of its own. Contact nodes that share
/// one (all those on a line of a groove) wear together: D_ij = a_i . e_j for each pair of them,
/// with e_j = J_cl of node j. All e_j have nearly one direction m, so D is approximately a diagonal
/// matrix D_0 plus one of rank one, of which Sherman and Morrison give the inverse:
///
///   D = D_0 + a_m e_m^T,                    a_m = (a_i . m)_i,   e_m = (e_j . m)_j
///   D^-1 = D_0^-1 - gamma D_0^-1 a_m e_m^T D_0^-1,   gamma = 1 / (1 + e_m^T D_0^-1 a_m)
///
/// The diagonal part gives springs, the other a change of rank one per shared surface node,
/// -gamma (B D_0^-1 a_m) (e_m^T D_0^-1 C). Two sorts of changes are not in the matrix that is set
/// up but handed out by low_rank_terms(): these, and springs that have moved since the last set-up.
class ContactElimination {
public:
  /// `structure` must outlive the object. `follows_springs`: whether springs that move are handed
  /// out until the next set-up. Worthwhile with factors, because many columns cost less than a
  /// factorization; a set-up of multigrid costs as much as a few columns.
  ContactElimination(const Structure& structure, bool follows_springs);

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J);

  /// Set-up: adds the springs of the diagonal of D to `values` of K, and remembers them.
  void add_springs(const SymmetricPart& part, std::vector<double>& values);
  /// What the matrix of (u') has beyond K with the springs of add_springs().
  std::vector<RankOneTerm> low_rank_terms(const SymmetricPart& part) const;

  /// s holds r; s_u becomes the right side of (u'), s_l that of (l'); s_c stays.
  void condense(std::span<double> s);
  /// z_l and z_c from z_u. `s` must be as condense() left it; it is changed.
  void recover(std::span<double> s, std::span<double> z);

private:
  using Values = NodeValues;
  struct SurfaceNode {
    std::vector<int> closed;  ///< contact nodes upon it, in contact_
    double gamma = 0;         ///< as above
  };
  struct ContactNode {
    ContactEntries::OnSurface on;
    Values B = Values::Zero(), C = Values::Zero();
    double CB = 0;               ///< C.B; zero: open
    double D = 1;                ///< of D_0
    double a_m = 0, e_m = 0;     ///< of a shared surface node, else zero
    double own_stiffness = 0;    ///< of K at the node alone, along C
    double spring = 0;           ///< s of the J that is current
    double spring_at_setup = 0;  ///< s and n that add_springs() has added
    Values direction_at_setup = Values::Zero();
    bool has_moved = false;  ///< since then, so far that low_rank_terms() makes up for it
  };

  void update_contact(std::size_t c);
  void share_surfaces();
  void update_spring(ContactNode& node) const;
  void update_gamma(SurfaceNode& surface) const;
  void find_moved_springs();
  RankOneTerm moved_spring(int c, const SymmetricPart& part) const;
  RankOneTerm common_wear(int s, const SymmetricPart& part) const;
  void solve_D(std::vector<double>& r) const;

  const bool follows_springs_;
  std::span<const double> J_;
  ContactEntries entries_;
  std::vector<SurfaceNode> surface_;
  std::vector<ContactNode> contact_;  // by node of entries_
  std::vector<int> moved_;            // in contact_
  JacobianBlock wear_row_;
  FactoredBlock wear_block_;
  std::vector<double> work_;  // of contact_
};

}  // namespace gnomon
