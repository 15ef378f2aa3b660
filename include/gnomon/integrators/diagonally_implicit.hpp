// Runge-Kutta methods by their tables: diagonally implicit ones on the DAE, including the implicit
// Euler and theta methods, and explicit ones.
#pragma once

#include <functional>
#include <gnomon/integrators/butcher_table.hpp>
#include <gnomon/integrators/dense_output.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/one_step.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/newton/newton.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

/// Stage i solves, by one KINSOL solve of the coupled system,
///
///   F(t_n + c_i h, y_i, ydot_i) = 0,   ydot_i = (d_i - d_n - h sum_{j<i} A_ij k_j) / (h A_ii),
///
/// on the differential components d; k_i = ydot_i. An explicit first stage is the state itself. The
/// step ends on the last stage of a stiffly accurate method; otherwise d_{n+1} = d_n + h sum b_i
/// k_i, and the algebraic components are solved for.
///
/// Error: h sum (b_i - b^_i) k_i of the embedded method; for the theta family, which has none, the
/// difference from the quadrature of the rates by the parabola through the last three of them:
/// (1/2 - alpha) h (k_{n+1} - k_n) - h^3/6 k[t_{n-1}, t_n, t_{n+1}], with alpha of eq. (21).
///
/// Integral: h sum b_i g_i, where g_i is the integrand at stage i.
///
/// A step that settles (AttemptOptions::settles) is two steps of the implicit Euler method, which
/// damps stiff components at once.
class DiagonallyImplicit : public OneStepMethod {
public:
  DiagonallyImplicit(const System& system, const IntegratorSettings& settings, Counters& counters,
                     ButcherTable table);

  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override;
  void accept(const State& state, bool kink) override;
  void interpolate(double t, std::span<double> y) const override { dense_output_.evaluate(t, y); }
  std::vector<double> memory() const override;
  void restore(std::span<const double> memory) override;

private:
  using Rates = std::vector<double>;  // one entry per differential component
  std::string solve_stage(const ButcherTable& table, int i, const State& from, double h,
                          const AttemptOptions& options, State& to);
  NewtonReport solve(double t, double step, const Rates& base, const State& from,
                     const AttemptOptions& options, State& to);
  std::string continue_in_step(double t, double step, const Rates& base, const State& from,
                               const AttemptOptions& options, State& to);
  void set_rates_of(double step, const Rates& base, std::span<const double> y,
                    std::span<double> ydot) const;
  void add_error_of_jumps(const State& from, double h, double part, const State& stage,
                          Attempt& whole) const;
  double estimate(const ButcherTable& table, const State& from, double h, const State& to);

  const System& system_;
  Counters& counters_;
  ButcherTable table_;
  ErrorNorm norm_;
  bool error_control_;  // else steps are fixed, and do not follow jumps
  std::function<double(const Point&)> integrand_;
  double short_step_;  // below it a difference of d over the step has fewer than ten digits
  NewtonSolver newton_;
  SlowPart slow_;                             // of its Jacobian
  std::optional<AlgebraicSolver> algebraic_;  // made when first needed
  DenseOutput dense_output_;
  std::vector<Rates> k_;
  Rates base_, error_;
  // Rates at the last accepted point and the one before, for methods without an embedded one.
  // A step that settles gives no new one.
  bool settled_ = false;  // the last attempt
  double t_new_ = 0, t_old_ = 0;
  Rates rate_new_, rate_old_;
};

/// The registry entry's `make` for such a method. Throws RegistrationError like
/// checked_table(table).
std::unique_ptr<Stepper> make_diagonally_implicit(const System& system,
                                                  const IntegratorSettings& settings,
                                                  Counters& counters, const ButcherTable& table);

/// An explicit Runge-Kutta method on the reduced ODE, by ARKODE's ERKStep and a table with an
/// embedded method. Error control by ARKODE's PI controller in the norm of ErrorNorm; or fixed
/// steps, halved when a solve fails. Throws RegistrationError for another table.
std::unique_ptr<Stepper> make_erk(const System& system, const IntegratorSettings& settings,
                                  Counters& counters, const ButcherTable& table);

}  // namespace gnomon
