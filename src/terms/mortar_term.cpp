#include <algorithm>
#include <gnomon/terms/mortar_term.hpp>
#include <set>

#include "mesh/facet_table.hpp"
#include "terms/mortar_facet_matrix.hpp"

namespace gnomon {

template <int dim>
MortarTerm<dim>::MortarTerm(const MortarState<dim>& state, const Numbering& numbering)
    : state_(state),
      u_numbers_(numbering.nodal<dim>(state.u)),
      d_numbers_(numbering.nodal<dim>(state.d)),
      shape_is_unknown_(d_numbers_.size() > 0 && d_numbers_.maxCoeff() >= 0),
      contact_of_(state.mesh.nodes.size(), -1) {
  if (state.path)
    for (const auto& parts : state.path->before) {
      most_parts_ = std::max(most_parts_, parts.size());
      mixes_parts_ = mixes_parts_ || parts.size() != 1 || parts.front().factor != 1;
    }
  for (int c = 0; c < static_cast<int>(state.patches.size()); ++c) {
    contact_of_[static_cast<std::size_t>(state.patches[c].node)] = c;
    own_numbers_.push_back({numbering.number(state.lambda, c)});
    if (!state.path) continue;
    const MortarPath<dim>& path = *state.path;
    const auto add = [&](FieldId field, int components) {
      for (int i = 0; i < components; ++i)
        own_numbers_.back().push_back(numbering.number(field, c, i));
    };
    add(path.traction, dim);
    add(path.place, dim);
    add(path.lambda_before, 1);
    for (std::size_t k = 0; k < most_parts_; ++k)
      for (int i = 0; i < dim; ++i) {
        const auto& parts = path.before[c];
        own_numbers_.back().push_back(
            k < parts.size() ? numbering.number(parts[k].field, parts[k].row, i) : -1);
      }
  }
  if (state.path && state.path->creepage != FieldId::none)
    for (int i = 0; i < dim; ++i)
      creepage_numbers_.push_back(numbering.number(state.path->creepage, 0, i));
  if (state.path) spin_numbers_ = numbering.nodal<dim>(state.path->spin);
  for (std::size_t p = 0; state.mean_power != FieldId::none && p < state.pairs.size(); ++p)
    mean_numbers_.push_back(numbering.number(state.mean_power, static_cast<Eigen::Index>(p)));
  if (state.path && state.path->is_last)
    memory_numbers_ = numbering.nodal<dim>(state.path->memory.s);
  for (const MortarPair<dim>& pair : state.pairs) places_.emplace_back(pair, state.places);
  find_sides();
  find_facets();
}

template <int dim>
void MortarTerm<dim>::find_sides() {
  std::size_t switches = 0;
  for (int p = 0; p < static_cast<int>(state_.pairs.size()); ++p) {
    side_of_.emplace_back();
    for (const bool slave : {true, false})
      for (const auto& facet : slave ? state_.pairs[p].slave : state_.pairs[p].master)
        for (const int node : facet) {
          const auto number = static_cast<int>(sides_.size());
          if (!side_of_[p].try_emplace(node, number).second) continue;
          sides_.push_back({contact_of_[static_cast<std::size_t>(node)], p, slave, switches});
          switches += static_cast<std::size_t>(contact_switches(sides_.back())) +
                      law(sides_.back()).kinks();
        }
  }
}

template <int dim>
void MortarTerm<dim>::find_facets() {
  for (int p = 0; p < static_cast<int>(state_.pairs.size()); ++p) {
    const MortarPair<dim>& pair = state_.pairs[p];
    for (std::size_t f = 0; f < pair.slave.size(); ++f) {
      SlaveFacet facet{.pair = p, .masters = state_.candidates[p][f], .around = {}};
      std::set<int> around;
      for (int a = 0; a < corners; ++a) {
        const int node = pair.slave[f][a];
        facet.sides[a] = side_of(p, node);
        for (const auto& corner : state_.patches[contact_of_[node]].corners)
          for (const int k : corner.nodes)
            around.insert(state_.patches[contact_of_[node]].nodes[k]);
      }
      facet.around.assign(around.begin(), around.end());
      facets_.push_back(std::move(facet));
    }
  }
}

template <int dim>
std::vector<int> MortarTerm<dim>::numbers_of(const std::vector<int>& nodes, bool worn) const {
  std::vector<int> numbers;
  for (const int node : nodes)
    for (int i = 0; i < dim; ++i) numbers.push_back(u_numbers_(node, i));
  for (const int node : nodes) {
    const int c = contact_of_[static_cast<std::size_t>(node)];
    const bool has = !worn || (c >= 0 && state_.patches[c].may_move());
    for (int i = 0; i < dim; ++i) numbers.push_back(has ? d_numbers_(node, i) : -1);
  }
  return numbers;
}

template <int dim>
FacetNodes<dim> MortarTerm<dim>::nodes_of(const SlaveFacet& facet,
                                          const std::vector<int>& masters) const {
  return {state_.pairs[facet.pair], facet.around, masters,
          [&](int a) { return patch(sides_[facet.sides[a]]).node; }};
}

template <int dim>
std::vector<int> MortarTerm<dim>::rows_of(const SlaveFacet& facet,
                                          const FacetNodes<dim>& nodes) const {
  std::vector<int> rows;
  for (const int side : facet.sides) rows.push_back(lambda_number(sides_[side]));
  for (const int number : numbers_of(nodes.with_rows(), true)) rows.push_back(number);
  return rows;
}

template <int dim>
std::vector<int> MortarTerm<dim>::columns_of(const SlaveFacet& facet,
                                             const FacetNodes<dim>& nodes) const {
  std::vector<int> columns;
  for (const int side : facet.sides)
    for (const int number : own_numbers_[sides_[side].node]) columns.push_back(number);
  for (const int number : numbers_of(nodes.all, false)) columns.push_back(number);
  return columns;
}

/// What the multipliers of a facet touch, and to `nodes` the couplings of mesh nodes: rows of its
/// corners and masters. Masters that are too far apart to cover it at a time have none.
template <int dim>
void MortarTerm<dim>::declare_facet(const SlaveFacet& facet, PatternBuilder& pattern,
                                    PatternBuilder& nodes) const {
  const FacetNodes<dim> joined = nodes_of(facet, facet.masters);
  const auto masters_end = joined.all.begin() + std::ptrdiff_t(joined.rows);
  typename Mesh<dim>::Facet slave;
  std::copy_n(joined.all.begin(), corners, slave.begin());
  const std::vector<int> own(slave.begin(), slave.end());
  const std::vector<int> masters(joined.all.begin() + corners, masters_end);
  std::vector<int> constraints, own_columns;
  for (int a = 0; a < corners; ++a) {
    const Side& side = sides_[facet.sides[a]];
    const std::vector<int>& numbers = own_numbers_[side.node];
    pattern.add(numbers_of({slave[a]}, true), numbers);
    own_columns.insert(own_columns.end(), numbers.begin(), numbers.end());
    constraints.push_back(numbers.front());
    for (int i = 0; state_.path && i < dim; ++i) constraints.push_back(place_number(side, i));
  }
  pattern.add(constraints, numbers_of(joined.all, false));
  std::vector<int> spin;
  for (const int side : facet.sides)
    for (const int number : spin_number(sides_[side].node)) spin.push_back(number);
  for (const std::vector<int>& sums : {creepage_numbers_, spin, mean_number(facet.pair)}) {
    pattern.add(sums, own_columns);
    pattern.add(sums, numbers_of(joined.all, false));
  }
  pattern.add(numbers_of(masters, true), own_columns);
  nodes.add(own, joined.all);
  nodes.add(masters, own);
  nodes.add(masters, {masters_end, joined.all.end()});
  const MortarPair<dim>& pair = state_.pairs[facet.pair];
  const auto beside = masters_beside(pair, slave, facet.masters, state_.mesh.nodes);
  for (std::size_t k = 0; k < beside.size(); ++k) {
    const auto& master = pair.master[facet.masters[k]];
    std::vector<int> together;
    for (const int other : beside[k])
      together.insert(together.end(), pair.master[other].begin(), pair.master[other].end());
    sort_once(together);
    nodes.add({master.begin(), master.end()}, together);
  }
}

template <int dim>
void MortarTerm<dim>::declare_facets(PatternBuilder& pattern) const {
  PatternBuilder nodes(static_cast<int>(state_.mesh.nodes.size()));
  for (const SlaveFacet& facet : facets_) declare_facet(facet, pattern, nodes);
  const SparsePattern joined = nodes.build();
  for (int node = 0; node < joined.size(); ++node) {
    if (joined.column_start[node + 1] - joined.column_start[node] < 2) continue;  // not in contact
    const auto first = joined.row_index.begin();
    pattern.add(
        numbers_of({first + joined.column_start[node], first + joined.column_start[node + 1]},
                   true),
        numbers_of({node}, false));
  }
}

template <int dim>
void MortarTerm<dim>::declare(TermStructure& structure) const {
  declare_facets(structure.pattern);
  for (const Side& side : sides_) {
    const std::vector<int> rows = numbers_of({patch(side).node}, true);
    structure.pattern.add(rows, numbers_of(patch(side).nodes, false));
    structure.pattern.add(rows, mean_number(side.pair));
    if (side.slave && state_.path) declare_path(side, structure.pattern);
    declare_switches(patch(side).node, static_cast<std::size_t>(contact_switches(side)), law(side),
                     structure);
  }
  declare_times<dim>(state_.laws, {}, structure);
  if (!state_.path) return;
  for (const double t : state_.path->factor.breakpoints()) structure.breakpoints.push_back(t);
}

template <int dim>
void MortarTerm<dim>::map_to(const SparsePattern& pattern) {
  pattern_ = &pattern;
}

template <int dim>
void MortarTerm<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  const Surfaces result = surfaces(at);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    const SideState& state = result.sides[s];
    const ContactPatch<dim>& own = patch(side);
    const Vector<dim> force = place(side).turn.transpose() * state.force;
    for (int i = 0; i < dim; ++i) {
      if (const int row = u_numbers_(own.node, i); row >= 0) F[row] += force[i];
      if (const int row = d_numbers_(own.node, i); row >= 0 && state.direction)
        F[row] += weight(side) * state.rate.value * state.area * state.direction->value[i];
    }
    if (!side.slave) continue;
    for (std::size_t i = 0; i < creepage_numbers_.size(); ++i)
      if (const int row = creepage_numbers_[i]; row >= 0) F[row] += state.force[long(i)];
    const std::vector<int> spin = spin_number(side.node);
    for (std::size_t i = 0; i < spin.size(); ++i)
      if (spin[i] >= 0) F[spin[i]] += state_.path->arm[side.node] * state.force[long(i)];
    for (const int row : mean_number(side.pair))
      if (row >= 0) F[row] += mean_part(at, side, state).value;
    if (state_.path) add_path_residual(at, side, state, F);
    if (const int row = lambda_number(side); row >= 0)
      F[row] += holds_gap(state) ? state.gap / own.initial_area
                                 : -at.values.scalar(state_.lambda)[side.node] / state_.rho;
  }
}

template class MortarTerm<2>;
template class MortarTerm<3>;

}  // namespace gnomon
