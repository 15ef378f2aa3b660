// What friction that may stick adds to contact of pairs: rows of lambda_T, r and s.
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
StickingInput<dim> MortarTerm<dim>::sticking_input(const Evaluation<dim>& at, const Side& side,
                                                   const Vector<dim>& normal) const {
  const MortarPath& path = *state_.path;
  const auto& places = places_[side.pair];
  return {.lambda = at.values.scalar(state_.lambda)[side.node],
          .traction = at.values.vector(path.traction).row(side.node).transpose(),
          .place = at.values.vector(path.place).row(side.node).transpose(),
          .lambda_before = at.values.scalar(path.lambda_before)[side.node],
          .before = at.values.vector(path.before).row(side.node).transpose(),
          .normal = normal,
          .turn = {places.of[0].turn, places.of[1].turn}};
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
  NodalField<dim> places = at.values.vector(state_.path->before);
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
    pattern.add({places[i]}, {places[i], before_number(side, i)});
    if (!state_.path->is_last) continue;
    const int s = memory_numbers_(side.node, i);
    pattern.add({s}, {s, places[i]});
  }
}

template <int dim>
void MortarTerm<dim>::add_path_residual(const Evaluation<dim>& at, const Side& side,
                                        const SideState& state, std::span<double> F) const {
  const MortarPath& path = *state_.path;
  const StickingInput<dim> input = sticking_input(at, side, state.normal->value);
  const Vector<dim> place = place_on_partner(side, state).value_or(input.before);
  const Vector<dim> s = at.values.vector(path.memory).row(side.node).transpose();
  for (int i = 0; i < dim; ++i) {
    if (const int row = traction_number(side, i); row >= 0) F[row] += state.sticking->constraint[i];
    if (const int row = place_number(side, i); row >= 0) F[row] += input.place[i] - place[i];
    if (!path.is_last) continue;
    if (const int row = memory_numbers_(side.node, i); row >= 0)
      F[row] += (at.ydot.empty() ? 0 : at.ydot[row]) - (input.place[i] - s[i]) / path.period;
  }
}

template <int dim>
void MortarTerm<dim>::add_path(const Side& side, const SideState& state, double rate_weight,
                               std::span<double> values) const {
  const std::vector<int>& own = own_numbers_[side.node];
  const ContactPatch<dim>& of = patch(side);
  const StickingTraction<dim>& sticking = *state.sticking;
  std::vector<int> rows;
  for (int i = 0; i < dim; ++i) rows.push_back(traction_number(side, i));
  add(rows, own, sticking.constraint_by_own, values);
  const auto count = static_cast<Eigen::Index>(of.nodes.size());
  Eigen::MatrixXd by_nodes(dim, 2 * dim * count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const Tensor<dim> by = sticking.constraint_by_n *
                           state.normal->by_x[static_cast<std::size_t>(p)] * place(side).turn;
    by_nodes.middleCols(dim * p, dim) = by;
    by_nodes.middleCols(dim * (count + p), dim) = by;
  }
  add(rows, numbers_of(of.nodes, false), by_nodes, values);
  const double rate = 1 / state_.path->period;
  const auto put = [&](int row, int column, double value) {
    add({row}, {column}, Eigen::MatrixXd::Constant(1, 1, value), values);
  };
  for (int i = 0; i < dim; ++i) {
    const int r = place_number(side, i);
    put(r, r, 1);
    if (!(state.area > 0)) put(r, before_number(side, i), -1);
    if (!state_.path->is_last) continue;
    const int s = memory_numbers_(side.node, i);
    put(s, r, -rate);
    put(s, s, rate_weight + rate);
  }
}

template FacetNodal<2> MortarTerm<2>::labels_of(const Evaluation<2>&, int, int) const;
template StickingInput<2> MortarTerm<2>::sticking_input(const Evaluation<2>&, const Side&,
                                                        const Vector<2>&) const;
template NodalField<2> MortarTerm<2>::places(const Evaluation<2>&) const;
template void MortarTerm<2>::declare_path(const Side&, PatternBuilder&) const;
template void MortarTerm<2>::add_path_residual(const Evaluation<2>&, const Side&, const SideState&,
                                               std::span<double>) const;
template void MortarTerm<2>::add_path(const Side&, const SideState&, double,
                                      std::span<double>) const;
template FacetNodal<3> MortarTerm<3>::labels_of(const Evaluation<3>&, int, int) const;
template StickingInput<3> MortarTerm<3>::sticking_input(const Evaluation<3>&, const Side&,
                                                        const Vector<3>&) const;
template NodalField<3> MortarTerm<3>::places(const Evaluation<3>&) const;
template void MortarTerm<3>::declare_path(const Side&, PatternBuilder&) const;
template void MortarTerm<3>::add_path_residual(const Evaluation<3>&, const Side&, const SideState&,
                                               std::span<double>) const;
template void MortarTerm<3>::add_path(const Side&, const SideState&, double,
                                      std::span<double>) const;

}  // namespace gnomon
