#include "linear/contact_elimination.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gnomon/error.hpp>

namespace gnomon {

void ContactElimination::Numbers::add(int number) {
  if (size == most) throw Error("a contact node with more than three displacements");
  data[size++] = number;
}

ContactElimination::ContactElimination(const Structure& structure)
    : structure_(structure),
      wear_row_(structure, {UnknownKind::worn_surface},
                {UnknownKind::displacement, UnknownKind::contact_multiplier}),
      wear_block_(structure, {UnknownKind::worn_surface}) {
  const auto& [kind, group, pattern] = std::tie(structure.kind, structure.group, structure.pattern);
  const int groups = group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1;
  std::vector<int> surface_of(groups, -1), contact_of(structure.size, -1);
  for (int i : unknowns_of(structure, {UnknownKind::worn_surface})) {
    if (surface_of[group[i]] < 0) {
      surface_of[group[i]] = static_cast<int>(surface_.size());
      surface_.emplace_back();
    }
    surface_[surface_of[group[i]]].unknowns.add(i);
  }
  for (int i : unknowns_of(structure, {UnknownKind::contact_multiplier})) {
    contact_of[i] = static_cast<int>(contact_.size());
    contact_.emplace_back().multiplier = i;
  }
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int row = pattern.row_index[k], c = contact_of[row];
      if (c < 0) continue;
      // The pattern may hold the displacements around; the gap contains those of the node.
      if (kind[j] == UnknownKind::displacement && group[j] == group[row]) contact_[c].u.add(j);
      if (kind[j] == UnknownKind::worn_surface)
        contact_[c].candidates.push_back(surface_of[group[j]]);
    }
}

double ContactElimination::entry(int row, int column) const {
  const int position = structure_.pattern.find(row, column);
  return position < 0 ? 0 : J_[position];
}

void ContactElimination::update(std::span<const double> J) {
  J_ = J;
  for (SurfaceNode& node : surface_) update_surface(node);
  for (ContactNode& node : contact_) update_contact(node);
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
  const Numbers& c = surface_[surface].unknowns;
  Values row = Values::Zero();
  for (int k = 0; k < c.size; ++k) row[k] = entry(multiplier, c[k]);
  return row;
}

void ContactElimination::update_contact(ContactNode& node) const {
  // A spring ten times as stiff as the node itself leaves the preconditioned multipliers' spectrum
  // within 10 % of one.
  constexpr double stiff = 10;
  const int l = node.multiplier, n = node.u.size;
  Square K = Square::Zero();
  for (int k = 0; k < n; ++k) {
    node.B[k] = entry(node.u[k], l);
    node.C[k] = entry(l, node.u[k]);
    for (int m = 0; m < n; ++m) K(k, m) = entry(node.u[k], node.u[m]);
  }
  node.D = -entry(l, l);
  // The pattern of the row holds the shape of all nodes around; the gap contains one.
  node.surface = -1;
  double largest = 0;
  for (int candidate : node.candidates)
    if (const double size = surface_row(l, candidate).norm(); size > largest) {
      largest = size;
      node.surface = candidate;
    }
  if (node.surface >= 0) {
    const auto& [c, inverse] = surface_[node.surface];
    node.a = inverse.transpose() * surface_row(l, node.surface);
    for (int k = 0; k < c.size; ++k) {
      node.D += node.a[k] * entry(c[k], l);
      for (int m = 0; m < n; ++m) node.C[m] -= node.a[k] * entry(c[k], node.u[m]);
    }
  }
  node.spring = node.stiffness = 0;
  const double CB = node.C.dot(node.B);
  if (CB == 0) {  // open
    if (node.D == 0) node.D = 1;
    return;
  }
  node.stiffness = node.C.dot(K * node.C) / node.C.squaredNorm();
  const double least = std::abs(CB) / (stiff * node.stiffness);
  node.D = std::copysign(std::max(std::copysign(1.0, CB) * node.D, least), CB);
  node.spring = CB / node.D;
}

void ContactElimination::add_springs(const SymmetricPart& part, std::vector<double>& values) {
  followed_.clear();
  for (ContactNode& node : contact_) {
    node.spring_set = node.spring;
    node.followed = false;
    if (node.spring == 0) continue;
    node.direction = node.C.normalized();
    for (int k = 0; k < node.u.size; ++k)
      for (int m = 0; m <= k; ++m)
        values[part.find(node.u[k], node.u[m])] +=
            node.spring * node.direction[k] * node.direction[m];
  }
}

bool ContactElimination::ContactNode::moved() const {
  const double change = std::abs(spring - spring_set);
  return !followed && change > 0.5 * std::max(spring, spring_set) && change > 0.3 * stiffness;
}

long ContactElimination::moved_springs() const {
  return std::count_if(contact_.begin(), contact_.end(), std::mem_fn(&ContactNode::moved));
}

std::vector<SpringDirection> ContactElimination::follow_springs(const SymmetricPart& part) {
  std::vector<SpringDirection> result;
  for (std::size_t c = 0; c < contact_.size(); ++c) {
    ContactNode& node = contact_[c];
    if (!node.moved()) continue;
    if (node.spring_set == 0) node.direction = node.C.normalized();
    node.followed = true;
    followed_.push_back(static_cast<int>(c));
    SpringDirection& spring = result.emplace_back();
    for (int k = 0; k < node.u.size; ++k) spring.unknown[k] = part.number(node.u[k]);
    spring.v = node.direction;
  }
  return result;
}

Eigen::VectorXd ContactElimination::changes() const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(followed_.size()));
  for (std::size_t j = 0; j < followed_.size(); ++j)
    result[j] = contact_[followed_[j]].spring - contact_[followed_[j]].spring_set;
  return result;
}

void ContactElimination::condense(std::span<double> s) const {
  for (const ContactNode& node : contact_) {
    double& right = s[node.multiplier];
    if (node.surface >= 0) {
      const Numbers& c = surface_[node.surface].unknowns;
      for (int k = 0; k < c.size; ++k) right -= node.a[k] * s[c[k]];
    }
    for (int k = 0; k < node.u.size; ++k) s[node.u[k]] += node.B[k] * right / node.D;
  }
}

void ContactElimination::recover(std::span<double> s, std::span<double> z) {
  for (const ContactNode& node : contact_) {
    double left = -s[node.multiplier];
    for (int k = 0; k < node.u.size; ++k) left += node.C[k] * z[node.u[k]];
    z[node.multiplier] = left / node.D;
  }
  wear_row_.subtract(J_, z, s);
  wear_block_.solve(s, z);
}

}  // namespace gnomon
