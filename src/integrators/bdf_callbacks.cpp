// How IDA is set up for a model, and what it calls.
#include <algorithm>
#include <cmath>
#include <gnomon/integrators/stop_rules.hpp>

#include "integrators/bdf_memory.hpp"

namespace gnomon {

using namespace sundials;

namespace {
/// How many steps need to damp a closing.
constexpr int steps_to_damp = 5;
}  // namespace

BdfMemory::BdfMemory(const System& system, const IntegratorSettings& settings, Counters& counters)
    : system_(&system),
      settings_(settings),
      counters_(counters),
      norm_(system.structure(), settings),
      jumps_(system, settings),
      y_(make_vector(system.structure().size, context_)),
      ydot_(make_vector(system.structure().size, context_)),
      id_(make_vector(system.structure().size, context_)),
      probe_(make_vector(system.structure().size, context_)),
      integral_(make_vector(1, context_)) {
  const auto& differential = system.structure().differential;
  std::copy(differential.begin(), differential.end(), view(id_.get()).begin());
  solvers_ = make_solvers();
}

BdfMemory::Solvers BdfMemory::make_solvers() {
  const Structure& structure = system_->structure();
  const auto state_at = [this](N_Vector ycor) {
    N_Vector predicted = nullptr;
    sunrealtype t, gamma;
    N_Vector yy, yp, res;
    void* user = nullptr;
    check(
        IDAGetNonlinearSystemData(ida_.get(), &t, &predicted, &res, &yy, &yp, &res, &gamma, &user),
        "IDAGetNonlinearSystemData");
    N_VLinearSum(1.0, predicted, 1.0, ycor, probe_.get());
    return Point{t, view(probe_.get())};
  };
  const auto branch_at = [this](const Point& at) {
    return branch() ? *branch() : active_set(*system_, at.t, at.y);
  };
  return {make_matrix(structure.pattern, context_),
          make_linear_solver(structure, counters_, guard_, context_, request_),
          make_semismooth_newton(structure, counters_, guard_,
                                 within_time_error(newton_in_ida, settings_.nonlinear_fraction),
                                 state_at, branch_at, id_.get(), request_, slow_, context_)};
}

/// IDA keeps its handles, and what they hold is made for the new pattern.
void BdfMemory::adopt(const System& system, const IntegratorSettings& settings) {
  system_ = &system;
  settings_ = settings;
  norm_ = ErrorNorm(system.structure(), settings);
  algebraic_.reset();
  slow_ = {};
  if (branch_) branch_->adopt(system);
  Solvers fresh = make_solvers();
  std::swap(solvers_.matrix->content, fresh.matrix->content);
  std::swap(solvers_.linear->content, fresh.linear->content);
  replace_content(solvers_.nonlinear.get(), std::move(fresh.nonlinear));
}

void BdfMemory::begin(const State& state) {
  std::copy(state.y.begin(), state.y.end(), view(y_.get()).begin());
  std::copy(state.ydot.begin(), state.ydot.end(), view(ydot_.get()).begin());
  ida_.reset(IDACreate(context_));
  void* ida = ida_.get();
  check(ida, "IDACreate");
  GNOMON_SILENCE(IDASetErrHandlerFn, ida);
  check(IDAInit(ida, &BdfMemory::residual, state.t, y_.get(), ydot_.get()), "IDAInit");
  check(IDASetUserData(ida, this), "IDASetUserData");
  check(IDAWFtolerances(ida, &BdfMemory::weights), "IDAWFtolerances");
  check(IDASetId(ida, id_.get()), "IDASetId");
  check(IDASetSuppressAlg(ida, SUNTRUE), "IDASetSuppressAlg");
  const auto max_order = static_cast<int>(std::get<long>(settings_.value(max_order_key())));
  check(IDASetMaxOrd(ida, max_order), "IDASetMaxOrd");
  // Where the solution ends, IDA would take ever smaller steps without an end. This limit ends
  // failing steps; vanishes() ends those that succeed.
  check(IDASetMinStep(ida, shortest_step(settings_)), "IDASetMinStep");
  if (settings_.max_step > 0) check(IDASetMaxStep(ida, settings_.max_step), "IDASetMaxStep");
  // Failures in one step; practically unlimited, because nearly every failure divides the step by
  // four.
  constexpr int most_failures = 30;
  check(IDASetMaxErrTestFails(ida, most_failures), "IDASetMaxErrTestFails");
  check(IDASetMaxConvFails(ida, most_failures), "IDASetMaxConvFails");
  check(IDASetLinearSolver(ida, solvers_.linear.get(), solvers_.matrix.get()),
        "IDASetLinearSolver");
  check(IDASetJacFn(ida, &BdfMemory::jacobian), "IDASetJacFn");
  check(IDASetNonlinearSolver(ida, solvers_.nonlinear.get()), "IDASetNonlinearSolver");
  if (settings_.locate_events) {
    branch_.emplace(*system_, state.t, state.y, settings_.end);
    check(IDARootInit(ida, branch_->size(), &BdfMemory::switching), "IDARootInit");
    check(IDASetNoInactiveRootWarn(ida), "IDASetNoInactiveRootWarn");
  }
  if (!settings_.settled.empty()) closings_.emplace(steps_to_damp).begin(active(state));
  if (settings_.integrand)
    check(IDAQuadInit(ida, &BdfMemory::integrand, integral_.get()), "IDAQuadInit");
  begun_ = true;
}

int BdfMemory::residual(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector F, void* data) {
  BdfMemory& self = *static_cast<BdfMemory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.residual_evaluations;
    self.system_->residual({t, view(y), view(ydot), self.branch(), self.from_}, view(F));
    require_finite(view(F), "the residual");
  });
}

int BdfMemory::jacobian(sunrealtype t, sunrealtype alpha, N_Vector y, N_Vector ydot, N_Vector,
                        SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
  BdfMemory& self = *static_cast<BdfMemory*>(data);
  return self.guard_.run([&] {
    ++self.counters_.jacobian_evaluations;
    self.system_->jacobian({t, view(y), view(ydot), self.branch(), self.from_, &self.slow_}, alpha,
                           values(J));
  });
}

// IDA averages the masked squares over ALL components; the factor makes it the mean over the
// differential ones, so that the meaning of rtol does not depend on the number of algebraic
// unknowns.
int BdfMemory::weights(N_Vector y, N_Vector w, void* data) {
  const BdfMemory& self = *static_cast<BdfMemory*>(data);
  const double spread = std::sqrt(double(view(y).size()) / double(self.norm_.components().size()));
  for (std::size_t i = 0; i < view(y).size(); ++i)
    view(w)[i] = spread * self.norm_.weight(i, view(y)[i]);
  return 0;
}

int BdfMemory::switching(sunrealtype t, N_Vector y, N_Vector ydot, sunrealtype* values,
                         void* data) {
  BdfMemory& self = *static_cast<BdfMemory*>(data);
  return self.guard_.run([&] {
    self.system_->switching({.t = t, .y = view(y), .ydot = view(ydot)},
                            std::span<double>(values, self.branch_->size()));
  });
}

// IDA integrates it by its own formula, order and step; it does not take part in the error test.
int BdfMemory::integrand(sunrealtype t, N_Vector y, N_Vector ydot, N_Vector value, void* data) {
  BdfMemory& self = *static_cast<BdfMemory*>(data);
  return self.guard_.run([&] {
    view(value)[0] = self.settings_.integrand({t, view(y), view(ydot), self.branch(), self.from_});
  });
}

}  // namespace gnomon
