#include <algorithm>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/newton/branch_search.hpp>
#include <limits>
#include <utility>

namespace gnomon {

namespace {

std::vector<std::size_t> differences(const ActiveSet& a, const ActiveSet& b) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i]) result.push_back(i);
  return result;
}

}  // namespace

NewtonReport solve_by_branches(NewtonSolver& newton, const System& system, std::span<double> y) {
  constexpr int most = 200, patience = 3;
  ActiveSet branch = active_set(system, 0, y), before;
  std::vector<double> last(y.begin(), y.end());
  std::vector<std::size_t> wrong;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  NewtonReport report;
  for (int k = 0, in_vain = 0; k < most; ++k) {
    report = newton.solve(algebraic_function(system, &branch), y);
    if (!report.converged) {
      if (in_vain >= patience || before.empty()) return report;
      in_vain = patience;
      std::ranges::copy(last, y.begin());
      const ActiveSet tried = std::exchange(branch, before);
      branch[wrong.back()] = tried[wrong.back()];
      continue;
    }
    const ActiveSet own = active_set(system, 0, y);
    wrong = differences(branch, own);
    if (wrong.empty()) return report;
    in_vain = wrong.size() < fewest ? 0 : in_vain + 1;
    fewest = std::min(fewest, wrong.size());
    last.assign(y.begin(), y.end());
    before = branch;
    if (in_vain < patience)
      branch = own;
    else
      branch[wrong.back()] = own[wrong.back()];
  }
  report.converged = false;
  report.reason = "no smooth branch has its own solution";
  return report;
}

}  // namespace gnomon
