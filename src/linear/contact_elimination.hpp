// The worn surface and the contact multipliers of a coupled Jacobian, eliminated node by node.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "linear/contact_spring.hpp"
#include "linear/factored_block.hpp"

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
/// In contact with another deformable body l also presses nodes of that: B and C are vectors over
/// the node itself and these, and the spring joins the bodies.
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
  ContactElimination(const Structure& structure, bool follows_springs)
      : follows_springs_(follows_springs),
        entries_(structure),
        surface_(entries_.surfaces().size()),
        contact_(entries_.nodes().size()),
        wear_row_(structure, {Role::evolution}, {Role::stiffness, Role::multiplier}),
        wear_block_(structure, {Role::evolution}),
        work_(contact_.size()) {}

  /// Entries of K that springs need, as ContactEntries::joined().
  std::vector<std::vector<int>> joined() const { return entries_.joined(); }

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J) {
    entries_.update(J);
    for (std::size_t c = 0; c < contact_.size(); ++c) update_contact(c);
    share_surfaces();
    for (ContactSpring& node : contact_) node.set_spring();
    for (SurfaceNode& node : surface_) update_gamma(node);
    find_moved_springs();
    wear_row_.refresh(J);
    wear_block_.factorize(J);
  }

  /// Set-up: adds the springs of the diagonal of D to `values` of K, and remembers them.
  void add_springs(const SymmetricPart& part, std::vector<double>& values) {
    moved_.clear();
    for (ContactSpring& node : contact_) {
      node.spring_at_setup = node.spring;
      node.has_moved = false;
      if (node.spring == 0) continue;
      node.shares_at_setup = node.shares;
      const SparseVector n = node.direction_at_setup(part);
      for (std::size_t k = 0; k < n.index.size(); ++k)
        for (std::size_t m = 0; m < n.index.size(); ++m)
          if (n.index[k] >= n.index[m])
            values[part.lower().find(n.index[k], n.index[m])] +=
                node.spring * n.value[k] * n.value[m];
    }
  }

  /// What the matrix of (u') has beyond K with the springs of add_springs().
  std::vector<RankOneTerm> low_rank_terms(const SymmetricPart& part) const {
    std::vector<RankOneTerm> result;
    for (int c : moved_) result.push_back(moved_spring(c, part));
    for (std::size_t s = 0; s < surface_.size(); ++s) {
      if (surface_[s].closed.size() < 2) continue;
      RankOneTerm term = common_wear(static_cast<int>(s), part);
      if (term.k != 0) result.push_back(std::move(term));
    }
    return result;
  }

  /// s holds r; s_u becomes the right side of (u'), s_l that of (l'); s_c stays.
  void condense(std::span<double> s) {
    for (std::size_t i = 0; i < contact_.size(); ++i) {
      double& right = s[entries_.nodes()[i].multiplier];
      right -= entries_.shape_part(contact_[i].on, s);
      for (const auto& other : contact_[i].on_partners) right -= entries_.shape_part(other, s);
      work_[i] = right;
    }
    solve_D(work_);
    for (std::size_t i = 0; i < contact_.size(); ++i)
      for (const auto& [group, u, B, C] : contact_[i].shares)
        for (int k = 0; k < most_components; ++k)
          if (u[k] >= 0) s[u[k]] += B[k] * work_[i];
  }

  /// z_l and z_c from z_u. `s` must be as condense() left it; it is changed.
  void recover(std::span<double> s, std::span<double> z) {
    for (std::size_t i = 0; i < contact_.size(); ++i) {
      work_[i] = -s[entries_.nodes()[i].multiplier];
      for (const auto& [group, u, B, C] : contact_[i].shares) work_[i] += C.dot(values_at(u, z));
    }
    solve_D(work_);
    for (std::size_t i = 0; i < contact_.size(); ++i) z[entries_.nodes()[i].multiplier] = work_[i];
    wear_row_.subtract(z, s);
    wear_block_.solve(s, z);
  }

private:
  struct SurfaceNode {
    std::vector<int> closed;  ///< contact nodes upon it, in contact_
    double gamma = 0;         ///< as above
  };
  void update_contact(std::size_t c) {
    ContactSpring& node = contact_[c];
    const ContactEntries::Node& at = entries_.nodes()[c];
    node.shares = entries_.shares(at);
    node.D = -entries_.at(at.multiplier, at.multiplier);  // share_surfaces() adds a J_cl
    node.a_m = node.e_m = 0;
    node.on = entries_.on_surface(at);
    node.on_partners = entries_.on_partners(at);
    for (const auto& other : node.on_partners) node.D += other.a.dot(other.e);
    if (node.on.surface >= 0) {
      const NodeUnknowns& surface = entries_.surfaces()[node.on.surface];
      for (int k = 0; k < most_components; ++k)
        for (int m = 0; m < most_components; ++m)
          node.shares[0].C[m] -= node.on.a[k] * entries_.at(surface[k], at.u[m]);
    }
    node.CB = node.CC = 0;
    for (const auto& [group, u, B, C] : node.shares)
      node.CB += C.dot(B), node.CC += C.squaredNorm();
    node.own_stiffness = node.CB == 0 ? 0 : own_stiffness(node);
  }

  double own_stiffness(const ContactSpring& node) const {
    double sum = 0;
    for (const auto& [group, u, B, C] : node.shares)
      for (int k = 0; k < most_components; ++k)
        for (int m = 0; m < most_components; ++m) sum += C[k] * entries_.at(u[k], u[m]) * C[m];
    return sum / node.CC;
  }

  /// Completes D_0. A node that is alone on its surface node has its wear in D_0; closed nodes that
  /// share one have theirs in a_m and e_m, along the mean direction m of what their pressures wear.
  void share_surfaces() {
    for (SurfaceNode& surface : surface_) surface.closed.clear();
    for (std::size_t c = 0; c < contact_.size(); ++c)
      if (contact_[c].on.surface >= 0 && contact_[c].CB != 0)
        surface_[contact_[c].on.surface].closed.push_back(static_cast<int>(c));
    for (SurfaceNode& surface : surface_) {
      if (surface.closed.size() < 2) {
        for (int c : surface.closed) contact_[c].D += contact_[c].on.a.dot(contact_[c].on.e);
        continue;
      }
      NodeValues sum = NodeValues::Zero();
      for (int c : surface.closed) sum += contact_[c].on.e;
      if (sum == NodeValues::Zero()) continue;  // nothing wears
      const NodeValues m = sum.stableNormalized();
      for (int c : surface.closed) {
        ContactSpring& node = contact_[c];
        node.a_m = node.on.a.dot(m);
        node.e_m = node.on.e.dot(m);
      }
    }
  }

  void update_gamma(SurfaceNode& surface) const {
    double sum = 1;
    for (int c : surface.closed) sum += contact_[c].e_m * contact_[c].a_m / contact_[c].D;
    surface.gamma = sum == 0 ? 0 : 1 / sum;
  }

  /// A preconditioner works with a spring that is wrong by half, or by little beside the node's own
  /// stiffness. A spring that has moved once is followed exactly until the next set-up.
  void find_moved_springs() {
    if (!follows_springs_) return;
    for (std::size_t c = 0; c < contact_.size(); ++c) {
      ContactSpring& node = contact_[c];
      const double change = std::abs(node.spring - node.spring_at_setup);
      if (node.has_moved || change <= 0.5 * std::max(node.spring, node.spring_at_setup) ||
          change <= 0.3 * node.own_stiffness)
        continue;
      if (node.spring_at_setup == 0) node.shares_at_setup = node.shares;
      node.has_moved = true;
      moved_.push_back(static_cast<int>(c));
    }
  }

  /// (s - s at the set-up) n n^T.
  RankOneTerm moved_spring(int c, const SymmetricPart& part) const {
    const ContactSpring& node = contact_[c];
    const SparseVector n = node.direction_at_setup(part);
    return {c, node.spring - node.spring_at_setup, n, n};
  }

  /// -gamma (B D_0^-1 a_m) (e_m^T D_0^-1 C) of a surface node, with B along C as in the springs.
  /// Its first vector has length one: LowRankUpdate solves for its column again only when the
  /// vector has turned, and a_m changes with every step. A factor of zero: nothing wears.
  RankOneTerm common_wear(int s, const SymmetricPart& part) const {
    RankOneTerm term{static_cast<int>(contact_.size()) + s, -surface_[s].gamma, {}, {}};
    for (int c : surface_[s].closed) {
      const ContactSpring& node = contact_[c];
      const double B_by_C = node.CB / node.CC;
      ContactSpring::append_C(term.u, part, node.shares, B_by_C * node.a_m / node.D);
      ContactSpring::append_C(term.v, part, node.shares, node.e_m / node.D);
    }
    const double length = std::sqrt(
        std::inner_product(term.u.value.begin(), term.u.value.end(), term.u.value.begin(), 0.0));
    if (length > 0)
      for (double& value : term.u.value) value /= length;
    term.k *= length;
    return term;
  }

  /// r becomes D^-1 r, by the formula of Sherman and Morrison.
  void solve_D(std::vector<double>& r) const {
    for (std::size_t c = 0; c < contact_.size(); ++c) r[c] /= contact_[c].D;
    for (const SurfaceNode& surface : surface_) {
      double sum = 0;
      for (int c : surface.closed) sum += contact_[c].e_m * r[c];
      for (int c : surface.closed) r[c] -= surface.gamma * sum * contact_[c].a_m / contact_[c].D;
    }
  }

  const bool follows_springs_;
  ContactEntries entries_;
  std::vector<SurfaceNode> surface_;
  std::vector<ContactSpring> contact_;  // by node of entries_
  std::vector<int> moved_;              // in contact_
  JacobianBlock wear_row_;
  FactoredBlock wear_block_;
  std::vector<double> work_;  // of contact_
};

}  // namespace gnomon
