#include "linear/contact_entries.hpp"

#include <Eigen/LU>

namespace gnomon {

ContactEntries::ContactEntries(const Structure& structure) : structure_(structure) {
  std::vector<int> surface_of_group;
  find_surfaces(surface_of_group);
  find_nodes(surface_of_group);
  inverses_.resize(surfaces_.size());
}

void ContactEntries::find_surfaces(std::vector<int>& surface_of_group) {
  for (int i : unknowns_of(structure_, {Role::evolution})) {
    const auto group = static_cast<std::size_t>(structure_.group[i]);
    if (surface_of_group.size() <= group) surface_of_group.resize(group + 1, -1);
    if (surface_of_group[group] < 0) {
      surface_of_group[group] = static_cast<int>(surfaces_.size());
      surfaces_.push_back({-1, -1, -1});
    }
    surfaces_[surface_of_group[group]][structure_.component[i]] = i;
  }
}

void ContactEntries::find_nodes(const std::vector<int>& surface_of_group) {
  const SparsePattern& pattern = structure_.pattern;
  std::vector<int> node_of(structure_.size, -1), count;  // nodes, by contact state
  for (int i : unknowns_of(structure_, {Role::multiplier})) {
    const int state = structure_.blocks[structure_.block[i]].owner;
    if (count.size() <= static_cast<std::size_t>(state)) count.resize(state + 1, 0);
    node_of[i] = static_cast<int>(nodes_.size());
    nodes_.push_back({.multiplier = i, .state = state, .number = count[state]++});
  }
  if (!count.empty()) candidates_.resize(count.front());
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const int row = pattern.row_index[k];
      if (node_of[row] < 0) continue;
      Node& node = nodes_[node_of[row]];
      // The pattern may have the displacements around; the gap contains those of the node.
      if (structure_.role(j) == Role::stiffness && structure_.group[j] == structure_.group[row])
        node.u[structure_.component[j]] = j;
      if (structure_.role(j) != Role::evolution || node.state != nodes_.front().state) continue;
      std::vector<int>& candidates = candidates_[node.number];
      const int surface = surface_of_group[structure_.group[j]];
      if (candidates.empty() || candidates.back() != surface) candidates.push_back(surface);
    }
}

double ContactEntries::at(int row, int column) const {
  if (row < 0 || column < 0) return 0;
  const int position = structure_.pattern.find(row, column);
  return position < 0 ? 0 : J_[position];
}

void ContactEntries::update(std::span<const double> J) {
  J_ = J;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) inverses_[s] = inverse_at(surfaces_[s]);
}

NodeSquare ContactEntries::inverse_at(const NodeUnknowns& surface) const {
  NodeSquare block = NodeSquare::Identity();
  for (int k = 0; k < most_components; ++k)
    for (int l = 0; l < most_components; ++l)
      if (surface[k] >= 0 && surface[l] >= 0) block(k, l) = at(surface[k], surface[l]);
  return block.inverse();
}

ContactEntries::OnSurface ContactEntries::on_surface(const Node& node) const {
  // The pattern of the row has the shape of all nodes around; the gap contains that of one, which
  // has nonzero entries.
  OnSurface result;
  double largest = 0;
  NodeValues row;
  for (int candidate : candidates_[node.number]) {
    for (int k = 0; k < most_components; ++k) row[k] = at(node.multiplier, surfaces_[candidate][k]);
    if (row.norm() <= largest) continue;
    largest = row.norm();
    result.surface = candidate;
    result.a = inverses_[candidate].transpose() * row;
  }
  if (result.surface < 0) return result;
  for (int k = 0; k < most_components; ++k)
    result.e[k] = at(surfaces_[result.surface][k], node.multiplier);
  return result;
}

double ContactEntries::shape_part(const OnSurface& on, std::span<const double> s) const {
  return on.surface < 0 ? 0 : on.a.dot(values_at(surfaces_[on.surface], s));
}

}  // namespace gnomon
