#include <algorithm>
#include <gnomon/terms/contact_term.hpp>
#include <limits>

namespace gnomon {

template <int dim>
ContactTerm<dim>::ContactTerm(const ContactState<dim>& state, FieldId d, const Numbering& numbering)
    : state_(state),
      d_(d),
      u_numbers_(numbering.nodal<dim>(state.u)),
      d_numbers_(numbering.nodal<dim>(d)) {
  surfaces_.assign(state.laws.size(), state.parameters);
  for (std::size_t k = 0; k < surfaces_.size(); ++k) surfaces_[k].wear = state.laws[k];
  for (int c = 0; c < count(); ++c) {
    lambda_numbers_.push_back(numbering.number(state.lambda, c));
    first_switch_.push_back(first_switch_.back() + switching_functions(parameters(c)));
  }
  const CounterBody<dim>& body = state.parameters.counter_body;
  for (std::size_t k = 0; k < body.guides.size(); ++k)
    q_numbers_.push_back(numbering.number(state.q, static_cast<Eigen::Index>(k)));
  if (!body.is_given()) return;
  double touching = std::numeric_limits<double>::infinity(), travel = 0;
  for (const ContactPatch<dim>& patch : state.patches)
    touching =
        std::min(touching, body.travel_to(state.mesh.nodes[patch.node], patch.initial_normal));
  const PartnerMotion<> given = body.given(0, 0);
  for (std::size_t k = 0; k < body.guides.size(); ++k) travel += body.guides[k].share * given[k];
  overlap_ = std::max(0.0, travel - touching);
}

template <int dim>
PartnerMotion<> ContactTerm<dim>::motion(const Evaluation<dim>& at) const {
  const CounterBody<dim>& body = state_.parameters.counter_body;
  PartnerMotion<> q = body.given(at.t, at.within);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (state_.q != FieldId::none) q[k] += at.values.scalar(state_.q)[k];
    if (body.guides[k].travel) q[k] -= (1 - at.load_fraction) * overlap_ * body.guides[k].share;
  }
  return q;
}

template <int dim>
std::vector<int> ContactTerm<dim>::row_numbers(int c) const {
  std::vector<int> result(q_0);
  const int node = state_.patches[c].node;
  for (int i = 0; i < dim; ++i) {
    result[u_0 + i] = u_numbers_(node, i);
    result[wear_0 + i] = wear_row(c, i);
  }
  result[lambda_0] = lambda_numbers_[c];
  result.insert(result.end(), q_numbers_.begin(), q_numbers_.end());
  return result;
}

/// The displacement of the other nodes of the patch enters only through streaming.
template <int dim>
std::vector<int> ContactTerm<dim>::column_numbers(int c) const {
  const ContactPatch<dim>& patch = state_.patches[c];
  const bool streams = !state_.parameters.streaming.isZero(0);
  std::vector<int> result = {lambda_numbers_[c]};
  result.insert(result.end(), q_numbers_.begin(), q_numbers_.end());
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
  for (const Guide<dim>& guide : state_.parameters.counter_body.guides)
    if (guide.travel) add(structure.breakpoints, guide.travel->times());
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
    const int mesh_node = state_.patches[c].node;
    if (const int row = lambda_numbers_[c]; row >= 0) F[row] += contact.constraint;
    for (int k = 0; k < unknowns(); ++k)
      if (const int row = q_numbers_[k]; row >= 0) F[row] += contact.partner[k];
    for (int i = 0; i < dim; ++i) {
      if (const int row = u_numbers_(mesh_node, i); row >= 0) F[row] += contact.force[i];
      if (const int row = wear_row(c, i); row >= 0) F[row] -= weight(c) * contact.velocity[i];
    }
  }
}

template <int dim>
typename ContactTerm<dim>::Local ContactTerm<dim>::tangent(const Evaluation<dim>& at, int c) const {
  const ContactPatch<dim>& patch = state_.patches[c];
  const ContactNodeTangent<dim> node(parameters(c), patch, gather(at, c), branch(at, c));
  const int size = static_cast<int>(patch.nodes.size());
  const int own_u = q_column + unknowns(), own_d = own_u + dim * size;
  Local K = Local::Zero(q_0 + unknowns(), own_d + dim * size);
  K.template block<dim, 1>(u_0, 0) = node.force_by_lambda;
  K.template middleRows<dim>(u_0).middleCols(q_column, unknowns()) = node.force_by_q;
  K(lambda_0, 0) = node.constraint_by_lambda;
  K.row(lambda_0).segment(q_column, unknowns()) = node.constraint_by_q;
  K.template block<dim, 1>(wear_0, 0) = -weight(c) * node.velocity_by_lambda;
  K.template middleRows<dim>(wear_0).middleCols(q_column, unknowns()) =
      -weight(c) * node.velocity_by_q;
  for (int p = 0; p < size; ++p) {
    const int u = own_u + dim * p, d = own_d + dim * p;
    K.template block<dim, dim>(u_0, u) = node.force_by_x[p];
    K.template block<dim, dim>(u_0, d) = node.force_by_x[p] + node.force_by_X[p];
    K.template block<dim, dim>(wear_0, u) = -weight(c) * node.velocity_by_x[p];
    K.template block<dim, dim>(wear_0, d) =
        -weight(c) * (node.velocity_by_x[p] + node.velocity_by_X[p]);
  }
  // The gap depends only on the node's own position.
  K.template block<1, dim>(lambda_0, own_u) = node.constraint_by_x.transpose();
  K.template block<1, dim>(lambda_0, own_d) = node.constraint_by_x.transpose();
  for (int k = 0; k < unknowns(); ++k) {
    K.row(q_0 + k) = -node.weights.col(k).transpose() * K.template middleRows<dim>(u_0);
    const auto& by = node.partner_by[k];
    if (by.size() == 0) continue;
    K.row(q_0 + k).segment(q_column, unknowns()) += by.tail(unknowns());
    for (int own : {own_u, own_d})
      K.row(q_0 + k).template segment<dim>(own) += by.template head<dim>();
  }
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
