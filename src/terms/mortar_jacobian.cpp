// What contact of pairs adds to J: by side, and by slave facet as a dense matrix.
#include <gnomon/terms/mortar_term.hpp>

#include "terms/mortar_facet_matrix.hpp"

namespace gnomon {

template <int dim>
void MortarTerm<dim>::add(const std::vector<int>& rows, const std::vector<int>& columns,
                          const Eigen::MatrixXd& K, std::span<double> values) const {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    if (columns[j] < 0) continue;
    int next = pattern_->column_start[columns[j]];  // rows of a node follow each other
    const int end = pattern_->column_start[columns[j] + 1];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double value = K(Eigen::Index(i), Eigen::Index(j));
      if (rows[i] < 0 || value == 0) continue;  // corners that are open have many
      const bool follows = next < end && pattern_->row_index[next] == rows[i];
      const int at = follows ? next : pattern_->find(rows[i], columns[j]);
      if (at < 0) continue;
      values[at] += value;
      next = at + 1;
    }
  }
}

template <int dim>
void MortarTerm<dim>::add(int row, int column, double value, std::span<double> values) const {
  if (row < 0 || column < 0) return;
  if (const int at = pattern_->find(row, column); at >= 0) values[at] += value;
}

/// What does not depend on the sums of single facets.
template <int dim>
void MortarTerm<dim>::add_side(const Evaluation<dim>& at, const Side& side, const SideState& state,
                               std::span<double> values) const {
  const ContactPatch<dim>& own = patch(side);
  if (side.slave && !holds_gap(state))
    add(lambda_number(side), lambda_number(side), -1 / state_.rho, values);
  const std::vector<int> mean = mean_number(side.pair);
  if (side.slave && !mean.empty())
    add(mean.front(), mean.front(), mean_part(at, side, state).by_mean, values);
  if (!state.direction) return;
  const Eigen::Index count = std::ssize(own.nodes);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(dim, 2 * count * dim);
  const double scale = weight(side) * state.area;
  const Vector<dim> along = scale * state.direction->value;
  for (Eigen::Index p = 0; p < count; ++p)
    K.template middleCols<dim>(dim * (count + p)) =
        scale * state.rate.value * state.direction->by_X[static_cast<std::size_t>(p)];
  K.template middleCols<dim>(dim * count) -=
      state.rate.by_depth * along * own.initial_normal.transpose();
  std::vector<int> rows;
  for (int i = 0; i < dim; ++i) rows.push_back(d_numbers_(own.node, i));
  add(rows, numbers_of(own.nodes, false), K, values);
  add(rows, mean, state.rate.by_mean_friction_power * along, values);
}

/// The contact and wear that depend on the sums of a facet.
template <int dim>
void MortarTerm<dim>::add_facet(const Evaluation<dim>& at, const SlaveFacet& facet,
                                const MortarFacetTangent<dim>& tangent,
                                const FacetMotion<dim>& motion, const Surfaces& state,
                                std::span<double> values) const {
  const FacetNodes<dim>& nodes = motion.nodes();
  const auto own = static_cast<int>(own_numbers_.front().size());
  FacetMatrix<dim> matrix(motion, tangent, own);
  for (int a = 0; a < corners; ++a) matrix.set_traction(a, state.sides[facet.sides[a]].traction);
  for (int a = 0; a < corners; ++a) {
    const Side& side = sides_[facet.sides[a]];
    const SideState& slave = state.sides[facet.sides[a]];
    if (slave.active) matrix.add_slave(a, patch(side).initial_area);
    if (slave.direction)
      matrix.add_slave_wear(a, weight(side) * slave.direction->value, slave.rate.value,
                            slave.rate_by_pressure, slave.rate_by_speed);
    if (mean_numbers_.empty()) continue;
    const MeanPart part = mean_part(at, side, slave);
    matrix.add_to_mean(a, part.by_area, part.by_pressure, part.by_speed);
  }
  for (std::size_t k = 0; k < tangent.facet.masters.size(); ++k)
    for (int b = 0; b < corners; ++b) {
      const int master = tangent.facet.masters[k].facet;
      add_master(facet, state, static_cast<int>(k), b,
                 side_of(facet.pair, state_.pairs[facet.pair].master[master][b]), matrix);
    }
  const std::vector<int> columns = columns_of(facet, nodes);
  add(rows_of(facet, nodes), columns, matrix.values(), values);
  if (!creepage_numbers_.empty()) add(creepage_numbers_, columns, matrix.force_on_slave(), values);
  for (int a = 0; spin_numbers_.size() > 0 && a < corners; ++a) {
    const int node = sides_[facet.sides[a]].node;
    add(spin_number(node), columns, state_.path->arm[node] * matrix.force_on(a), values);
  }
  add(mean_number(facet.pair), columns, matrix.mean(), values);
}

/// The place of each corner on its partner: the mean of where the masters' nodes are undeformed,
/// over the whole area of the corner that is covered.
template <int dim>
void MortarTerm<dim>::add_places(const Evaluation<dim>& at, const SlaveFacet& facet,
                                 const MortarFacetTangent<dim>& tangent,
                                 const FacetMotion<dim>& motion, const Surfaces& state,
                                 std::span<double> values) const {
  using Tangent = MortarFacetTangent<dim>;
  const FacetNodes<dim>& nodes = motion.nodes();
  std::vector<FacetNodal<dim>> labels;
  for (const auto& master : tangent.facet.masters)
    labels.push_back(labels_of(at, facet.pair, master.facet));
  // By the inputs of the tangent first: these are fewer sums than it has.
  Eigen::MatrixXd by_input = Eigen::MatrixXd::Zero(dim * corners, tangent.by_input.cols());
  std::vector<int> rows;
  for (int a = 0; a < corners; ++a) {
    const SideState& slave = state.sides[facet.sides[a]];
    for (int i = 0; i < dim; ++i) rows.push_back(place_number(sides_[facet.sides[a]], i));
    if (!(slave.area > 0)) continue;
    auto of_corner = by_input.middleRows(dim * a, dim);
    of_corner += slave.covering / (slave.area * slave.area) * tangent.by_input.row(a);
    for (std::size_t k = 0; k < labels.size(); ++k)
      for (int b = 0; b < corners; ++b)
        of_corner -= labels[k].row(b).transpose() / slave.area *
                     tangent.by_input.row(Tangent::row_of_M(static_cast<int>(k), a, b));
  }
  Eigen::MatrixXd K = motion.by_nodes(by_input);
  const Eigen::Index by_d = K.cols() / 2;
  for (int a = 0; a < corners; ++a)
    for (std::size_t k = 0; k < labels.size(); ++k)
      for (int b = 0; b < corners; ++b)
        if (const double area = state.sides[facet.sides[a]].area; area > 0)
          K.template block<dim, dim>(dim * a, by_d + dim * nodes.masters[k][b]) -=
              tangent.facet.masters[k].M(a, b) / area * Tensor<dim>::Identity();
  add(rows, numbers_of(nodes.all, false), K, values);
}

template <int dim>
void MortarTerm<dim>::add_master(const SlaveFacet& facet, const Surfaces& at, int master, int b,
                                 int side, FacetMatrix<dim>& matrix) const {
  const SideState& state = at.sides[side];
  for (int a = 0; a < corners; ++a) {
    const SideState& slave = at.sides[facet.sides[a]];
    if (slave.active) matrix.add_pressing(a, master, b);
    if (!state.direction) continue;
    // d(Wdot C) by the area, load, power and contact that the slave's corner shares with it.
    const double by_power = state.rate_by_speed / state.pressure(),
                 by_load = state.rate_by_pressure - by_power * state.speed(),
                 by_touching = state.rate.by_contact_share,
                 by_area = state.rate.value - state.pressure() * state.rate_by_pressure -
                           state.contact_share() * by_touching;
    const MortarTraction<dim>& of = slave.traction;
    const double by_pressure = by_load + by_power * of.speed;
    const Vector<dim> direction = weight(sides_[side]) * state.direction->value;
    matrix.add_master_wear(a, master, b, direction,
                           by_area + of.pressure * by_pressure + slave.share.value * by_touching);
    matrix.add_master_wear_by_traction(a, master, b, direction,
                                       by_pressure + by_touching * slave.share.by_pressure,
                                       by_power * of.pressure);
  }
}

/// Whether forces or wear depend on the sums of a facet: not where it is open and shares nothing
/// with what wears.
template <int dim>
bool MortarTerm<dim>::acts(const SlaveFacet& facet, const MortarFacet<dim>& sums,
                           const Surfaces& at) const {
  if (!mean_numbers_.empty()) return !sums.masters.empty();
  const auto is_loaded = [&](int side) {
    return at.sides[side].active || at.sides[side].direction;
  };
  return std::ranges::any_of(sums.masters, [&](const auto& covering) {
    return std::ranges::any_of(facet.sides, is_loaded) ||
           std::ranges::any_of(state_.pairs[facet.pair].master[covering.facet],
                               [&](int node) { return is_loaded(side_of(facet.pair, node)); });
  });
}

template <int dim>
void MortarTerm<dim>::add_jacobian(const Evaluation<dim>& at, double rate_weight,
                                   std::span<double> values) const {
  const Surfaces result = surfaces(at);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    add_side(at, sides_[s], result.sides[s], values);
    if (state_.path && sides_[s].slave)
      add_path(at, sides_[s], result.sides[s], rate_weight, values);
  }
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const MortarFacet<dim>& sums = (*result.facets)[f];
    const bool has_places = state_.path && !sums.masters.empty(),
               has_forces = acts(facets_[f], sums, result);
    if (!has_places && !has_forces) continue;
    // One after the other: in space each is large.
    const auto [slave, masters] = places_of(facets_[f], at, result);
    const MortarFacetTangent<dim> tangent(slave, masters, facets_[f].masters, state_.section,
                                          state_.pairs[facets_[f].pair].reach);
    std::vector<int> covering;
    for (const auto& master : tangent.facet.masters) covering.push_back(master.facet);
    const FacetNodes<dim> nodes = nodes_of(facets_[f], covering);
    FacetMotion<dim> motion(nodes, places_[facets_[f].pair]);
    for (int a = 0; a < corners; ++a) {
      const int side = facets_[f].sides[a];
      motion.set_normal(a, patch(sides_[side]), *result.sides[side].normal);
    }
    if (has_places) add_places(at, facets_[f], tangent, motion, result, values);
    if (has_forces) add_facet(at, facets_[f], tangent, motion, result, values);
  }
}

template void MortarTerm<2>::add(const std::vector<int>&, const std::vector<int>&,
                                 const Eigen::MatrixXd&, std::span<double>) const;
template void MortarTerm<2>::add(int, int, double, std::span<double>) const;
template void MortarTerm<2>::add_jacobian(const Evaluation<2>&, double, std::span<double>) const;
template void MortarTerm<3>::add(const std::vector<int>&, const std::vector<int>&,
                                 const Eigen::MatrixXd&, std::span<double>) const;
template void MortarTerm<3>::add(int, int, double, std::span<double>) const;
template void MortarTerm<3>::add_jacobian(const Evaluation<3>&, double, std::span<double>) const;

}  // namespace gnomon
