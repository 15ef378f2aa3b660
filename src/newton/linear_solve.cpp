#include <algorithm>
#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/newton/linear_solve.hpp>
#include <limits>
#include <utility>

#include "newton/krylov.hpp"

namespace gnomon {

using namespace sundials;

class LinearSolve::Memory {
public:
  Memory(const Structure& structure, Counters& counters)
      : structure_(structure), counters_(counters) {
    if (structure.solver.method != LinearSolverChoice::Method::block) return;
    x_ = make_vector(structure.size, context_);
    block_ = std::make_unique<BlockSolver>(structure, counters, context_);
  }

  void set_up(std::span<const double> J) {
    J_ = J;
    by_factors_ = !block_ || rest_ > 0;
    if (rest_ > 0) --rest_;
    if (by_factors_) return factorize();
    if (serves([&] { block_->set_up(J); })) return;
    give_up_blocks();
    factorize();
  }

  void solve(std::span<const double> b, std::span<double> x, double reduction) {
    ++counters_.linear_solves;
    if (!by_factors_ && rest_ > 0) factorize();  // the last solve has given the blocks up
    if (!by_factors_) {
      if (serves([&] { solve_by_blocks(b, x, reduction); })) return;
      give_up_blocks();
      factorize();
    }
    if (x.data() != b.data()) return lu_->solve(b, x);
    const std::vector<double> right(b.begin(), b.end());  // IDA solves in place
    lu_->solve(right, x);
  }

private:
  void solve_by_blocks(std::span<const double> b, std::span<double> x, double reduction) {
    // The reduction that a solve must reach to be useful to Newton's method.
    constexpr double useful = 0.3;
    // Where factors are affordable, an iteration of GMRES costs next to nothing, and a solve that
    // stays behind is not accepted. With 1e-4 a light load on a stiff, nearly incompressible pin
    // takes 306 instead of 82 Newton iterations.
    constexpr double loosest = 1e-8;
    std::copy(b.begin(), b.end(), view(x_.get()).begin());
    // More iterations than this, with a fresh preconditioner, cost more than those factors.
    constexpr int most_worth = 40;
    if (structure_.solver.direct_at_failure) {
      block_->solve(x_.get(), x_.get(), std::min(reduction, loosest), loosest);
      if (block_->fresh_iterations() > most_worth) give_up_blocks();
    } else
      block_->solve(x_.get(), x_.get(), reduction, useful);
    std::ranges::copy(view(x_.get()), x.begin());
  }

  /// Whether the blocks could do it; throws if nothing else is at hand.
  template <class Task>
  bool serves(const Task& task) {
    if (!structure_.solver.direct_at_failure) return task(), true;
    try {
      return task(), true;
    } catch (const RecoverableError&) {
      return false;
    }
  }

  /// Where the blocks fail, or are slow, they mostly are so again: for some set-ups they are not
  /// tried, after the second time never.
  void give_up_blocks() {
    constexpr int set_ups_without_blocks = 20;
    constexpr int never = std::numeric_limits<int>::max();
    rest_ = std::exchange(given_up_, true) ? never : set_ups_without_blocks;
  }

  /// Until the next set-up, factors of the whole Jacobian solve.
  void factorize() {
    if (!lu_) lu_ = std::make_unique<SparseLu>(structure_.pattern, structure_.group);
    ++counters_.factorizations;
    if (!lu_->factorize(J_)) throw RecoverableError("the Jacobian is singular");
    by_factors_ = true;
  }

  const Structure& structure_;
  Counters& counters_;
  // Destroyed in reverse: the context last.
  Context context_;
  VectorOwner x_;  // of the blocks: right side, then solution
  std::unique_ptr<BlockSolver> block_;
  std::unique_ptr<SparseLu> lu_;  // made when first needed
  std::span<const double> J_;
  bool by_factors_ = false;
  int rest_ = 0;  // set-ups for which the blocks are not tried again
  bool given_up_ = false;
};

LinearSolve::LinearSolve(const Structure& structure, Counters& counters)
    : memory_(std::make_unique<Memory>(structure, counters)) {}
LinearSolve::~LinearSolve() = default;

void LinearSolve::set_up(std::span<const double> J) {
  memory_->set_up(J);
}

void LinearSolve::solve(std::span<const double> b, std::span<double> x, double reduction) {
  memory_->solve(b, x, reduction);
}

}  // namespace gnomon
