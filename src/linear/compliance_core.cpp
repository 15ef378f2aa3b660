#include "linear/compliance_core.hpp"

#include <algorithm>

#include "base/threads.hpp"

namespace gnomon {

namespace {

std::vector<NodeUnknowns> numbers_in_block(const PhaseContact& phase, const SymmetricPart& part) {
  std::vector<NodeUnknowns> numbers;
  for (const ContactEntries::Node& node : phase.nodes) {
    NodeUnknowns& of_node = numbers.emplace_back(node.u);
    for (int& number : of_node)
      if (number >= 0) number = part.number(number);
  }
  return numbers;
}

}  // namespace

ComplianceCore::ComplianceCore(const Structure& structure, const InnerSolverMaker& inner)
    : structure_(structure),
      column_cost_(inner.column_cost),
      stiffness_(structure, Role::stiffness, false, inner),
      contacts_(structure, stiffness_.owners()),
      compliance_(numbers_in_block(contacts_.phases().front(), stiffness_.part())),
      systems_(stiffness_.owners()),
      contact_columns_(structure, {Role::stiffness, Role::evolution, Role::rigid},
                       {Role::multiplier, Role::rigid}),
      wear_by_displacement_(structure, {Role::evolution}, {Role::stiffness}),
      wear_block_(structure, {Role::evolution}),
      contact_(structure.size) {}

void ComplianceCore::refresh(std::span<const double> J) {
  J_ = J;
  contacts_.update(J);
  wear_block_.factorize(J);
}

double ComplianceCore::in_applications(double solves) const {
  return solves / (1 + 2 * column_cost_ * static_cast<double>(stiffness_.owners()));
}

double ComplianceCore::update_cost() const {
  const auto missing = static_cast<double>(compliance_.missing(contacts_.touching()));
  return in_applications(column_cost_ * missing);
}

double ComplianceCore::set_up_cost() const {
  const auto columns = static_cast<double>(compliance_.columns());
  return in_applications(column_cost_ * columns + stiffness_.solver().set_up_cost());
}

int ComplianceCore::set_up(bool) {
  stiffness_.gather(J_);
  const int factorizations = stiffness_.set_up("the stiffness of the body");
  compliance_.clear();
  update();
  return factorizations;
}

void ComplianceCore::update() {
  compliance_.solve(contacts_.touching(), stiffness_);
  number_.assign(contacts_.entries().surfaces().size(), -1);
  int count = 0;
  for (const PhaseContact& phase : contacts_.phases())
    for (const ClosedNode& node : phase.closed)
      if (node.on.surface >= 0 && number_[node.on.surface] < 0) number_[node.on.surface] = count++;
  divide_among_threads(static_cast<long>(systems_.size()), [this](long p) { make_system(p); });
  Eigen::MatrixXd wear = Eigen::MatrixXd::Identity(count, count);
  for (std::size_t p = 0; p < systems_.size(); ++p)
    couple(contacts_.phases()[p], systems_[p], wear);
  if (count > 0) wear_.compute(wear);
  right_of_wear_.resize(count);
}

/// The columns of K^-1 (B, J_uw) at the closed nodes, three rows each.
Eigen::MatrixXd ComplianceCore::response(const PhaseContact& phase) const {
  const auto count = static_cast<Eigen::Index>(phase.closed.size());
  const auto rigid = static_cast<Eigen::Index>(phase.rigid.size());
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(most_components * count, count + rigid);
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index l = 0; l < count; ++l) {
      const auto G = compliance_.at(phase.closed[k].node, phase.closed[l].node);
      auto rows = moved.middleRows<most_components>(most_components * k);
      rows.col(l) = G * phase.closed[l].B;
      rows.rightCols(rigid) += G * phase.closed[l].uw;
    }
  return moved;
}

void ComplianceCore::make_system(std::size_t p) {
  const PhaseContact& phase = contacts_.phases()[p];
  const auto count = static_cast<Eigen::Index>(phase.closed.size());
  const auto rigid = static_cast<Eigen::Index>(phase.rigid.size());
  const Eigen::Index size = count + rigid;
  PhaseSystem& system = systems_[p];
  const Eigen::MatrixXd moved = response(phase);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd& V = system.wear = Eigen::MatrixXd::Zero(count, size);
  for (Eigen::Index k = 0; k < count; ++k) {
    const ClosedNode& node = phase.closed[k];
    const auto here = moved.middleRows<most_components>(most_components * k);
    A.row(k) -= node.L.transpose() * here;
    A(k, k) += node.ll;
    V.row(k) -= node.cu_m.transpose() * here;
    V(k, k) += node.e_m;
    A.row(k).tail(rigid) += node.lw.transpose();
    V.row(k).tail(rigid) += node.cw_m.transpose();
    A.col(k).tail(rigid) += node.wl;
    A.bottomRows(rigid) -= node.wu.transpose() * here;
  }
  for (Eigen::Index r = 0; r < rigid; ++r) {
    for (Eigen::Index l = 0; l < rigid; ++l)
      A(count + r, count + l) += contacts_.entries().at(phase.rigid[static_cast<std::size_t>(r)],
                                                        phase.rigid[static_cast<std::size_t>(l)]);
    // Nothing carries the force: the outer iteration will fail.
    if (A.col(count + r).isZero(0)) A(count + r, count + r) = 1;
  }
  if (size == 0) return;
  system.A.compute(A);
  Eigen::MatrixXd driven = Eigen::MatrixXd::Zero(size, count);
  for (Eigen::Index k = 0; k < count; ++k) driven(k, k) = phase.closed[k].a_m;
  system.fed_back = V * system.A.solve(driven);
}

/// Subtracts V_p A_p^-1 (a.m).
void ComplianceCore::couple(const PhaseContact& phase, const PhaseSystem& system,
                            Eigen::MatrixXd& wear) const {
  const auto count = static_cast<Eigen::Index>(phase.closed.size());
  for (Eigen::Index k = 0; k < count; ++k)
    for (Eigen::Index l = 0; l < count; ++l)
      if (const int i = of_surface(phase.closed[k]), j = of_surface(phase.closed[l]);
          i >= 0 && j >= 0)
        wear(i, j) -= system.fed_back(k, l);
}

int ComplianceCore::of_surface(const ClosedNode& node) const {
  return node.on.surface < 0 ? -1 : number_[node.on.surface];
}

/// Open nodes have a row of their own.
void ComplianceCore::solve_open(std::span<double> s, std::span<double> z) const {
  for (const PhaseContact& phase : contacts_.phases()) {
    auto closed = phase.closed.begin();
    for (std::size_t c = 0; c < phase.nodes.size(); ++c) {
      if (closed != phase.closed.end() && closed->node == static_cast<int>(c)) {
        ++closed;
        continue;
      }
      const int l = phase.nodes[c].multiplier;
      const double own = J_[structure_.pattern.find(l, l)];
      z[l] = own == 0 ? s[l] : s[l] / own;
    }
  }
  contact_columns_.subtract(J_, z, s);
}

/// f of every phase, and q.
void ComplianceCore::make_right_sides(std::span<const double> s, std::span<const double> x0) {
  right_of_wear_.setZero();
  for (std::size_t p = 0; p < systems_.size(); ++p) {
    const PhaseContact& phase = contacts_.phases()[p];
    const auto count = static_cast<Eigen::Index>(phase.closed.size());
    Eigen::VectorXd& f = systems_[p].right;
    const auto rigid = static_cast<Eigen::Index>(phase.rigid.size());
    f = Eigen::VectorXd::Zero(count + rigid);
    for (Eigen::Index r = 0; r < rigid; ++r)
      f[count + r] = s[phase.rigid[static_cast<std::size_t>(r)]];
    for (Eigen::Index k = 0; k < count; ++k) {
      const ClosedNode& node = phase.closed[k];
      const NodeValues x = values_at(phase.nodes[node.node].u, x0);
      f[k] = s[node.multiplier] - contacts_.entries().shape_part(node.on, s) - node.L.dot(x);
      f.tail(rigid) -= node.wu.transpose() * x;
      if (const int i = of_surface(node); i >= 0) right_of_wear_[i] += node.cu_m.dot(x);
    }
  }
}

/// The multipliers of closed nodes and the rigid motions, into contact_.
void ComplianceCore::solve_contact() {
  for (std::size_t p = 0; p < systems_.size(); ++p) {
    PhaseSystem& system = systems_[p];
    const PhaseContact& phase = contacts_.phases()[p];
    if (system.right.size() == 0) continue;
    const Eigen::VectorXd worn = system.wear * system.A.solve(system.right);
    for (std::size_t k = 0; k < phase.closed.size(); ++k)
      if (const int i = of_surface(phase.closed[k]); i >= 0)
        right_of_wear_[i] += worn[static_cast<Eigen::Index>(k)];
  }
  if (right_of_wear_.size() > 0) right_of_wear_ = wear_.solve(right_of_wear_).eval();
  std::fill(contact_.begin(), contact_.end(), 0.0);
  for (std::size_t p = 0; p < systems_.size(); ++p) {
    PhaseSystem& system = systems_[p];
    const PhaseContact& phase = contacts_.phases()[p];
    if (system.right.size() == 0) continue;
    for (std::size_t k = 0; k < phase.closed.size(); ++k)
      if (const int i = of_surface(phase.closed[k]); i >= 0)
        system.right[static_cast<Eigen::Index>(k)] += phase.closed[k].a_m * right_of_wear_[i];
    const Eigen::VectorXd y = system.A.solve(system.right);
    for (std::size_t k = 0; k < phase.closed.size(); ++k)
      contact_[phase.closed[k].multiplier] = y[static_cast<Eigen::Index>(k)];
    for (std::size_t r = 0; r < phase.rigid.size(); ++r)
      contact_[phase.rigid[r]] = y[static_cast<Eigen::Index>(phase.closed.size() + r)];
  }
}

void ComplianceCore::solve(std::span<double> s, std::span<double> z) {
  solve_open(s, z);
  stiffness_.scatter(stiffness_.solve(s), z);
  make_right_sides(s, z);
  solve_contact();
  contact_columns_.subtract(J_, contact_, s);
  stiffness_.scatter(stiffness_.solve(s), z);
  for (const PhaseContact& phase : contacts_.phases()) {
    for (const ClosedNode& node : phase.closed) z[node.multiplier] = contact_[node.multiplier];
    for (int w : phase.rigid) z[w] = contact_[w];
  }
  wear_by_displacement_.subtract(J_, z, s);
  wear_block_.solve(s, z);
}

std::unique_ptr<CoreSolver> make_compliance_core(const Structure& structure,
                                                 const InnerSolverMaker& inner) {
  return std::make_unique<ComplianceCore>(structure, inner);
}

}  // namespace gnomon
