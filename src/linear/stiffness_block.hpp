// A symmetric diagonal block of a Jacobian with its own solver.
#pragma once

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// The blocks of one role, of each owner one. All owners share one solver, that of the mean of
/// their matrices, which differ little: phases of a cycle deform one body. Without owners or
/// unknowns it solves nothing. Vectors have the system's size.
class StiffnessBlock {
public:
  /// `together`: all unknowns as one block, whoever owns them. Throws InputError where multigrid is
  /// chosen and not built in; Error where the blocks of two owners are not alike.
  StiffnessBlock(const Structure& structure, Role role, bool together,
                 const InnerSolverMaker& inner);
  StiffnessBlock(const StiffnessBlock&) = delete;
  StiffnessBlock& operator=(const StiffnessBlock&) = delete;

  std::size_t owners() const { return unknowns_.size(); }
  /// Unknowns of an owner, ascending.
  const std::vector<int>& unknowns(std::size_t owner = 0) const { return unknowns_[owner]; }
  const SymmetricPart& part() const { return parts_.front(); }
  long size() const { return static_cast<long>(unknowns_.front().size()); }
  bool empty() const { return !solver_; }
  bool is_set_up() const { return is_set_up_; }
  InnerSolver& solver() { return *solver_; }
  const InnerSolver& solver() const { return *solver_; }

  /// The matrix to be set up, on part().lower(): the mean over the owners.
  std::vector<double>& gather(std::span<const double> J);
  /// Sets up the solver. Returns how many factorizations were made. Throws RecoverableError, which
  /// names the block by `what`, where it is singular.
  int set_up(const char* what);
  /// x = approximately K^-1 s, the columns of all owners one after the other.
  std::span<double> solve(std::span<const double> s);
  void scatter(std::span<const double> x, std::span<double> z) const;

private:
  std::vector<std::vector<int>> unknowns_;  // by owner
  std::vector<SymmetricPart> parts_;
  StiffnessLayout layout_;
  std::unique_ptr<InnerSolver> solver_;
  std::vector<double> values_, of_owner_, b_, x_;
  bool is_set_up_ = false;
};

}  // namespace gnomon
