// Drives a one-step method: fixed steps or steps that follow the error, halving, located events.
#pragma once

#include <gnomon/integrators/closings.hpp>
#include <gnomon/integrators/event_location.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/one_step.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/step_size.hpp>
#include <memory>
#include <optional>

namespace gnomon {

/// With a fixed step: the grid t = k step, an attempt that fails being counted as rejected and
/// repeated with half the step, as the paper's substepping. Otherwise the error estimate of the
/// method sets the step. When ever shorter steps fail, the first one is tried again by continuation
/// (AttemptOptions), and shorter ones after it.
class OneStepStepper : public Stepper {
public:
  /// `error_order`: the estimated error of a step of size h is of order h^(error_order + 1).
  OneStepStepper(const System& system, const IntegratorSettings& settings, Counters& counters,
                 std::unique_ptr<OneStepMethod> method, int order, int error_order);
  std::vector<double> memory() const override;
  void restore(const State& state, std::span<const double> memory) override;
  bool follow(Stepper& before, const State& state, bool same) override;

private:
  struct Plan {
    double h;
    double target;
    bool lands;  // the step ends on the target
  };
  struct Step {
    Plan plan;
    Landing landing;
    bool settles = false;  // by short steps
    bool lands() const { return plan.lands && landing.h == plan.h; }
  };
  StepReport take_step(State& state, double t_stop) override;
  void begin(const State& state);
  Plan plan(const State& state, double t_stop, double h) const;
  Step next_step(const State& state, double t_stop);
  Step ordinary_step(const State& state, double t_stop);
  std::optional<Step> short_step(const State& state, double t_end);
  ActiveSet active(const State& state) const;
  Landing take(const State& state, const Plan& plan, AttemptOptions options);
  bool acceptable(const Attempt& attempt) const;
  void accept(State& state, const Step& step);
  void begin_behind_kink(State& state, const Landing& landing);
  double after_success(const Plan& plan, const Landing& landing);
  bool fixed() const { return settings_.step > 0; }
  /// Since the step began.
  long newton_iterations() const { return counters_.newton_iterations - newton_before_; }

  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  ErrorNorm norm_;
  std::unique_ptr<OneStepMethod> method_;
  int order_;
  StepSizeControl control_;
  int error_order_;
  ExpectedError expected_error_;
  std::optional<EventLocator> locator_;
  std::optional<Closings> closings_;  // only with settled times
  bool begun_ = false;
  long newton_before_ = 0;
  double proposal_ = 0;  // size of the next step
  State next_;           // end of the last attempt
};

}  // namespace gnomon
