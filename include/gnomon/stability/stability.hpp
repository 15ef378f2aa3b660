// Linear stability of explicit methods on the reduced ODE: the spectrum of
//
//   G = d(rate)/d(differential components),
//
// where the algebraic components follow (eq. 17), and the steps that it allows. docs/stability.md.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// Consistent states at ascending times in [0, ...) [time], by an accurate adaptive method at the
/// relative tolerance `rtol`, independent of the scene's method. Throws SolutionError.
std::vector<State> accurate_states(const Model& model, std::span<const double> times,
                                   Counters& counters, double rtol = 1e-5);

/// G at a consistent state on the smooth branch (active set) that the state lies in, as products
/// with vectors.
///
/// With J = dF/dy in blocks of differential (d) and algebraic (a) rows and columns, and
/// differential rows ydot + f = 0:   a = -J_aa^-1 J_ad v,   G v = -(J_dd v + J_da a).
/// J_aa is block-triangular: a follows stage by stage (System::algebraic_stages), each solved as in
/// a run, by the solver of its structure, so that J is never factorized as a whole.
class ReducedJacobian {
public:
  /// `system` must outlive it. Throws SolutionError when the algebraic rows are singular.
  ReducedJacobian(const System& system, const State& state);
  ~ReducedJacobian();

  /// Number of differential components.
  int size() const { return static_cast<int>(components_.size()); }
  /// Positions of the differential components in y.
  const std::vector<int>& components() const { return components_; }
  /// G v [1/time times the unit of v]; both have size() entries. The residuals of all stages are
  /// below 1e-10 of their right sides, or as small as rounding allows. Not safe for concurrent
  /// calls. Throws SolutionError where the stages cannot be solved.
  void multiply(std::span<const double> v, std::span<double> Gv) const;
  /// The whole matrix G, by size() products.
  Eigen::MatrixXd dense() const;
  /// The work done so far.
  const Counters& counters() const { return counters_; }

private:
  struct Stage;
  /// -J times the change of all components.
  void minus_jacobian_times_change() const;
  void solve(Stage& stage) const;

  const SparsePattern& pattern_;
  std::vector<int> components_;
  std::vector<double> J_;  // on pattern_
  mutable Counters counters_;
  std::vector<std::unique_ptr<Stage>> stages_;  // in the order in which they are solved
  mutable std::vector<double> change_, residual_;
};

/// An eigenvalue of G [1/time] and its direction (size() entries, of length one).
struct Mode {
  std::complex<double> eigenvalue;
  Eigen::VectorXcd direction;
};

/// The `count` modes of largest magnitude, in descending order, by Arnoldi iteration with implicit
/// restarts (all modes where G is too small for that; none where G = 0). Throws SolutionError when
/// it does not converge.
std::vector<Mode> leading_modes(const ReducedJacobian& G, int count);
/// Every mode, largest magnitude first, by the dense QR algorithm.
std::vector<Mode> all_modes(const Eigen::MatrixXd& G);

/// R(z) = 1 + z b^T (I - z A)^-1 1: the factor by which a step of size h multiplies the solution of
/// ydot = (z/h) y.
std::complex<double> stability_function(const ButcherTable& table, std::complex<double> z);
/// Largest r such that |R(x e^(i angle))| <= 1, to rounding, for all x up to r. Infinite where that
/// holds up to 2 s^2 for s stages: no explicit method reaches further.
double stability_boundary(const ButcherTable& table, double angle);

/// The largest step that amplifies no mode, and the mode that sets it.
struct CriticalStep {
  double step;  ///< [time]; infinite when no mode bounds it
  int mode;     ///< position in the modes; -1 when no mode bounds it
};

/// Modes that grow (Re > 0), which a method has to follow, do not limit the step, nor do modes a
/// hundred times slower than the fastest one, which every step near the critical one resolves.
CriticalStep critical_step(const ButcherTable& table, std::span<const Mode> modes);

/// Number of steps over which the growth of a perturbation is measured.
inline constexpr int onset_steps = 10;

/// The step size above which a small perturbation of a consistent state grows over several
/// nonlinear steps of the method, found by bisection from `guess` [time]. So that the state is at
/// rest and otherwise unchanged, its own rate is subtracted from the equations and time is frozen:
/// ydot = r(t_0, y) - r(t_0, y_0). Throws SolutionError if there is no onset between a tenth of the
/// guess and ten times the guess.
double empirical_onset(const Model& model, const Integrator& integrator, const State& state,
                       const Eigen::VectorXcd& direction, double guess);

}  // namespace gnomon
