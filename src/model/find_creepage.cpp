#include "model/find_creepage.hpp"

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/system/composed_system.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "model/limit_of_friction.hpp"

namespace gnomon {

namespace {

template <int dim>
class CreepageSearch {
public:
  CreepageSearch(const WornBodyEquations<dim>& equations, Counters& counters)
      : equations_(equations),
        whole_(equations.composition(), equations.deformation()),
        given_(equations.composition(), equations.without_creepage()),
        solver_(whole_.structure(), counters, options()),
        solver_at_given_(given_.structure(), counters, options()) {
    for (int i = 0; i < whole_.structure().size; ++i)
      if (whole_.structure().block_of(i).name == "creepage") creepages_.push_back(i);
  }

  /// Newton's method, and where it goes astray, since the whole contact slips and creepage does not
  /// change the force, bisection of one creepage first.
  void operator()(FieldValues<dim>& values) {
    const std::string excess = this->excess(values);
    std::string reason;
    if (solves(values, reason)) return;
    if (creepages_.size() == 1)
      if (std::optional<Between> between = bracket(values))
        for (int k = 0; k < halvings; ++k) {
          if (k % 4 == 3 && solves(between->values, reason)) {
            values = std::move(between->values);
            return;
          }
          halve(*between);
        }
    throw SolutionError(
        "no creepage was found at which friction balances the forces along the surface: expected "
        "less than friction.coefficient times the force on it" +
        (excess.empty() ? "; " + reason : ", but " + excess));
  }

private:
  static constexpr int halvings = 40;
  static NewtonOptions options() { return {.max_iterations = 30, .keep_factors = true}; }

  /// Two creepages at which the force is too small and too large, and the state at one of them.
  struct Between {
    double one, other;
    bool positive;  ///< what the force lacks at `one`
    FieldValues<dim> values;
  };

  std::string excess(const FieldValues<dim>& values) const {
    std::vector<double> y(whole_.structure().size);
    whole_.numbering().gather(values, y);
    return excess_at_start(equations_.assembly(),
                           equations_.contact_nodes(whole_, values, {.t = 0, .y = y}));
  }

  bool solves(FieldValues<dim>& values, std::string& reason) {
    std::vector<double> y(whole_.structure().size);
    whole_.numbering().gather(values, y);
    const NewtonReport report = solver_.solve(algebraic_function(whole_), y);
    if (report.converged)
      whole_.numbering().scatter(y, values);
    else
      reason = report.reason;
    return report.converged;
  }

  /// What the force lacks at a creepage; nothing where there is no equilibrium.
  std::optional<double> lack(double creepage, FieldValues<dim>& values) {
    std::vector<double> y(whole_.structure().size), at(given_.structure().size);
    whole_.numbering().gather(values, y);
    y[creepages_.front()] = creepage;
    whole_.numbering().scatter(y, values);
    given_.freeze(values, 0);
    given_.numbering().gather(values, at);
    if (!solver_at_given_.solve(algebraic_function(given_), at).converged) return {};
    given_.numbering().scatter(at, values);
    whole_.numbering().gather(values, y);
    std::vector<double> F(y.size());
    algebraic_function(whole_).residual(y, F);
    return F[creepages_.front()];
  }

  /// From no creepage to both sides.
  std::optional<Between> bracket(const FieldValues<dim>& values) {
    constexpr int doublings = 17;
    double step = 1e-3 * whole_.structure().unknown_scale[creepages_.front()];
    struct Side {
      double at;
      FieldValues<dim> values;
    };
    Side ahead{0, values}, back{0, values};
    const std::optional<double> start = lack(0, ahead.values);
    if (!start) return {};
    for (int k = 0; k < doublings; ++k, step *= 2)
      for (const auto& [side, sign] : {std::pair(&ahead, 1.0), std::pair(&back, -1.0)}) {
        const double before = side->at;
        FieldValues<dim> there = side->values;
        const std::optional<double> found = lack(sign * step, there);
        if (!found) continue;
        if ((*found > 0) != (*start > 0))
          return Between{before, sign * step, *start > 0, std::move(side->values)};
        *side = {sign * step, std::move(there)};
      }
    return {};
  }

  void halve(Between& between) {
    const double middle = (between.one + between.other) / 2;
    FieldValues<dim> there = between.values;
    const std::optional<double> found = lack(middle, there);
    if (found && (*found > 0) == between.positive) {
      between.one = middle;
      between.values = std::move(there);
    } else {
      between.other = middle;
    }
  }

  const WornBodyEquations<dim>& equations_;
  ComposedSystem<dim> whole_, given_;
  NewtonSolver solver_, solver_at_given_;
  std::vector<int> creepages_;
};

}  // namespace

template <int dim>
void find_creepage(const WornBodyEquations<dim>& equations, FieldValues<dim>& values,
                   Counters& counters) {
  CreepageSearch<dim>(equations, counters)(values);
}

template void find_creepage(const WornBodyEquations<2>&, FieldValues<2>&, Counters&);
template void find_creepage(const WornBodyEquations<3>&, FieldValues<3>&, Counters&);

}  // namespace gnomon
