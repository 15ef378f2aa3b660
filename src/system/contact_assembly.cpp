#include <gnomon/system/contact_assembly.hpp>

namespace gnomon {

namespace {

Branch branch_of(const ActiveSet* piece, int c) {
  if (!piece) return Branch::by_sign;
  return (*piece)[c] ? Branch::closed : Branch::open;
}

}  // namespace

template <int dim>
ContactAssembly<dim>::ContactAssembly(const WornBody<dim>& body, const Unknowns<dim>& unknowns)
    : body_(body), unknowns_(unknowns) {}

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
  return result;
}

template <int dim>
std::vector<int> ContactAssembly<dim>::column_numbers(int c) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  std::vector<int> result;
  for (int i = 0; i < dim; ++i) result.push_back(unknowns_.u()(patch.node, i));
  result.push_back(unknowns_.lambda()[c]);
  for (int i = 0; i < dim; ++i) result.push_back(unknowns_.mu()(c, i));
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
PatchNodal<dim> ContactAssembly<dim>::patch_positions(const NodalState<dim>& state, int c) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  PatchNodal<dim> X(patch.nodes.size(), dim);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p)
    X.row(static_cast<int>(p)) =
        body_.mesh.nodes[patch.nodes[p]].transpose() + state.d.row(patch.nodes[p]);
  return X;
}

template <int dim>
ContactNode<dim> ContactAssembly<dim>::node(const NodalState<dim>& state, int c,
                                            const ActiveSet* piece) const {
  const ContactPatch<dim>& patch = body_.contact_nodes[c];
  return {body_.contact,
          patch,
          patch_positions(state, c),
          state.u.row(patch.node).transpose(),
          state.lambda[c],
          branch_of(piece, c)};
}

template <int dim>
void ContactAssembly<dim>::add_residual(const NodalState<dim>& state, std::span<const double> ydot,
                                        const ActiveSet* piece, std::span<double> F) const {
  for (int c = 0; c < static_cast<int>(body_.contact_nodes.size()); ++c) {
    const ContactPatch<dim>& patch = body_.contact_nodes[c];
    const ContactNode<dim> contact = node(state, c, piece);
    const bool augment = augmented(c);
    if (const int row = unknowns_.lambda()[c]; row >= 0) F[row] += contact.constraint;
    for (int i = 0; i < dim; ++i) {
      if (const int row = unknowns_.u()(patch.node, i); row >= 0) F[row] += contact.force[i];
      const int wear_row = unknowns_.d()(patch.node, i);
      const double violation = wear_row >= 0 ? ydot[wear_row] - contact.velocity[i] : 0;
      if (wear_row >= 0) F[wear_row] += violation;
      if (const int row = unknowns_.mu()(c, i); row >= 0) {
        const double augmentation = augment ? body_.augmentation * violation : 0;
        F[row] -= patch.initial_area * (state.mu(c, i) + augmentation);
      }
    }
  }
}

template <int dim>
void ContactAssembly<dim>::add_jacobian(const NodalState<dim>& state, double alpha,
                                        const ActiveSet* piece, std::span<double> values) const {
  using Local =
      Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows, shape_column + dim * max_patch_nodes>;
  for (int c = 0; c < static_cast<int>(body_.contact_nodes.size()); ++c) {
    const ContactPatch<dim>& patch = body_.contact_nodes[c];
    const ContactNodeTangent<dim> tangent(body_.contact, patch, patch_positions(state, c),
                                          state.u.row(patch.node).transpose(), state.lambda[c],
                                          branch_of(piece, c));
    Local K = Local::Zero(rows, shape_column + dim * static_cast<int>(patch.nodes.size()));
    K.template block<dim, dim>(u_0, 0) = tangent.force_by_x;
    K.template block<dim, 1>(u_0, dim) = tangent.force_by_lambda;
    K.template block<1, dim>(lambda_0, 0) = tangent.constraint_by_x.transpose();
    K(lambda_0, dim) = tangent.constraint_by_lambda;
    K.template block<dim, dim>(wear_0, 0) = -tangent.velocity_by_x;
    K.template block<dim, 1>(wear_0, dim) = -tangent.velocity_by_lambda;
    for (std::size_t p = 0; p < patch.nodes.size(); ++p) {
      const int column = shape_column + dim * static_cast<int>(p);
      K.template block<dim, dim>(u_0, column) = tangent.force_by_X[p];
      K.template block<dim, dim>(wear_0, column) = -tangent.velocity_by_X[p];
    }
    // The node's own position enters through its shape as through its displacement.
    K.template block<dim, dim>(u_0, shape_column) += tangent.force_by_x;
    K.template block<1, dim>(lambda_0, shape_column) += tangent.constraint_by_x.transpose();
    K.template block<dim, dim>(wear_0, shape_column) +=
        alpha * Tensor<dim>::Identity() - tangent.velocity_by_x;
    if (augmented(c))
      K.template middleRows<dim>(auxiliary_0) -=
          patch.initial_area * body_.augmentation * K.template middleRows<dim>(wear_0);
    for (int i = 0; i < dim; ++i) K(auxiliary_0 + i, mu_column + i) -= patch.initial_area;

    const std::vector<int>& map = map_[c];
    for (std::size_t k = 0; k < map.size(); ++k)
      if (map[k] >= 0) values[map[k]] += K.data()[k];
  }
}

template class ContactAssembly<2>;
template class ContactAssembly<3>;

}  // namespace gnomon
