// The steps of a run, none of which goes beyond where it has to end: a time to store, where another
// model should follow, a limit of the model, the value of time.until. What is beyond is known only
// after a step, which is then repeated shorter.
#pragma once

#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/run/run.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "run/memory.hpp"

namespace gnomon {

/// A step that is made, but not yet recorded.
struct BoundedStep {
  State before;
  StepReport report;
  Observation observed;        ///< at its end
  std::optional<Limit> limit;  ///< at which it ends: beyond there the run cannot go on
};

/// Why a run ends at this time.
SolutionError at_limit(double t, const Limit& limit);

class BoundedSteps {
public:
  /// Keeps references. `last`: what was observed at the last good state.
  BoundedSteps(const Integrator& integrator, const IntegratorSettings& settings,
               const std::optional<Until>& until, const Epochs& epochs, const Observation& last,
               RunMemory& memory, Counters& counters)
      : integrator_(integrator),
        settings_(settings),
        until_(until),
        epochs_(epochs),
        last_(last),
        memory_(memory),
        counters_(counters) {}

  void begin();
  bool have_begun() const { return stepper_ != nullptr; }
  /// With the model of an epoch that has just begun. Whether the method goes on as it was.
  bool follow(bool same_unknowns);
  /// Writes what the method remembers to the memory of the run.
  void remember() { memory_.stepper = stepper_->memory(); }
  /// Gives the memory of the method back.
  void end() { stepper_.reset(); }

  /// Advances the state of the run, to `stop` at most. Throws SolutionError where there is no such
  /// step, and Interruption, with the state before, where the answer of `interrupted` is true.
  BoundedStep advance(double stop, const std::function<bool()>& interrupted);
  /// After a step that is not yet recorded.
  Observation observe(const StepReport& report) const;

private:
  /// Pressures settle at an early end as at that of the run.
  IntegratorSettings settings() const;
  void repeat(BoundedStep& step, double end);
  void repeat_half(BoundedStep& step) {
    repeat(step, step.before.t + (state().t - step.before.t) / 2);
  }
  void come_near(BoundedStep& step);
  void stop_short(BoundedStep& step);
  /// An observation, its value where nothing is left, and what is said then.
  struct WornOff {
    const char* left;
    double least;
    std::string reason;
  };
  void stop_before(const WornOff& what, BoundedStep& step);
  void end_early(BoundedStep& step);

  State& state() { return memory_.state; }
  const Model& model() const { return epochs_.model(); }

  const Integrator& integrator_;
  const IntegratorSettings& settings_;
  const std::optional<Until>& until_;
  const Epochs& epochs_;
  const Observation& last_;
  RunMemory& memory_;
  Counters& counters_;
  std::unique_ptr<Stepper> stepper_;

  static constexpr double never = std::numeric_limits<double>::infinity();
  double early_end_ = never;  ///< of steps that go to time.until
  double early_step_ = 0;     ///< the largest of them: the value lies within it
};

}  // namespace gnomon
