#include <gnomon/terms/stick_term.hpp>

#include "terms/independent_variables.hpp"

namespace gnomon {

namespace {

/// lambda | lambda_T | q | q before | u | parts of the place before | lambda before | mean of q |
/// shape of the patch
template <int dim>
inline constexpr int most_columns = 3 + 4 * dim + 2 * most_partner_unknowns + dim* max_patch_nodes;

template <int dim>
using Dual =
    Eigen::AutoDiffScalar<Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_columns<dim>, 1>>;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

template <class Row>
void append_row(std::vector<int>& to, const Row& row) {
  for (Eigen::Index i = 0; i < row.size(); ++i) to.push_back(row[i]);
}

}  // namespace

template <int dim>
StickTerm<dim>::StickTerm(const StickState<dim>& state, FieldId d, const Numbering& numbering)
    : state_(state),
      motion_(state.contact),
      d_(d),
      u_numbers_(numbering.nodal<dim>(state.contact.u)),
      d_numbers_(numbering.nodal<dim>(d)),
      traction_numbers_(numbering.nodal<dim>(state.traction)) {
  const ContactState<dim>& contact = state.contact;
  surfaces_.assign(contact.laws.size(), {contact.parameters, state.rho, state.share,
                                         d_numbers_.size() > 0 && d_numbers_.maxCoeff() >= 0,
                                         state.factor, state.path, state.rolling});
  for (std::size_t k = 0; k < surfaces_.size(); ++k) surfaces_[k].contact.wear = contact.laws[k];
  if (state.memory.s != FieldId::none) memory_numbers_ = numbering.nodal<dim>(state.memory.s);
  for (int c = 0; c < count(); ++c) {
    std::vector<int>& before = before_numbers_.emplace_back();
    for (const PartOfPlace& part : state.before[c])
      for (int i = 0; i < dim; ++i) before.push_back(numbering.number(part.field, part.row, i));
    lambda_numbers_.push_back(numbering.number(contact.lambda, c));
    lambda_before_numbers_.push_back(numbering.number(state.lambda_before, c));
    first_switch_.push_back(first_switch_.back() + 2 + parameters(c).contact.wear.kinks());
  }
  const auto guides = static_cast<Eigen::Index>(contact.parameters.counter_body.guides.size());
  for (Eigen::Index k = 0; k < guides; ++k) {
    q_numbers_.push_back(numbering.number(contact.q, k));
    q_before_numbers_.push_back(state.q_before ? numbering.number(*state.q_before, k) : -1);
  }
  if (contact.mean_power != FieldId::none)
    mean_number_.push_back(numbering.number(contact.mean_power, 0));
}

template <int dim>
double StickTerm<dim>::weight(int c) const {
  const ContactState<dim>& contact = state_.contact;
  return contact.part * (contact.wear_weight.empty() ? 1 : contact.wear_weight[c]);
}

/// u | lambda | lambda_T | d (wear) | q | mean of q
template <int dim>
std::vector<int> StickTerm<dim>::row_numbers(int c) const {
  const ContactPatch<dim>& patch = state_.contact.patches[c];
  std::vector<int> rows;
  append_row(rows, u_numbers_.row(patch.node));
  rows.push_back(lambda_numbers_[c]);
  append_row(rows, traction_numbers_.row(c));
  for (int i = 0; i < dim; ++i) rows.push_back(patch.may_move() ? d_numbers_(patch.node, i) : -1);
  append(rows, q_numbers_);
  append(rows, mean_number_);
  return rows;
}

template <int dim>
std::vector<int> StickTerm<dim>::column_numbers(int c) const {
  const ContactPatch<dim>& patch = state_.contact.patches[c];
  std::vector<int> columns = {lambda_numbers_[c]};
  append_row(columns, traction_numbers_.row(c));
  append(columns, q_numbers_);
  append(columns, q_before_numbers_);
  append_row(columns, u_numbers_.row(patch.node));
  append(columns, before_numbers_[c]);
  columns.push_back(lambda_before_numbers_[c]);
  append(columns, mean_number_);
  for (const int node : patch.nodes) append_row(columns, d_numbers_.row(node));
  return columns;
}

template <int dim>
std::vector<int> StickTerm<dim>::memory_rows(int c) const {
  std::vector<int> rows;
  append_row(rows, memory_numbers_.row(c));
  return rows;
}

/// Of the rows of s: what r depends on, q, u and the shape of its node, then s.
template <int dim>
std::vector<int> StickTerm<dim>::memory_columns(int c) const {
  const int node = state_.contact.patches[c].node;
  std::vector<int> columns = q_numbers_;
  append_row(columns, u_numbers_.row(node));
  append_row(columns, d_numbers_.row(node));
  append_row(columns, memory_numbers_.row(c));
  return columns;
}

template <int dim>
void StickTerm<dim>::declare(TermStructure& structure) const {
  for (int c = 0; c < count(); ++c) {
    structure.pattern.add(row_numbers(c), column_numbers(c));
    declare_switches(state_.contact.patches[c].node, 2, parameters(c).contact.wear, structure);
    if (state_.is_last) structure.pattern.add(memory_rows(c), memory_columns(c));
  }
  declare_times(state_.contact.laws, state_.contact.parameters.counter_body.guides, structure);
  append(structure.breakpoints, state_.factor.breakpoints());
}

template <int dim>
void StickTerm<dim>::map_to(const SparsePattern& pattern) {
  map_.clear();
  memory_map_.clear();
  for (int c = 0; c < count(); ++c) {
    map_.push_back(pattern.positions(row_numbers(c), column_numbers(c)));
    if (state_.is_last) memory_map_.push_back(pattern.positions(memory_rows(c), memory_columns(c)));
  }
}

/// Variables are in the order of the columns.
template <int dim>
template <class Scalar>
StickInput<dim, Scalar> StickTerm<dim>::gather(const Evaluation<dim>& at, int c) const {
  const ContactState<dim>& contact = state_.contact;
  const ContactPatch<dim>& patch = contact.patches[c];
  const auto& guides = contact.parameters.counter_body.guides;
  const std::vector<PartOfPlace>& parts = state_.before[c];
  const auto size = static_cast<Eigen::Index>(patch.nodes.size());
  PatchNodal<dim> X(size, dim), u(size, dim);
  for (Eigen::Index p = 0; p < size; ++p) {
    const int node = patch.nodes[p];
    X.row(p) = contact.mesh.nodes[node].transpose() + at.values.vector(d_).row(node);
    u.row(p) = at.values.vector(contact.u).row(node);
  }
  IndependentVariables<Scalar> variable(2 + 2 * dim + 2 * std::ssize(guides) +
                                        std::ssize(mean_number_) +
                                        dim * (std::ssize(parts) + size));
  StickInput<dim, Scalar> input;
  input.contact.lambda = variable(at.values.scalar(contact.lambda)[c]);
  input.traction = variable(at.values.vector(state_.traction).row(c).transpose());
  input.contact.q = variable(motion_.at(at, contact.q));
  const PartnerMotion<Scalar> q_before =
      variable(motion_.at(at, state_.q_before.value_or(FieldId::none)));
  input.contact.u = u.template cast<Scalar>();
  input.contact.u.row(0) = variable(u.row(0).transpose()).transpose();
  input.before.setZero();
  for (const PartOfPlace& part : parts)
    input.before +=
        Scalar(part.factor) * variable(at.values.vector(part.field).row(part.row).transpose());
  input.lambda_before = variable(at.values.scalar(state_.lambda_before)[c]);
  if (!mean_number_.empty())
    input.contact.mean_power = variable(at.values.scalar(contact.mean_power)[0]);
  input.contact.X = variable(X);
  input.contact.moment = {.time = at.t, .slid = contact.nominal_speed * at.t, .within = at.within};
  input.contact.clearance = contact.clearance(at);
  input.interval = state_.interval[c];
  input.rubs = !parts.empty();
  if (state_.passed.size() > 0)
    input.before -= state_.passed.row(c).transpose().template cast<Scalar>();
  if (!state_.q_before) return input;
  const Vector<dim, Scalar> X_node = input.contact.X.row(0).transpose(), u_before = input.before;
  input.before = state_.path.place(state_.path.before, guides, q_before, X_node, u_before);
  return input;
}

template <int dim>
StickBranch StickTerm<dim>::branch(const Evaluation<dim>& at, int c) const {
  if (at.branch.empty()) return {};
  const auto of_node = own(at.branch, c);
  return {{of_node[0] ? Branch::closed : Branch::open, of_node.subspan(2)}, of_node[1] != 0};
}

template <int dim>
StickNode<dim> StickTerm<dim>::node(const Evaluation<dim>& at, int c) const {
  return {parameters(c), state_.contact.patches[c], gather<double>(at, c), branch(at, c)};
}

template <int dim>
std::vector<ContactNode<dim>> StickTerm<dim>::nodes(const Evaluation<dim>& at) const {
  std::vector<ContactNode<dim>> result;
  for (int c = 0; c < count(); ++c) result.push_back(node(at, c).contact);
  return result;
}

template <int dim>
NodalField<dim> StickTerm<dim>::places(const Evaluation<dim>& at) const {
  NodalField<dim> result(count(), dim);
  for (int c = 0; c < count(); ++c) result.row(c) = node(at, c).place.transpose();
  return result;
}

template <int dim>
void StickTerm<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  for (int c = 0; c < count(); ++c) {
    const StickNode<dim> met = node(at, c);
    const ContactNode<dim>& contact = met.contact;
    const std::vector<int> rows = row_numbers(c);
    Eigen::VectorXd values(static_cast<Eigen::Index>(rows.size()));
    values << contact.force, contact.constraint, met.constraint, -weight(c) * contact.velocity,
        contact.partner, Eigen::VectorXd::Constant(std::ssize(mean_number_), met.lacks);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k] >= 0) F[rows[k]] += values[static_cast<Eigen::Index>(k)];
    if (!state_.is_last) continue;
    for (int i = 0; i < dim; ++i)
      if (const int row = memory_numbers_(c, i); row >= 0)
        F[row] += state_.memory.residual(at, c, i, row, met.place[i]);
  }
}

template <int dim>
Eigen::MatrixXd StickTerm<dim>::tangent(const Evaluation<dim>& at, int c) const {
  const auto input = gather<Dual<dim>>(at, c);
  const StickNode<dim, Dual<dim>> met(parameters(c), state_.contact.patches[c], input,
                                      branch(at, c));
  const Eigen::Index guides = input.contact.q.size(),
                     columns = input.contact.lambda.derivatives().size();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(
      1 + (state_.is_last ? 4 : 3) * dim + guides + std::ssize(mean_number_), columns);
  Eigen::Index row = 0;
  const auto put = [&](const Dual<dim>& value, double factor = 1) {
    if (value.derivatives().size() > 0) K.row(row) = factor * value.derivatives().transpose();
    ++row;
  };
  for (int i = 0; i < dim; ++i) put(met.contact.force[i]);
  put(met.contact.constraint);
  for (int i = 0; i < dim; ++i) put(met.constraint[i]);
  for (int i = 0; i < dim; ++i) put(met.contact.velocity[i], -weight(c));
  for (Eigen::Index k = 0; k < guides; ++k) put(met.contact.partner[k]);
  if (!mean_number_.empty()) put(met.lacks);
  for (int i = 0; state_.is_last && i < dim; ++i) put(met.place[i]);
  return K;
}

/// Of the rows of s. `place_by`: derivatives of r by the columns of the node.
template <int dim>
void StickTerm<dim>::add_memory(const Evaluation<dim>& at, int c, double rate_weight,
                                const Eigen::MatrixXd& place_by, std::span<double> values) const {
  const auto guides = static_cast<Eigen::Index>(q_numbers_.size()),
             shape = dim * static_cast<Eigen::Index>(state_.contact.patches[c].nodes.size());
  Eigen::MatrixXd by(dim, guides + 3 * dim);
  const double rate = 1 / state_.memory.period;
  by << -rate * place_by.middleCols(1 + dim, guides),
      -rate * place_by.middleCols(1 + dim + 2 * guides, dim),
      -rate * place_by.middleCols(place_by.cols() - shape, dim),
      state_.memory.by_s(at, c, rate_weight) * Tensor<dim>::Identity();
  const std::vector<int>& map = memory_map_[static_cast<std::size_t>(c)];
  for (std::size_t k = 0; k < map.size(); ++k)
    if (map[k] >= 0) values[map[k]] += by.data()[k];
}

template <int dim>
void StickTerm<dim>::add_jacobian(const Evaluation<dim>& at, double rate_weight,
                                  std::span<double> values) const {
  for (int c = 0; c < count(); ++c) {
    const Eigen::MatrixXd K = tangent(at, c);
    const Eigen::Index rows = K.rows() - (state_.is_last ? dim : 0);
    std::size_t k = 0;
    for (Eigen::Index column = 0; column < K.cols(); ++column)
      for (Eigen::Index row = 0; row < rows; ++row, ++k)
        if (map_[c][k] >= 0) values[map_[c][k]] += K(row, column);
    if (state_.is_last) add_memory(at, c, rate_weight, K.bottomRows(dim), values);
  }
}

template <int dim>
void StickTerm<dim>::switching(const Evaluation<dim>& at, std::span<double> values) const {
  for (int c = 0; c < count(); ++c) {
    const auto input = gather<double>(at, c);
    const StickBranch given = branch(at, c);
    const StickNode<dim> met(parameters(c), state_.contact.patches[c], input, given);
    const std::span<double> of_node = own(values, c);
    std::ranges::copy(met.switching, of_node.begin());
    if (of_node.size() > 2)
      parameters(c).contact.wear.switching(
          wear_input(state_.contact.patches[c], met.wear, input.contact.moment), of_node.subspan(2),
          given.contact.wear);
  }
}

template class StickTerm<2>;
template class StickTerm<3>;

}  // namespace gnomon
