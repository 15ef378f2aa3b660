// A symmetric diagonal block of a Jacobian with its own solver.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// The blocks of one role, of each owner one. They share one solver, that of the mean of their
/// matrices, which differ little: phases of a cycle deform the same bodies. Without owners or
/// unknowns it solves nothing. Vectors have the system's size.
class StiffnessBlock {
public:
  /// `joined`: unknowns that the matrix may couple beside those that J does. Throws InputError
  /// where multigrid is chosen and not built in; Error where the blocks of two owners are not
  /// alike.
  StiffnessBlock(const Structure& structure, Role role, const InnerSolverMaker& inner,
                 const std::vector<std::vector<int>>& joined = {})
      : unknowns_(by_owner(structure, role)) {
    for (const std::vector<int>& unknowns : unknowns_) {
      if (unknowns.size() != unknowns_.front().size())
        throw Error("the stiffness blocks of two contact states are not alike");
      parts_.emplace_back(structure.pattern, unknowns, joined);
    }
    // Each phase may couple other nodes of two bodies by the turning of their normals.
    for (SymmetricPart& other : parts_) parts_.front().keep_common(other.lower());
    for (SymmetricPart& other : parts_) other.keep_common(part().lower());
    b_.resize(unknowns_.size() * unknowns().size());
    x_.resize(b_.size());
    if (unknowns().empty()) return;
    layout_.lower = part().lower();
    lay_out(structure);
    solver_ = inner.make(layout_);
  }

  StiffnessBlock(const StiffnessBlock&) = delete;
  StiffnessBlock& operator=(const StiffnessBlock&) = delete;

  std::size_t owners() const { return unknowns_.size(); }
  /// Unknowns of an owner, ascending.
  const std::vector<int>& unknowns(std::size_t owner = 0) const { return unknowns_[owner]; }
  const SymmetricPart& part() const { return parts_.front(); }
  long size() const { return static_cast<long>(unknowns_.front().size()); }
  bool empty() const { return !solver_; }
  bool is_set_up() const { return is_set_up_; }
  InnerSolver& solver() const { return *solver_; }

  /// The matrix to be set up, on part().lower(): the mean over the owners.
  std::vector<double>& gather(std::span<const double> J) {
    parts_.front().gather(J, values_);
    for (std::size_t owner = 1; owner < owners(); ++owner) {
      parts_[owner].gather(J, of_owner_);
      for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += of_owner_[k];
    }
    for (double& value : values_) value /= static_cast<double>(owners());
    return values_;
  }
  /// Adds a spring to each unknown, as a part of its own stiffness. The compliance of a body of 1e4
  /// nodes grows by some 1e3, which leaves twelve digits of what differs in it.
  void add_soft_springs() {
    constexpr double part_of_own = 1e-7;
    for (double* value : diagonal()) *value *= 1 + part_of_own;
  }
  /// Sets up the solver. Where the matrix has no factors, as of bodies that contact alone holds,
  /// with a larger diagonal: it only preconditions. Returns how many factorizations were made.
  /// Throws RecoverableError, which names the block by `what`, where that is singular, too.
  int set_up(const char* what) {
    if (empty()) return 0;
    bool done = solver_->set_up(values_);
    int made = solver_->factorizations();
    for (const double shift : {1e-2, 1e-1, 1.0}) {
      if (done) break;
      enlarge_diagonal(shift);
      done = solver_->set_up(values_);
      made += solver_->factorizations();
    }
    if (!done) throw RecoverableError(std::string(what) + " is singular");
    is_set_up_ = true;
    return made;
  }
  /// x = approximately K^-1 s, the columns of all owners one after the other.
  std::span<double> solve(std::span<const double> s) {
    auto target = b_.begin();
    for (const std::vector<int>& unknowns : unknowns_)
      for (int i : unknowns) *target++ = s[i];
    if (!empty()) solver_->apply(b_, x_);
    return x_;
  }
  void scatter(std::span<const double> x, std::span<double> z) const {
    auto source = x.begin();
    for (const std::vector<int>& unknowns : unknowns_)
      for (int i : unknowns) z[i] = *source++;
  }

private:
  void lay_out(const Structure& structure) {
    layout_.position = structure.position;
    layout_.coarsening = structure.coarsening;
    for (int i : unknowns()) {
      layout_.group.push_back(structure.group[i]);
      layout_.component.push_back(structure.component[i]);
    }
  }
  /// Of the values.
  std::vector<double*> diagonal() {
    const SparsePattern& lower = part().lower();
    std::vector<double*> result;
    for (int column = 0; column < lower.size(); ++column)
      if (const int at = lower.find(column, column); at >= 0)
        result.push_back(&values_[static_cast<std::size_t>(at)]);
    return result;
  }
  /// By a part of its mean magnitude, and to positive values.
  void enlarge_diagonal(double part_of_mean) {
    double mean = 0;
    for (const double* value : diagonal()) mean += std::abs(*value) / part().lower().size();
    for (double* value : diagonal()) *value = std::abs(*value) + part_of_mean * mean;
  }
  static std::vector<std::vector<int>> by_owner(const Structure& structure, Role role) {
    std::map<int, std::vector<int>> owned;
    for (int i : unknowns_of(structure, {role})) owned[structure.block_of(i).owner].push_back(i);
    std::vector<std::vector<int>> result;
    for (auto& [owner, unknowns] : owned) result.push_back(std::move(unknowns));
    if (result.empty()) result.emplace_back();
    return result;
  }
  std::vector<std::vector<int>> unknowns_;  // by owner
  std::vector<SymmetricPart> parts_;
  StiffnessLayout layout_;
  std::unique_ptr<InnerSolver> solver_;
  std::vector<double> values_, of_owner_, b_, x_;
  bool is_set_up_ = false;
};

}  // namespace gnomon
