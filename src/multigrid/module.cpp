// What src/linear/multigrid.cpp finds in this module.

#include <mutex>

#include "multigrid/multigrid.hpp"

namespace gnomon {

namespace {

/// PETSc may be used by one thread at a time.
std::mutex in_use;

class InTurn : public InnerSolver {
public:
  InTurn(const StiffnessLayout& layout, const std::vector<SparseRows>& interpolations) {
    const std::scoped_lock alone(in_use);
    solver_ = interpolations.empty() ? make_algebraic_multigrid(layout)
                                     : make_geometric_multigrid(layout, interpolations);
  }
  ~InTurn() override {
    const std::scoped_lock alone(in_use);
    solver_.reset();
  }

  bool set_up(std::span<const double> values) override {
    const std::scoped_lock alone(in_use);
    return solver_->set_up(values);
  }
  void apply(std::span<const double> b, std::span<double> x) override {
    const std::scoped_lock alone(in_use);
    solver_->apply(b, x);
  }
  int factorizations() const override { return solver_->factorizations(); }
  double set_up_cost() const override { return solver_->set_up_cost(); }

private:
  std::unique_ptr<InnerSolver> solver_;
};

}  // namespace

}  // namespace gnomon

extern "C" gnomon::InnerSolver* gnomon_new_multigrid(
    const gnomon::StiffnessLayout& layout, const std::vector<gnomon::SparseRows>& interpolations) {
  return new gnomon::InTurn(layout, interpolations);
}
