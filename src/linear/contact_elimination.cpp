#include "linear/contact_elimination.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <numeric>

namespace gnomon {

void ContactElimination::NodeUnknowns::add(int number) {
  if (size == most) throw Error("a contact node with more than three displacements");
  data[size++] = number;
}

ContactElimination::ContactElimination(const Structure& structure, bool follows_springs)
    : structure_(structure),
      follows_springs_(follows_springs),
      wear_row_(structure, {Role::evolution}, {Role::stiffness, Role::multiplier}),
      wear_block_(structure, {Role::evolution}) {
  const auto& [group, pattern] = std::tie(structure.group, structure.pattern);
  const int groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<int> surface_of(groups, -1), contact_of(structure.size, -1);
  for (int i : unknowns_of(structure, {Role::evolution})) {
    if (surface_of[group[i]] < 0) {
      surface_of[group[i]] = static_cast<int>(surface_.size());
      surface_.emplace_back();
    }
    surface_[surface_of[group[i]]].unknowns.add(i);
  }
  for (int i : unknowns_of(structure, {Role::multiplier})) {
    contact_of[i] = static_cast<int>(contact_.size());
    contact_.emplace_back().multiplier = i;
  }
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int row = pattern.row_index[k], c = contact_of[row];
      if (c < 0) continue;
      // The pattern may have the displacements around; the gap contains those of the node.
      if (structure.role(j) == Role::stiffness && group[j] == group[row]) contact_[c].u.add(j);
      if (structure.role(j) == Role::evolution)
        contact_[c].candidates.push_back(surface_of[group[j]]);
    }
  work_.resize(contact_.size());
}

double ContactElimination::entry(int row, int column) const {
  const int position = structure_.pattern.find(row, column);
  return position < 0 ? 0 : J_[position];
}

void ContactElimination::update(std::span<const double> J) {
  J_ = J;
  for (SurfaceNode& node : surface_) update_surface(node);
  for (ContactNode& node : contact_) update_contact(node);
  share_surfaces();
  for (ContactNode& node : contact_) update_spring(node);
  for (SurfaceNode& node : surface_) update_gamma(node);
  find_moved_springs();
  wear_block_.factorize(J);
}

void ContactElimination::update_surface(SurfaceNode& node) const {
  const int n = node.unknowns.size;
  Square block = Square::Identity();
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < n; ++l) block(k, l) = entry(node.unknowns[k], node.unknowns[l]);
  node.inverse = block.inverse();
}

ContactElimination::Values ContactElimination::surface_row(int multiplier, int surface) const {
  const NodeUnknowns& c = surface_[surface].unknowns;
  Values row = Values::Zero();
  for (int k = 0; k < c.size; ++k) row[k] = entry(multiplier, c[k]);
  return row;
}

void ContactElimination::update_contact(ContactNode& node) const {
  const int l = node.multiplier, n = node.u.size;
  Square K = Square::Zero();
  for (int k = 0; k < n; ++k) {
    node.B[k] = entry(node.u[k], l);
    node.C[k] = entry(l, node.u[k]);
    for (int m = 0; m < n; ++m) K(k, m) = entry(node.u[k], node.u[m]);
  }
  node.D = -entry(l, l);  // share_surfaces() adds a J_cl
  node.a_m = node.e_m = 0;
  // The pattern of the row has the shape of all nodes around; the gap contains that of one, which
  // has nonzero entries.
  node.surface = -1;
  double largest = 0;
  for (int candidate : node.candidates)
    if (const double size = surface_row(l, candidate).norm(); size > largest) {
      largest = size;
      node.surface = candidate;
    }
  if (node.surface >= 0) {
    const NodeUnknowns& c = surface_[node.surface].unknowns;
    node.a = surface_[node.surface].inverse.transpose() * surface_row(l, node.surface);
    node.e = Values::Zero();
    for (int k = 0; k < c.size; ++k) {
      node.e[k] = entry(c[k], l);
      for (int m = 0; m < n; ++m) node.C[m] -= node.a[k] * entry(c[k], node.u[m]);
    }
  }
  node.CB = node.C.dot(node.B);
  node.own_stiffness = node.CB == 0 ? 0 : node.C.dot(K * node.C) / node.C.squaredNorm();
}

/// Completes D_0. A node that is alone on its surface node has its wear in D_0; closed nodes that
/// share one have theirs in a_m and e_m, along the mean direction m of what their pressures wear.
void ContactElimination::share_surfaces() {
  for (SurfaceNode& surface : surface_) surface.closed.clear();
  for (std::size_t c = 0; c < contact_.size(); ++c)
    if (contact_[c].surface >= 0 && contact_[c].CB != 0)
      surface_[contact_[c].surface].closed.push_back(static_cast<int>(c));
  for (SurfaceNode& surface : surface_) {
    if (surface.closed.size() < 2) {
      for (int c : surface.closed) contact_[c].D += contact_[c].a.dot(contact_[c].e);
      continue;
    }
    Values sum = Values::Zero();
    for (int c : surface.closed) sum += contact_[c].e;
    if (sum == Values::Zero()) continue;  // nothing wears
    const Values m = sum.stableNormalized();
    for (int c : surface.closed) {
      ContactNode& node = contact_[c];
      node.a_m = node.a.dot(m);
      node.e_m = node.e.dot(m);
    }
  }
}

void ContactElimination::update_spring(ContactNode& node) const {
  // Instead of a rigid constraint: a spring ten times as stiff as the node itself leaves the
  // preconditioned multipliers' spectrum within 10 % of one.
  constexpr double stiff = 10;
  node.spring = 0;
  if (node.CB == 0) {  // open
    if (node.D == 0) node.D = 1;
    return;
  }
  const double least = std::abs(node.CB) / (stiff * std::abs(node.own_stiffness));
  // Of the sign of C.B, so that the spring is positive and K with springs stays definite.
  node.D = std::copysign(std::max(std::copysign(1.0, node.CB) * node.D, least), node.CB);
  node.spring = node.CB / node.D;
}

void ContactElimination::update_gamma(SurfaceNode& surface) const {
  double sum = 1;
  for (int c : surface.closed) sum += contact_[c].e_m * contact_[c].a_m / contact_[c].D;
  surface.gamma = sum == 0 ? 0 : 1 / sum;
}

void ContactElimination::add_springs(const SymmetricPart& part, std::vector<double>& values) {
  moved_.clear();
  for (ContactNode& node : contact_) {
    node.spring_at_setup = node.spring;
    node.has_moved = false;
    if (node.spring == 0) continue;
    node.direction_at_setup = node.C.normalized();
    for (int k = 0; k < node.u.size; ++k)
      for (int m = 0; m <= k; ++m)
        values[part.find(node.u[k], node.u[m])] +=
            node.spring * node.direction_at_setup[k] * node.direction_at_setup[m];
  }
}

/// A preconditioner works with a spring that is wrong by half, or by little beside the node's own
/// stiffness. A spring that has moved once is followed exactly until the next set-up.
void ContactElimination::find_moved_springs() {
  if (!follows_springs_) return;
  for (std::size_t c = 0; c < contact_.size(); ++c) {
    ContactNode& node = contact_[c];
    const double change = std::abs(node.spring - node.spring_at_setup);
    if (node.has_moved || change <= 0.5 * std::max(node.spring, node.spring_at_setup) ||
        change <= 0.3 * node.own_stiffness)
      continue;
    if (node.spring_at_setup == 0) node.direction_at_setup = node.C.normalized();
    node.has_moved = true;
    moved_.push_back(static_cast<int>(c));
  }
}

namespace {

void append(SparseVector& vector, const SymmetricPart& part, int unknown, double value) {
  vector.index.push_back(part.number(unknown));
  vector.value.push_back(value);
}

}  // namespace

/// (s - s at the set-up) n n^T.
RankOneTerm ContactElimination::moved_spring(int c, const SymmetricPart& part) const {
  const ContactNode& node = contact_[c];
  RankOneTerm term{c, node.spring - node.spring_at_setup, {}, {}};
  for (int k = 0; k < node.u.size; ++k) append(term.u, part, node.u[k], node.direction_at_setup[k]);
  term.v = term.u;
  return term;
}

/// -gamma (B D_0^-1 a_m) (e_m^T D_0^-1 C) of a surface node, with B along C as in the springs. Its
/// first vector has length one: LowRankUpdate solves for its column again only when the vector has
/// turned, and a_m changes with every step. A factor of zero: nothing wears.
RankOneTerm ContactElimination::common_wear(int s, const SymmetricPart& part) const {
  RankOneTerm term{static_cast<int>(contact_.size()) + s, -surface_[s].gamma, {}, {}};
  for (int c : surface_[s].closed) {
    const ContactNode& node = contact_[c];
    const double B_by_C = node.CB / node.C.squaredNorm();
    const Values u = node.C * (B_by_C * node.a_m / node.D), v = node.C * (node.e_m / node.D);
    for (int k = 0; k < node.u.size; ++k) {
      append(term.u, part, node.u[k], u[k]);
      append(term.v, part, node.u[k], v[k]);
    }
  }
  const double length = std::sqrt(
      std::inner_product(term.u.value.begin(), term.u.value.end(), term.u.value.begin(), 0.0));
  if (length > 0)
    for (double& value : term.u.value) value /= length;
  term.k *= length;
  return term;
}

std::vector<RankOneTerm> ContactElimination::low_rank_terms(const SymmetricPart& part) const {
  std::vector<RankOneTerm> result;
  for (int c : moved_) result.push_back(moved_spring(c, part));
  for (std::size_t s = 0; s < surface_.size(); ++s) {
    if (surface_[s].closed.size() < 2) continue;
    RankOneTerm term = common_wear(static_cast<int>(s), part);
    if (term.k != 0) result.push_back(std::move(term));
  }
  return result;
}

/// r becomes D^-1 r, by the formula of Sherman and Morrison.
void ContactElimination::solve_D(std::vector<double>& r) const {
  for (std::size_t c = 0; c < contact_.size(); ++c) r[c] /= contact_[c].D;
  for (const SurfaceNode& surface : surface_) {
    double sum = 0;
    for (int c : surface.closed) sum += contact_[c].e_m * r[c];
    for (int c : surface.closed) r[c] -= surface.gamma * sum * contact_[c].a_m / contact_[c].D;
  }
}

void ContactElimination::condense(std::span<double> s) {
  for (std::size_t i = 0; i < contact_.size(); ++i) {
    const ContactNode& node = contact_[i];
    double& right = s[node.multiplier];
    if (node.surface >= 0) {
      const NodeUnknowns& c = surface_[node.surface].unknowns;
      for (int k = 0; k < c.size; ++k) right -= node.a[k] * s[c[k]];
    }
    work_[i] = right;
  }
  solve_D(work_);
  for (std::size_t i = 0; i < contact_.size(); ++i)
    for (int k = 0; k < contact_[i].u.size; ++k) s[contact_[i].u[k]] += contact_[i].B[k] * work_[i];
}

void ContactElimination::recover(std::span<double> s, std::span<double> z) {
  for (std::size_t i = 0; i < contact_.size(); ++i) {
    const ContactNode& node = contact_[i];
    work_[i] = -s[node.multiplier];
    for (int k = 0; k < node.u.size; ++k) work_[i] += node.C[k] * z[node.u[k]];
  }
  solve_D(work_);
  for (std::size_t i = 0; i < contact_.size(); ++i) z[contact_[i].multiplier] = work_[i];
  wear_row_.subtract(J_, z, s);
  wear_block_.solve(s, z);
}

}  // namespace gnomon
