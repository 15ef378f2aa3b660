#include <gnomon/terms/contact_assembly.hpp>

namespace gnomon {

namespace {

Branch branch_of(const ActiveSet* piece, int c) {
  if (!piece) return Branch::by_sign;
  return (*piece)[c] ? Branch::closed : Branch::open;
}

}  // namespace

template <int dim>
ContactAssembly<dim>::ContactAssembly(const WornBody<dim>& body, const Unknowns<dim>& unknowns)
    : body_(body), unknowns_(unknowns) {
  for (const auto& patch : body.contact_nodes)
    owns_.push_back(body.shape_node(patch.node) == patch.node);
}

template <int dim>
std::vector<int> ContactAssembly<dim>::row_numbers(int c) const {
  const int node = body_.contact_nodes[c].node;
  std::vector<int> result(rows);
  for (int i = 0; i < dim; ++i) {
    result[u_0 + i] = unknowns_.u()(node, i);
    result[wear_0 + i] = unknowns_.d()(node, i);
    result[auxiliary_0 + i] = unknowns_.mu()(c, i);
  }
  result[lambda_0] = unknowns_.lambda()[c];
  result[w_0] = unknowns_.w();
  return result;
}

/// The displacement of the other nodes of the patch enters by streaming alone.
template <int dim>
std::vector<int> ContactAssembly<dim>::column_numbers(int c) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  const bool streams = !body_.contact.streaming.isZero(0);
  std::vector<int> result = {unknowns_.lambda()[c], unknowns_.w()};
  for (int i = 0; i < dim; ++i) result.push_back(unknowns_.mu()(c, i));
  for (int node : patch.nodes)
    for (int i = 0; i < dim; ++i)
      result.push_back(streams || node == patch.node ? unknowns_.u()(node, i) : -1);
  for (int node : patch.nodes)
    for (int i = 0; i < dim; ++i) result.push_back(unknowns_.d()(node, i));
  return result;
}

/// The augmentation multiplies the wear row, so it exists only where that row does.
template <int dim>
bool ContactAssembly<dim>::augmented(int c) const {
  const int node = body_.contact_nodes[c].node;
  return unknowns_.mu().row(c).maxCoeff() >= 0 && unknowns_.d().row(node).maxCoeff() >= 0;
}

template <int dim>
void ContactAssembly<dim>::add_to_pattern(PatternBuilder& builder) const {
  for (int c = 0; c < static_cast<int>(body_.contact_nodes.size()); ++c)
    builder.add(row_numbers(c), column_numbers(c));
}

template <int dim>
void ContactAssembly<dim>::map_to(const SparsePattern& pattern) {
  map_.assign(body_.contact_nodes.size(), {});
  for (int c = 0; c < static_cast<int>(map_.size()); ++c) {
    const std::vector<int> row = row_numbers(c);
    for (int column : column_numbers(c))
      for (int r : row) map_[c].push_back(r >= 0 && column >= 0 ? pattern.find(r, column) : -1);
  }
}

template <int dim>
ContactInput<dim> ContactAssembly<dim>::gather(const NodalState<dim>& state, int c) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  const auto count = static_cast<Eigen::Index>(patch.nodes.size());
  ContactInput<dim> input{PatchNodal<dim>(count, dim), PatchNodal<dim>(count, dim), state.lambda[c],
                          state.w};
  for (Eigen::Index p = 0; p < count; ++p) {
    const int node = patch.nodes[p];
    input.X.row(p) = body_.mesh.nodes[node].transpose() + state.d.row(node);
    input.u.row(p) = state.u.row(node);
  }
  return input;
}

template <int dim>
ContactNode<dim> ContactAssembly<dim>::node(const NodalState<dim>& state, int c,
                                            const ActiveSet* piece) const {
  return {body_.contact, body_.contact_nodes[c], gather(state, c), branch_of(piece, c)};
}

template <int dim>
void ContactAssembly<dim>::add_residual(const NodalState<dim>& state, std::span<const double> ydot,
                                        const ActiveSet* piece, std::span<double> F) const {
  for (int c = 0; c < static_cast<int>(body_.contact_nodes.size()); ++c) {
    const ContactPatch<dim>& patch = body_.contact_nodes[c];
    const ContactNode<dim> contact = node(state, c, piece);
    const bool augment = augmented(c);
    if (const int row = unknowns_.lambda()[c]; row >= 0) F[row] += contact.constraint;
    if (const int row = unknowns_.w(); row >= 0)
      F[row] -= contact.force.dot(body_.contact.counter_body.approach);
    for (int i = 0; i < dim; ++i) {
      if (const int row = unknowns_.u()(patch.node, i); row >= 0) F[row] += contact.force[i];
      const int wear_row = unknowns_.d()(patch.node, i);
      double violation = 0;
      if (wear_row >= 0) {
        violation = -weight(c) * contact.velocity[i];
        if (owns_[c]) violation += ydot[wear_row];
        F[wear_row] += violation;
      }
      if (const int row = unknowns_.mu()(c, i); row >= 0) {
        const double augmentation = augment ? body_.augmentation * violation : 0;
        F[row] -= patch.initial_area * (state.mu(c, i) + augmentation);
      }
    }
  }
}

template <int dim>
typename ContactAssembly<dim>::Local ContactAssembly<dim>::tangent(const NodalState<dim>& state,
                                                                   double alpha,
                                                                   const ActiveSet* piece,
                                                                   int c) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  const ContactNodeTangent<dim> node(body_.contact, patch, gather(state, c), branch_of(piece, c));
  const int count = static_cast<int>(patch.nodes.size());
  Local K = Local::Zero(rows, patch_column + 2 * dim * count);
  K.template block<dim, 1>(u_0, 0) = node.force_by_lambda;
  K.template block<dim, 1>(u_0, w_column) = node.force_by_w;
  K(lambda_0, 0) = node.constraint_by_lambda;
  K(lambda_0, w_column) = node.constraint_by_w;
  K.template block<dim, 1>(wear_0, 0) = -weight(c) * node.velocity_by_lambda;
  K.template block<dim, 1>(wear_0, w_column) = -weight(c) * node.velocity_by_w;
  for (int p = 0; p < count; ++p) {
    const int u = patch_column + dim * p, d = u + dim * count;
    K.template block<dim, dim>(u_0, u) = node.force_by_x[p];
    K.template block<dim, dim>(u_0, d) = node.force_by_x[p] + node.force_by_X[p];
    K.template block<dim, dim>(wear_0, u) = -weight(c) * node.velocity_by_x[p];
    K.template block<dim, dim>(wear_0, d) =
        -weight(c) * (node.velocity_by_x[p] + node.velocity_by_X[p]);
  }
  // The gap depends on the node's own position alone.
  const int own_u = patch_column, own_d = patch_column + dim * count;
  K.template block<1, dim>(lambda_0, own_u) = node.constraint_by_x.transpose();
  K.template block<1, dim>(lambda_0, own_d) = node.constraint_by_x.transpose();
  if (owns_[c]) K.template block<dim, dim>(wear_0, own_d) += alpha * Tensor<dim>::Identity();
  K.row(w_0) = -body_.contact.counter_body.approach.transpose() * K.template middleRows<dim>(u_0);
  if (augmented(c))
    K.template middleRows<dim>(auxiliary_0) -=
        patch.initial_area * body_.augmentation * K.template middleRows<dim>(wear_0);
  for (int i = 0; i < dim; ++i) K(auxiliary_0 + i, mu_column + i) -= patch.initial_area;
  return K;
}

template <int dim>
void ContactAssembly<dim>::add_jacobian(const NodalState<dim>& state, double alpha,
                                        const ActiveSet* piece, std::span<double> values) const {
  for (int c = 0; c < static_cast<int>(body_.contact_nodes.size()); ++c) {
    const Local K = tangent(state, alpha, piece, c);
    const std::vector<int>& map = map_[c];
    for (std::size_t k = 0; k < map.size(); ++k)
      if (map[k] >= 0) values[map[k]] += K.data()[k];
  }
}

template class ContactAssembly<2>;
template class ContactAssembly<3>;

}  // namespace gnomon
