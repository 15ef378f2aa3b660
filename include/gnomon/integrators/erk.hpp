// Explicit Runge-Kutta methods on the reduced ODE, by ARKODE's ERKStep.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <memory>
#include <string>

namespace gnomon {

/// ERKStep on the differential components: y' = rate(t, y), where the rate follows from a solve of
/// the algebraic stages (AlgebraicSolver). Error control by ARKODE's PI controller in the norm of
/// ErrorNorm; or fixed steps, halved when a solve fails.
class ErkSolver : public Stepper {
public:
  /// `table`: name of one of ARKODE's explicit tables.
  ErkSolver(const System& system, const IntegratorSettings& settings, Counters& counters,
            const std::string& table);
  ~ErkSolver() override;
  std::vector<double> memory() const override;
  void restore(const State& state, std::span<const double> memory) override;
  bool follow(Stepper& before, const State& state, bool same) override;

private:
  StepReport take_step(State& state, double t_stop) override;
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gnomon
