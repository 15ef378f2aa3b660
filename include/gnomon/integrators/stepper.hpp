// Drives a one-step method: fixed steps or steps that follow the error, halving, located events, on
// which a step ends, so that the method keeps its order where the active set changes.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/closings.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/one_step.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/step_size.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

/// How a search for an event ended.
struct Landing {
  Attempt attempt{};  ///< the step that ends on the event; failed if Newton's method or the search
                      ///< failed
  bool at_start = false;  ///< the event is at the start of the step, so that no step can end there
  double h = 0;           ///< size of the step [time]
  int switched = 0;       ///< contact nodes that change there, or at the start
};

/// Steps are taken on one smooth branch, continued beyond its border (Point::branch). When a
/// switching function has changed sign at the end of a step, the first of these events is found by
/// interpolation and by repeating the step, shorter, until its end is within `tolerance` of the
/// event.
///
/// The tolerance is tight because the state at the event is not projected on the new branch: the
/// error of its rates, which the next step may use, is their slope there times the error in time.
class EventLocator {
public:
  static constexpr double tolerance = 1e-7;  ///< of the time of an event, in units of the step

  EventLocator(const System& system, OneStepMethod& method);

  /// Takes the branch from the signs of the switching functions at this state.
  void begin(const State& at) { branch_ = active_set(system_, at.t, at.y); }
  /// The branch on which steps are taken now.
  ActiveSet branch() const { return branch_; }
  /// Has the state left the branch?
  bool left(const State& at) const {
    return !on_all_processes(active_set(system_, at.t, at.y) == branch_);
  }

  std::vector<double> memory() const;
  void restore(Unpacker& memory);

  /// For a step of size h from `from` that ended off the branch in `to`: the shorter step that ends
  /// on the first event. branch() is then the branch after the event. If the event is at the start
  /// itself, branch() is also the branch after it, and the step must be repeated; if nothing
  /// switches there (nodes that have switched there before are off the branch again), the step can
  /// only pass over the event.
  Landing land(const State& from, double h, State& to);

private:
  struct Sample {
    double h;
    std::vector<double> values;  // of the switching functions
  };
  void sample(double h, const State& at);
  double first_guess(const State& from, double h) const;
  std::vector<const Sample*> samples_near(double end, double low, double high) const;
  double earliest_root(double low, double high) const;
  int switch_at(double h, double width);
  Landing switch_at_start(const State& from, const Sample& behind);
  const Sample& at(double h) const;
  bool off_branch(const Sample& sample) const;
  bool starts_off_branch(const State& from) const;

  const System& system_;
  OneStepMethod& method_;
  ActiveSet branch_;
  std::vector<Sample> samples_;  // of the present step, ascending in h
  // Nodes that switched at the event on which the last step ended, or just after it: their
  // functions vanish there, and rounding determines their sign.
  std::vector<char> crossed_;
  double crossed_at_ = -1;  // time of that event; the times of runs are not negative
};

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
