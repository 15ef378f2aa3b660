// Contact of a deformed body with its partner, node by node: rows of u (contact force), lambda (eq.
// 26), q (balance of forces on the partner), and the share of wear in the rows of the shape (eq.
// 14).
#pragma once

#include <gnomon/terms/contact_nodes.hpp>
#include <gnomon/terms/contact_state.hpp>

namespace gnomon {

template <int dim>
class ContactTerm : public ContactNodes<dim> {
public:
  ContactTerm(const ContactState<dim>& state, FieldId d, const Numbering& numbering)
      : state_(state),
        motion_(state),
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
  }

  void declare(TermStructure& structure) const override {
    for (int c = 0; c < count(); ++c) {
      structure.pattern.add(row_numbers(c), column_numbers(c));
      declare_switches(state_.patches[c].node, 1, parameters(c).wear, structure);
    }
    declare_times(state_.laws, state_.parameters.counter_body.guides, structure);
  }

  void map_to(const SparsePattern& pattern) override {
    map_.clear();
    for (int c = 0; c < count(); ++c)
      map_.push_back(pattern.positions(row_numbers(c), column_numbers(c)));
  }

  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
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

  void add_jacobian(const Evaluation<dim>& at, double, std::span<double> values) const override {
    for (int c = 0; c < count(); ++c) {
      const Local K = tangent(at, c);
      const std::vector<int>& map = map_[c];
      for (std::size_t k = 0; k < map.size(); ++k)
        if (map[k] >= 0) values[map[k]] += K.data()[k];
    }
  }
  /// For every contact node lambda + rho g [stress], then the kinks of the wear law.
  void switching(const Evaluation<dim>& at, std::span<double> values) const override {
    for (int c = 0; c < count(); ++c)
      contact_switching(parameters(c), state_.patches[c], gather(at, c), branch(at, c),
                        own(values, c));
  }

  std::vector<ContactNode<dim>> nodes(const Evaluation<dim>& at) const override {
    std::vector<ContactNode<dim>> result;
    for (int c = 0; c < count(); ++c) result.push_back(node(at, c));
    return result;
  }

private:
  // Local rows: u | lambda | d (wear) | q; columns: lambda | q | u of patch | d of patch.
  static constexpr int u_0 = 0, lambda_0 = dim, wear_0 = dim + 1, q_0 = 2 * dim + 1;
  static constexpr int q_column = 1;
  static constexpr int most_rows = q_0 + most_partner_unknowns;
  using Local = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_rows,
                              q_column + most_partner_unknowns + 2 * dim * max_patch_nodes>;

  int count() const { return static_cast<int>(state_.patches.size()); }
  std::vector<int> row_numbers(int c) const {
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
  std::vector<int> column_numbers(int c) const {
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

  /// The row of d at a contact node, -1: its shape is held, or does not wear.
  int wear_row(int c, int i) const {
    const ContactPatch<dim>& patch = state_.patches[c];
    return patch.may_move() ? d_numbers_(patch.node, i) : -1;
  }
  int unknowns() const { return static_cast<int>(q_numbers_.size()); }
  ContactInput<dim> gather(const Evaluation<dim>& at, int c) const {
    const ContactPatch<dim>& patch = state_.patches[c];
    const auto size = static_cast<Eigen::Index>(patch.nodes.size());
    const NodalField<dim>&u = at.values.vector(state_.u), &d = at.values.vector(d_);
    ContactInput<dim> input{
        PatchNodal<dim>(size, dim),
        PatchNodal<dim>(size, dim),
        at.values.scalar(state_.lambda)[c],
        motion_.at(at, state_.q),
        {.time = at.t, .slid = state_.nominal_speed * at.t, .within = at.within},
        state_.clearance(at)};
    for (Eigen::Index p = 0; p < size; ++p) {
      const int node = patch.nodes[p];
      input.X.row(p) = state_.mesh.nodes[node].transpose() + d.row(node);
      input.u.row(p) = u.row(node);
    }
    return input;
  }

  NodeBranch branch(const Evaluation<dim>& at, int c) const {
    if (at.branch.empty()) return {};
    const auto of_node = own(at.branch, c);
    return {of_node.front() ? Branch::closed : Branch::open, of_node.subspan(1)};
  }
  ContactNode<dim> node(const Evaluation<dim>& at, int c) const {
    return {parameters(c), state_.patches[c], gather(at, c), branch(at, c)};
  }

  Local tangent(const Evaluation<dim>& at, int c) const {
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

  double weight(int c) const {
    return state_.part * (state_.wear_weight.empty() ? 1 : state_.wear_weight[c]);
  }
  const ContactParameters<dim>& parameters(int c) const { return surfaces_[state_.surface_of[c]]; }
  /// The part of the term's switching functions that belongs to a node.
  template <class T>
  std::span<T> own(std::span<T> switching, int c) const {
    return switching.subspan(first_switch_[c], first_switch_[c + 1] - first_switch_[c]);
  }

  ContactState<dim> state_;
  MotionOfPartner<dim> motion_;
  std::vector<ContactParameters<dim>> surfaces_;  // of each wearing surface
  FieldId d_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  std::vector<int> lambda_numbers_, q_numbers_;
  std::vector<std::size_t> first_switch_ = {0};  // of each node; last: their number
  std::vector<std::vector<int>> map_;  // of each node: positions, column by column; -1: none
};

}  // namespace gnomon
