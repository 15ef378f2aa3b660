#include "linear/phase_contact.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace gnomon {

namespace {

constexpr int most = ContactCompliance::most;

int owner_of(const Structure& structure, int unknown) {
  return structure.blocks[structure.block[unknown]].owner;
}

}  // namespace

PhaseContacts::PhaseContacts(const Structure& structure, std::size_t phases)
    : structure_(structure), phases_(phases) {
  const SparsePattern& pattern = structure.pattern;
  std::vector<int> surface_of;  // by group
  for (int i : unknowns_of(structure, {Role::evolution})) {
    const auto group = static_cast<std::size_t>(structure.group[i]);
    if (surface_of.size() <= group) surface_of.resize(group + 1, -1);
    if (surface_of[group] < 0) {
      surface_of[group] = static_cast<int>(surfaces_.size());
      surfaces_.emplace_back();
    }
    surfaces_[surface_of[group]].unknowns[structure.component[i]] = i;
  }
  for (int i : unknowns_of(structure, {Role::rigid})) phases_[owner_of(structure, i)].rigid = i;
  std::vector<PhaseContact::Node*> node_of(structure.size, nullptr);
  for (int i : unknowns_of(structure, {Role::multiplier}))
    phases_[owner_of(structure, i)].nodes.push_back({.multiplier = i});
  for (PhaseContact& phase : phases_)
    for (PhaseContact::Node& node : phase.nodes) node_of[node.multiplier] = &node;
  candidates_.resize(phases_.front().nodes.size());
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int row = pattern.row_index[k];
      PhaseContact::Node* node = node_of[row];
      if (!node) continue;
      // The pattern may have the displacements around; the gap contains those of the node.
      if (structure.role(j) == Role::stiffness && structure.group[j] == structure.group[row])
        node->u[structure.component[j]] = j;
      const PhaseContact& first = phases_.front();
      if (structure.role(j) != Role::evolution || owner_of(structure, row) != 0) continue;
      auto& candidates = candidates_[node - first.nodes.data()];
      const int surface = surface_of[structure.group[j]];
      if (candidates.empty() || candidates.back() != surface) candidates.push_back(surface);
    }
}

double PhaseContacts::entry(int row, int column) const {
  if (row < 0 || column < 0) return 0;
  const int position = structure_.pattern.find(row, column);
  return position < 0 ? 0 : J_[position];
}

void PhaseContacts::update(std::span<const double> J) {
  J_ = J;
  update_surfaces();
  std::vector<char> touches(phases_.front().nodes.size(), 0);
  for (PhaseContact& phase : phases_) {
    phase.closed.clear();
    for (std::size_t c = 0; c < phase.nodes.size(); ++c)
      if (is_closed(phase.nodes[c])) {
        phase.closed.push_back(closed_node(phase, static_cast<int>(c)));
        touches[c] = 1;
      }
  }
  touching_.clear();
  for (std::size_t c = 0; c < touches.size(); ++c)
    if (touches[c]) touching_.push_back(static_cast<int>(c));
  find_wear_directions();
  for (PhaseContact& phase : phases_)
    for (ClosedNode& node : phase.closed) project(phase, node);
}

void PhaseContacts::update_surfaces() {
  for (Surface& surface : surfaces_) {
    ContactCompliance::Square block = ContactCompliance::Square::Identity();
    for (int k = 0; k < most; ++k)
      for (int l = 0; l < most; ++l)
        if (surface.unknowns[k] >= 0 && surface.unknowns[l] >= 0)
          block(k, l) = entry(surface.unknowns[k], surface.unknowns[l]);
    surface.inverse = block.inverse();
  }
}

bool PhaseContacts::is_closed(const PhaseContact::Node& node) const {
  bool force = false, gap = false;
  for (int u : node.u) {
    force |= entry(u, node.multiplier) != 0;
    gap |= entry(node.multiplier, u) != 0;
  }
  return force && gap;
}

ClosedNode PhaseContacts::closed_node(const PhaseContact& phase, int number) const {
  const PhaseContact::Node& node = phase.nodes[number];
  ClosedNode closed{.node = number, .multiplier = node.multiplier};
  const int l = node.multiplier, w = phase.rigid;
  for (int k = 0; k < most; ++k) {
    closed.B[k] = entry(node.u[k], l);
    closed.L[k] = entry(l, node.u[k]);
    closed.uw[k] = entry(node.u[k], w);
    closed.wu[k] = entry(w, node.u[k]);
  }
  closed.ll = entry(l, l);
  closed.lw = entry(l, w);
  closed.wl = entry(w, l);
  // The pattern of the row has the shape of all nodes around; the gap contains that of one, which
  // has nonzero entries.
  double largest = 0;
  for (int candidate : candidates_[number]) {
    Values row;
    for (int k = 0; k < most; ++k) row[k] = entry(l, surfaces_[candidate].unknowns[k]);
    if (row.norm() <= largest) continue;
    largest = row.norm();
    closed.surface = candidate;
    closed.a = surfaces_[candidate].inverse.transpose() * row;
  }
  if (closed.surface < 0) return closed;
  for (int k = 0; k < most; ++k) closed.e[k] = entry(surfaces_[closed.surface].unknowns[k], l);
  return closed;
}

void PhaseContacts::find_wear_directions() {
  for (Surface& surface : surfaces_) surface.m.setZero();
  for (const PhaseContact& phase : phases_)
    for (const ClosedNode& node : phase.closed)
      if (node.surface >= 0) surfaces_[node.surface].m += node.e;
  for (Surface& surface : surfaces_)
    if (!surface.m.isZero(0)) surface.m.stableNormalize();
}

void PhaseContacts::project(const PhaseContact& phase, ClosedNode& node) const {
  if (node.surface < 0) return;
  const Surface& surface = surfaces_[node.surface];
  node.a_m = node.a.dot(surface.m);
  node.e_m = node.e.dot(surface.m);
  for (int k = 0; k < most; ++k) {
    const int c = surface.unknowns[k];
    node.cw_m += surface.m[k] * entry(c, phase.rigid);
    for (int i = 0; i < most; ++i)
      node.cu_m[i] += surface.m[k] * entry(c, phase.nodes[node.node].u[i]);
  }
}

double PhaseContacts::shape_part(const ClosedNode& node, std::span<const double> s) const {
  if (node.surface < 0) return 0;
  double sum = 0;
  for (int k = 0; k < most; ++k)
    if (const int c = surfaces_[node.surface].unknowns[k]; c >= 0) sum += node.a[k] * s[c];
  return sum;
}

}  // namespace gnomon
