// Ends a step where the active set changes, so that a one-step method keeps its order.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/one_step.hpp>
#include <gnomon/system/system.hpp>
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

}  // namespace gnomon
