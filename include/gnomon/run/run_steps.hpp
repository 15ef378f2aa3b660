// A run that the caller drives: the steps that run() takes, without a result.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/run/run.hpp>
#include <memory>
#include <optional>

namespace gnomon {

class RunSteps {
public:
  /// From the start of the model, which outlives this object, as the integrator does, to
  /// settings.end or, where it is given, time.until. Throws SolutionError where there is no start,
  /// and InputError where nothing of that name is observed.
  RunSteps(const Model& model, const Integrator& integrator, IntegratorSettings settings,
           std::optional<Until> until = {});
  ~RunSteps();
  RunSteps(const RunSteps&) = delete;

  /// Takes an accepted step that ends at `stop` at the latest; where another model follows, state()
  /// is then of that one. Throws SolutionError where there is no step, and InputError after the
  /// end.
  StepReport advance(double stop);
  bool ended() const;  ///< no step follows
  const State& state() const;
  const Counters& counters() const;
  /// The model of state() in a later epoch than the first; else null.
  std::shared_ptr<const Model> successor() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace gnomon
