#include <algorithm>
#include <gnomon/terms/contact_term.hpp>
#include <limits>

namespace gnomon {

template <int dim>
ContactTerm<dim>::ContactTerm(const ContactState<dim>& state, const WornSurface<dim>& surface,
                              const Numbering& numbering)
    : state_(state),
      d_(surface.d),
      evolution_(numbering, surface),
      u_numbers_(numbering.nodal<dim>(state.u)),
      d_numbers_(numbering.nodal<dim>(surface.d)),
      w_number_(numbering.number(state.w, 0)) {
  surfaces_.assign(state.laws.size(), state.parameters);
  for (std::size_t k = 0; k < surfaces_.size(); ++k) surfaces_[k].wear = state.laws[k];
  for (int c = 0; c < count(); ++c) {
    lambda_numbers_.push_back(numbering.number(state.lambda, c));
    first_switch_.push_back(first_switch_.back() + switching_functions(parameters(c)));
  }
  const CounterBody<dim>& body = state.parameters.counter_body;
  if (!body.travel) return;
  double touching = std::numeric_limits<double>::infinity();
  for (const ContactPatch<dim>& patch : state.patches)
    touching = std::min(touching, body.travel_to(state.mesh.nodes[patch.node]));
  overlap_ = std::max(0.0, body.travel->factor(0) - touching);
}

template <int dim>
double ContactTerm<dim>::motion(const Evaluation<dim>& at) const {
  const double unknown = state_.w == FieldId::none ? 0 : at.values.scalar(state_.w)[0];
  const std::optional<LoadHistory>& travel = state_.parameters.counter_body.travel;
  if (!travel) return unknown;
  return unknown + travel->factor(at.t, at.within) - (1 - at.load_fraction) * overlap_;
}

template <int dim>
std::vector<int> ContactTerm<dim>::row_numbers(int c) const {
  std::vector<int> result(rows);
  for (int i = 0; i < dim; ++i) {
    result[u_0 + i] = u_numbers_(state_.patches[c].node, i);
    result[wear_0 + i] = evolution_.row(c, i);
    result[reaction_0 + i] = evolution_.factor(c) == 0 ? -1 : evolution_.reaction(c, i);
  }
  result[lambda_0] = lambda_numbers_[c];
  result[w_0] = w_number_;
  return result;
}

/// The displacement of the other nodes of the patch enters only through streaming.
template <int dim>
std::vector<int> ContactTerm<dim>::column_numbers(int c) const {
  const ContactPatch<dim>& patch = state_.patches[c];
  const bool streams = !state_.parameters.streaming.isZero(0);
  std::vector<int> result = {lambda_numbers_[c], w_number_};
  for (int node : patch.nodes)
    for (int i = 0; i < dim; ++i)
      result.push_back(streams || node == patch.node ? u_numbers_(node, i) : -1);
  for (int node : patch.nodes)
    for (int i = 0; i < dim; ++i) result.push_back(d_numbers_(node, i));
  return result;
}

template <int dim>
void ContactTerm<dim>::declare(TermStructure& structure) const {
  for (int c = 0; c < count(); ++c) {
    structure.pattern.add(row_numbers(c), column_numbers(c));
    structure.switch_node.insert(structure.switch_node.end(), switching_functions(parameters(c)),
                                 state_.patches[c].node);
    structure.switch_jumps.push_back(0);
    const WearLaw& law = parameters(c).wear;
    for (std::size_t k = 0; k < law.kinks(); ++k) structure.switch_jumps.push_back(law.may_jump(k));
  }
  const auto add = [](std::vector<double>& times, const std::vector<double>& more) {
    times.insert(times.end(), more.begin(), more.end());
  };
  for (const ContactParameters<dim>& surface : surfaces_) {
    add(structure.breakpoints, surface.wear.breakpoints());
    add(structure.stops, surface.wear.stops());
  }
  if (const auto& travel = state_.parameters.counter_body.travel)
    add(structure.breakpoints, travel->times());
}

template <int dim>
void ContactTerm<dim>::map_to(const SparsePattern& pattern) {
  map_.assign(state_.patches.size(), {});
  for (int c = 0; c < count(); ++c) {
    const std::vector<int> row = row_numbers(c);
    for (int column : column_numbers(c))
      for (int r : row) map_[c].push_back(r >= 0 && column >= 0 ? pattern.find(r, column) : -1);
  }
}

template <int dim>
ContactInput<dim> ContactTerm<dim>::gather(const Evaluation<dim>& at, int c) const {
  const ContactPatch<dim>& patch = state_.patches[c];
  const auto size = static_cast<Eigen::Index>(patch.nodes.size());
  const NodalField<dim>&u = at.values.vector(state_.u), &d = at.values.vector(d_);
  ContactInput<dim> input{PatchNodal<dim>(size, dim),
                          PatchNodal<dim>(size, dim),
                          at.values.scalar(state_.lambda)[c],
                          motion(at),
                          {.time = at.t, .slid = state_.nominal_speed * at.t, .within = at.within}};
  for (Eigen::Index p = 0; p < size; ++p) {
    const int node = patch.nodes[p];
    input.X.row(p) = state_.mesh.nodes[node].transpose() + d.row(node);
    input.u.row(p) = u.row(node);
  }
  return input;
}

template <int dim>
NodeBranch ContactTerm<dim>::branch(const Evaluation<dim>& at, int c) const {
  if (at.branch.empty()) return {};
  const auto of_node = own(at.branch, c);
  return {of_node.front() ? Branch::closed : Branch::open, of_node.subspan(1)};
}

template <int dim>
ContactNode<dim> ContactTerm<dim>::node(const Evaluation<dim>& at, int c) const {
  return {parameters(c), state_.patches[c], gather(at, c), branch(at, c)};
}

template <int dim>
std::vector<ContactNode<dim>> ContactTerm<dim>::nodes(const Evaluation<dim>& at) const {
  std::vector<ContactNode<dim>> result;
  for (int c = 0; c < count(); ++c) result.push_back(node(at, c));
  return result;
}

template <int dim>
void ContactTerm<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  for (int c = 0; c < count(); ++c) {
    const ContactNode<dim> contact = node(at, c);
    if (const int row = lambda_numbers_[c]; row >= 0) F[row] += contact.constraint;
    if (w_number_ >= 0) F[w_number_] -= contact.force.dot(state_.parameters.counter_body.approach);
    for (int i = 0; i < dim; ++i)
      if (const int row = u_numbers_(state_.patches[c].node, i); row >= 0)
        F[row] += contact.force[i];
    evolution_.add(c, -weight(c) * contact.velocity, F);
  }
}

template <int dim>
typename ContactTerm<dim>::Local ContactTerm<dim>::tangent(const Evaluation<dim>& at, int c) const {
  const ContactPatch<dim>& patch = state_.patches[c];
  const ContactNodeTangent<dim> node(parameters(c), patch, gather(at, c), branch(at, c));
  const int size = static_cast<int>(patch.nodes.size());
  Local K = Local::Zero(rows, patch_column + 2 * dim * size);
  K.template block<dim, 1>(u_0, 0) = node.force_by_lambda;
  K.template block<dim, 1>(u_0, w_column) = node.force_by_w;
  K(lambda_0, 0) = node.constraint_by_lambda;
  K(lambda_0, w_column) = node.constraint_by_w;
  K.template block<dim, 1>(wear_0, 0) = -weight(c) * node.velocity_by_lambda;
  K.template block<dim, 1>(wear_0, w_column) = -weight(c) * node.velocity_by_w;
  for (int p = 0; p < size; ++p) {
    const int u = patch_column + dim * p, d = u + dim * size;
    K.template block<dim, dim>(u_0, u) = node.force_by_x[p];
    K.template block<dim, dim>(u_0, d) = node.force_by_x[p] + node.force_by_X[p];
    K.template block<dim, dim>(wear_0, u) = -weight(c) * node.velocity_by_x[p];
    K.template block<dim, dim>(wear_0, d) =
        -weight(c) * (node.velocity_by_x[p] + node.velocity_by_X[p]);
  }
  // The gap depends only on the node's own position.
  const int own_u = patch_column, own_d = patch_column + dim * size;
  K.template block<1, dim>(lambda_0, own_u) = node.constraint_by_x.transpose();
  K.template block<1, dim>(lambda_0, own_d) = node.constraint_by_x.transpose();
  K.row(w_0) =
      -state_.parameters.counter_body.approach.transpose() * K.template middleRows<dim>(u_0);
  if (evolution_.factor(c) != 0)
    K.template middleRows<dim>(reaction_0) =
        evolution_.factor(c) * K.template middleRows<dim>(wear_0);
  return K;
}

template <int dim>
void ContactTerm<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                    std::span<double> values) const {
  for (int c = 0; c < count(); ++c) {
    const Local K = tangent(at, c);
    const std::vector<int>& map = map_[c];
    for (std::size_t k = 0; k < map.size(); ++k)
      if (map[k] >= 0) values[map[k]] += K.data()[k];
  }
}

template <int dim>
void ContactTerm<dim>::switching(const Evaluation<dim>& at, std::span<double> values) const {
  for (int c = 0; c < count(); ++c)
    contact_switching(parameters(c), state_.patches[c], gather(at, c), branch(at, c),
                      own(values, c));
}

template class ContactTerm<2>;
template class ContactTerm<3>;

}  // namespace gnomon
