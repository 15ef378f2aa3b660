#include <gnomon/fields/unknowns.hpp>

namespace gnomon {

template <int dim>
NodalState<dim> NodalState<dim>::zero(const WornBody<dim>& body) {
  const auto nodes = static_cast<Eigen::Index>(body.mesh.nodes.size());
  const auto contact = static_cast<Eigen::Index>(body.contact_nodes.size());
  return {NodalField<dim>::Zero(nodes, dim), NodalField<dim>::Zero(nodes, dim),
          Eigen::VectorXd::Zero(contact), NodalField<dim>::Zero(contact, dim), 0};
}

template <int dim>
Unknowns<dim>::Unknowns(const WornBody<dim>& body, const Selection& selection) {
  const int nodes = static_cast<int>(body.mesh.nodes.size());
  const int contact = static_cast<int>(body.contact_nodes.size());
  u_ = d_ = auxiliary_row_ = Numbers::Constant(nodes, dim, -1);
  mu_ = Numbers::Constant(contact, dim, -1);
  lambda_ = Eigen::VectorXi::Constant(contact, -1);
  std::vector<int> contact_of(nodes, -1);
  for (int c = 0; c < contact; ++c) contact_of[body.contact_nodes[c].node] = c;

  const auto number = [this](int node) {
    node_.push_back(node);
    return size_++;
  };
  for (int node = 0; node < nodes; ++node) {
    const int c = contact_of[node];
    const bool shape = c < 0 ? selection.interior_shape : selection.contact_shape;
    const bool multiplier =
        c >= 0 && selection.interior_shape && body.constraint == ConstraintForm::multiplier;
    for (int i = 0; i < dim; ++i)
      if (selection.deformation && !body.displacement_fixed(node, i)) u_(node, i) = number(node);
    for (int i = 0; i < dim; ++i)
      if (shape && !body.shape_fixed(node, i) && body.shape_node(node) == node)
        d_(node, i) = number(node);
    if (c >= 0 && selection.deformation) lambda_[c] = number(node);
    for (int i = 0; i < dim; ++i)
      if (multiplier && !body.shape_fixed(node, i)) mu_(c, i) = number(node);
    for (int i = 0; i < dim; ++i) auxiliary_row_(node, i) = c < 0 ? d_(node, i) : mu_(c, i);
  }
  for (int node = 0; node < nodes; ++node) d_.row(node) = d_.row(body.shape_node(node)).eval();
  if (selection.deformation && body.counter_force) w_ = number(nodes);
}

namespace {

template <class Numbers, class Values>
void copy_in(const Numbers& numbers, std::span<const double> y, Values& values) {
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
    if (const int number = numbers.data()[k]; number >= 0) values.data()[k] = y[number];
}

template <class Numbers, class Values>
void copy_out(const Numbers& numbers, const Values& values, std::span<double> y) {
  for (Eigen::Index k = 0; k < numbers.size(); ++k)
    if (const int number = numbers.data()[k]; number >= 0) y[number] = values.data()[k];
}

}  // namespace

template <int dim>
void Unknowns<dim>::scatter(std::span<const double> y, NodalState<dim>& state) const {
  copy_in(u_, y, state.u);
  copy_in(d_, y, state.d);
  copy_in(lambda_, y, state.lambda);
  copy_in(mu_, y, state.mu);
  if (w_ >= 0) state.w = y[w_];
}

template <int dim>
void Unknowns<dim>::gather(const NodalState<dim>& state, std::span<double> y) const {
  copy_out(u_, state.u, y);
  copy_out(d_, state.d, y);
  copy_out(lambda_, state.lambda, y);
  copy_out(mu_, state.mu, y);
  if (w_ >= 0) y[w_] = state.w;
}

template struct NodalState<2>;
template struct NodalState<3>;
template class Unknowns<2>;
template class Unknowns<3>;

}  // namespace gnomon
