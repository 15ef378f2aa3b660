// IDA on a model, as the integrator bdf uses it: set up in bdf_callbacks.cpp, advanced in bdf.cpp.
#pragma once

#include <idas/idas.h>

#include <gnomon/integrators/closings.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <optional>

#include "integrators/root_branch.hpp"
#include "newton/semismooth_newton.hpp"

namespace gnomon {

/// integrator.max_order.
const Key& max_order_key();

/// IDA on the DAE of a model. The error test contains only the differential components (weighted
/// root mean square over them; docs/integrators.md says which errors this does not control).
class BdfMemory {
public:
  BdfMemory(const System& system, const IntegratorSettings& settings, Counters& counters);
  StepReport advance(State& state, double t_stop);
  bool begun() const { return begun_; }
  const System& system() const { return *system_; }
  /// Goes on with another system of the same unknowns.
  void adopt(const System& system, const IntegratorSettings& settings);
  const IntegratorSettings& settings() const { return settings_; }

private:
  /// What IDA solves with; made for one pattern.
  struct Solvers {
    sundials::MatrixOwner matrix;
    sundials::LinearSolverOwner linear;
    sundials::NonlinearSolverOwner nonlinear;
  };
  Solvers make_solvers();
  static int residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector F, void* self);
  static int jacobian(sunrealtype t, sunrealtype alpha, N_Vector y, N_Vector ydot, N_Vector F,
                      SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector);
  static int weights(N_Vector y, N_Vector w, void* self);
  static int switching(sunrealtype t, N_Vector y, N_Vector ydot, sunrealtype* values, void* self);
  static int integrand(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector value, void* self);
  void begin(const State& state);
  bool cross_event(State& state, bool at_root, StepReport& report);
  void restart(const State& state);
  StepReport skip_to(State& state, double t);
  void count_rejected();
  bool vanishes(double step);
  double take_integral();
  int step(double t_stop, State& reached);
  double settling_stop(const std::optional<Settling>& settling, double t, double t_stop) const;
  bool needs_settling(const std::optional<Settling>& settling, double t,
                      const State& reached) const;
  ActiveSet active(const State& state) const {
    return branch() ? *branch() : active_set(*system_, state.t, state.y);
  }
  const ActiveSet* branch() const { return branch_ ? &branch_->active() : nullptr; }
  [[noreturn]] void fail(int flag, double t) const;

  const System* system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ErrorNorm norm_;
  JumpControl jumps_;
  std::optional<Closings> closings_;  // only with settled times
  bool begun_ = false;
  long rejected_ = 0;
  double first_step_ = 0;                     // after a restart; 0: IDA chooses
  double from_ = 0;                           // start of the step, on whose side of a jump it lies
  int vanishing_ = 0;                         // steps, one after the other
  double integrated_ = 0;                     // value of the quadrature at the start of the step
  std::optional<RootBranch> branch_;          // while events are located
  std::optional<AlgebraicSolver> algebraic_;  // made at the first event
  sundials::LinearRequest request_;
  SlowPart slow_;  // of the Jacobian
  sundials::Guard guard_;
  // Destroyed in reverse: IDA before what it refers to, the context last.
  sundials::Context context_;
  sundials::VectorOwner y_, ydot_, id_, probe_, integral_;
  Solvers solvers_;
  sundials::Owner<void, IDAFree> ida_;
};

}  // namespace gnomon
