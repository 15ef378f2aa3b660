// What friction that may stick adds to contact of pairs: rows of lambda_T, r and s, and of q_mean.
#include <gnomon/terms/mortar_term.hpp>

namespace gnomon {

template <int dim>
FacetNodal<dim> MortarTerm<dim>::labels_of(const Evaluation<dim>& at, int pair, int master) const {
  FacetNodal<dim> labels;
  for (int b = 0; b < corners; ++b)
    labels.row(b) = undeformed(at, state_.pairs[pair].master[master][b]).transpose();
  return labels;
}

template <int dim>
Vector<dim> MortarTerm<dim>::before(const Evaluation<dim>& at, int contact_node) const {
  Vector<dim> sum = Vector<dim>::Zero();
  for (const PartOfPlace& part : state_.path->before[contact_node])
    sum += part.factor * at.values.vector(part.field).row(part.row).transpose();
  if (state_.path->passed.size() > 0) sum -= state_.path->passed.row(contact_node).transpose();
  return sum;
}

template <int dim>
Eigen::MatrixXd MortarTerm<dim>::by_parts(int contact_node, const Eigen::MatrixXd& by_own) const {
  const auto& parts = state_.path->before[contact_node];
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(by_own.rows(), before_0 + dim * static_cast<Eigen::Index>(most_parts_));
  result.leftCols(before_0) = by_own.leftCols(before_0);
  for (std::size_t k = 0; k < parts.size(); ++k)
    result.middleCols(before_0 + dim * static_cast<Eigen::Index>(k), dim) =
        parts[k].factor * by_own.rightCols(dim);
  return result;
}

template <int dim>
StickingParameters MortarTerm<dim>::sticking_parameters(const Evaluation<dim>& at,
                                                        const Side& side) const {
  const MortarPath<dim>& path = *state_.path;
  const auto factor = path.factor.at(path.factor.varies() ? depth(at, side) : 0, moment(at, side),
                                     initial_position_of<dim>(patch(side)));
  return {.friction = pair(side).friction * factor.value,
          .friction_by_depth = pair(side).friction * factor.by_depth,
          .rho = path.rho,
          .interval = path.interval[side.node],
          .rubs = !path.before[side.node].empty()};
}

template <int dim>
StickingInput<dim> MortarTerm<dim>::sticking_input(const Evaluation<dim>& at, const Side& side,
                                                   const Vector<dim>& normal) const {
  const MortarPath<dim>& path = *state_.path;
  const auto& places = places_[side.pair];
  return {.lambda = at.values.scalar(state_.lambda)[side.node],
          .traction = at.values.vector(path.traction).row(side.node).transpose(),
          .place = at.values.vector(path.place).row(side.node).transpose(),
          .lambda_before = at.values.scalar(path.lambda_before)[side.node],
          .before = before(at, side.node),
          .normal = normal,
          .turn = {places.of[0].turn, places.of[1].turn},
          .dropped = path.flat ? pair(side).approach : Vector<dim>::Zero()};
}

/// Whether a slave node slides, and its traction.
template <int dim>
void MortarTerm<dim>::find_sticking(const Evaluation<dim>& at, const Side& side,
                                    SideState& state) const {
  std::optional<bool> given;
  if (!at.branch.empty()) given = at.branch[side.first_switch + 1] != 0;
  state.sticking.emplace(sticking_parameters(at, side),
                         sticking_input(at, side, state.normal->value), holds_gap(state), given);
  state.traction = std::move(state.sticking->traction);
  if (!mixes_parts_) return;
  for (Eigen::RowVectorXd* by : {&state.traction.pressure_by_own, &state.traction.speed_by_own})
    *by = by_parts(side.node, *by);
  state.traction.by_own = by_parts(side.node, state.traction.by_own);
}

template <int dim>
std::optional<Vector<dim>> MortarTerm<dim>::place_on_partner(const Side& side,
                                                             const SideState& state) const {
  if (!(state.area > 0)) return {};
  return state.covering / state.area - state_.mesh.nodes[patch(side).node];
}

template <int dim>
NodalField<dim> MortarTerm<dim>::places(const Evaluation<dim>& at) const {
  const Surfaces result = surfaces(at);
  NodalField<dim> places(static_cast<Eigen::Index>(state_.patches.size()), dim);
  for (Eigen::Index c = 0; c < places.rows(); ++c)
    places.row(c) = before(at, static_cast<int>(c)).transpose();
  for (std::size_t s = 0; s < sides_.size(); ++s)
    if (const auto place = place_on_partner(sides_[s], result.sides[s]); sides_[s].slave && place)
      places.row(sides_[s].node) = place->transpose();
  return places;
}

template <int dim>
void MortarTerm<dim>::declare_path(const Side& side, PatternBuilder& pattern) const {
  const std::vector<int>& own = own_numbers_[side.node];
  std::vector<int> tractions, places;
  for (int i = 0; i < dim; ++i) {
    tractions.push_back(traction_number(side, i));
    places.push_back(place_number(side, i));
  }
  pattern.add(tractions, own);
  pattern.add(tractions, numbers_of(patch(side).nodes, false));
  for (int i = 0; i < dim; ++i) {
    pattern.add({places[i]}, {places[i]});
    for (std::size_t k = 0; k < most_parts_; ++k)
      pattern.add({places[i]}, {own[before_0 + dim * k + i]});
    if (!state_.path->is_last) continue;
    const int s = memory_numbers_(side.node, i);
    pattern.add({s}, {s, places[i]});
  }
}

template <int dim>
void MortarTerm<dim>::add_path_residual(const Evaluation<dim>& at, const Side& side,
                                        const SideState& state, std::span<double> F) const {
  const MortarPath<dim>& path = *state_.path;
  const StickingInput<dim> input = sticking_input(at, side, state.normal->value);
  const Vector<dim> place = place_on_partner(side, state).value_or(input.before);
  for (int i = 0; i < dim; ++i) {
    if (const int row = traction_number(side, i); row >= 0) F[row] += state.sticking->constraint[i];
    if (const int row = place_number(side, i); row >= 0) F[row] += input.place[i] - place[i];
    if (!path.is_last) continue;
    if (const int row = memory_numbers_(side.node, i); row >= 0)
      F[row] += path.memory.residual(at, side.node, i, row, input.place[i]);
  }
}

template <int dim>
void MortarTerm<dim>::add_path(const Evaluation<dim>& at, const Side& side, const SideState& state,
                               double rate_weight, std::span<double> values) const {
  const std::vector<int>& own = own_numbers_[side.node];
  const ContactPatch<dim>& of = patch(side);
  const StickingTraction<dim>& sticking = *state.sticking;
  std::vector<int> rows;
  for (int i = 0; i < dim; ++i) rows.push_back(traction_number(side, i));
  add(rows, own, by_parts(side.node, sticking.constraint_by_own), values);
  const auto count = static_cast<Eigen::Index>(of.nodes.size());
  Eigen::MatrixXd by_nodes(dim, 2 * count * dim);
  for (Eigen::Index p = 0; p < count; ++p) {
    const Tensor<dim> by = sticking.constraint_by_n *
                           state.normal->by_x[static_cast<std::size_t>(p)] * place(side).turn;
    by_nodes.middleCols(dim * p, dim) = by;
    by_nodes.middleCols(dim * (count + p), dim) = by;
  }
  by_nodes.middleCols(dim * count, dim) -=
      sticking.constraint_by_depth * of.initial_normal.transpose();
  add(rows, numbers_of(of.nodes, false), by_nodes, values);
  const SlipMemory& memory = state_.path->memory;
  for (int i = 0; i < dim; ++i) {
    const int r = place_number(side, i);
    add(r, r, 1, values);
    const auto& parts = state_.path->before[side.node];
    for (std::size_t k = 0; !(state.area > 0) && k < parts.size(); ++k)
      add(r, own[before_0 + dim * k + i], -parts[k].factor, values);
    if (!state_.path->is_last) continue;
    const int s = memory_numbers_(side.node, i);
    add(s, r, -1 / memory.period, values);
    add(s, s, memory.by_s(at, side.node, rate_weight), values);
  }
}

template <int dim>
double MortarTerm<dim>::mean_power(const Evaluation<dim>& at, const Side& side) const {
  return mean_numbers_.empty() ? 0 : at.values.scalar(state_.mean_power)[side.pair];
}

template <int dim>
typename MortarTerm<dim>::MeanPart MortarTerm<dim>::mean_part(const Evaluation<dim>& at,
                                                              const Side& side,
                                                              const SideState& state) const {
  const double mean = mean_power(at, side), rest = mean_of_nothing * patch(side).initial_area,
               f = pair(side).friction, p = state.traction.pressure, v = state.traction.speed,
               lacks = state.share.value * mean - f * p * v;
  return {.value = rest * mean + state.area * lacks,
          .by_mean = rest + state.touching,
          .by_area = lacks,
          .by_pressure = state.share.by_pressure * mean - f * v,
          .by_speed = -f * p};
}

template FacetNodal<2> MortarTerm<2>::labels_of(const Evaluation<2>&, int, int) const;
template double MortarTerm<2>::mean_power(const Evaluation<2>&, const Side&) const;
template MortarTerm<2>::MeanPart MortarTerm<2>::mean_part(const Evaluation<2>&, const Side&,
                                                          const SideState&) const;
template void MortarTerm<2>::find_sticking(const Evaluation<2>&, const Side&, SideState&) const;
template NodalField<2> MortarTerm<2>::places(const Evaluation<2>&) const;
template void MortarTerm<2>::declare_path(const Side&, PatternBuilder&) const;
template void MortarTerm<2>::add_path_residual(const Evaluation<2>&, const Side&, const SideState&,
                                               std::span<double>) const;
template void MortarTerm<2>::add_path(const Evaluation<2>&, const Side&, const SideState&, double,
                                      std::span<double>) const;
template FacetNodal<3> MortarTerm<3>::labels_of(const Evaluation<3>&, int, int) const;
template double MortarTerm<3>::mean_power(const Evaluation<3>&, const Side&) const;
template MortarTerm<3>::MeanPart MortarTerm<3>::mean_part(const Evaluation<3>&, const Side&,
                                                          const SideState&) const;
template void MortarTerm<3>::find_sticking(const Evaluation<3>&, const Side&, SideState&) const;
template NodalField<3> MortarTerm<3>::places(const Evaluation<3>&) const;
template void MortarTerm<3>::declare_path(const Side&, PatternBuilder&) const;
template void MortarTerm<3>::add_path_residual(const Evaluation<3>&, const Side&, const SideState&,
                                               std::span<double>) const;
template void MortarTerm<3>::add_path(const Evaluation<3>&, const Side&, const SideState&, double,
                                      std::span<double>) const;

}  // namespace gnomon
