// A model in which a given state is at rest: its rate there is subtracted from the equations, and
// time is frozen.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/system/system.hpp>
#include <utility>

namespace gnomon {

/// Differential rows ydot + f(t_0, y) - f(t_0, y_0); all other rows are unchanged.
class RestingSystem : public System {
public:
  /// `state`: with its rates. Both must outlive the object.
  RestingSystem(const System& system, const State& state)
      : system_(system), state_(state), structure_(system.structure()) {
    structure_.breakpoints.clear();
    structure_.stops.clear();
  }

  const Structure& structure() const override { return structure_; }
  void residual(const Point& at, std::span<double> F) const override {
    system_.residual({state_.t, at.y, at.ydot, at.branch}, F);
    for (std::size_t i = 0; i < F.size(); ++i)
      if (structure().differential[i]) F[i] += state_.ydot[i];
  }
  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    system_.jacobian({state_.t, at.y, at.ydot, at.branch}, alpha, values);
  }
  void switching(const Point& at, std::span<double> values) const override {
    system_.switching({.t = state_.t, .y = at.y}, values);
  }
  std::vector<AlgebraicStage> algebraic_stages() const override {
    std::vector<AlgebraicStage> stages = system_.algebraic_stages();
    for (AlgebraicStage& stage : stages)
      stage.freeze = [freeze = std::move(stage.freeze), t = state_.t](
                         double, std::span<const double> y) { freeze(t, y); };
    return stages;
  }

private:
  const System& system_;
  const State& state_;
  Structure structure_;
};

/// The model of such a system, for integrators.
class RestingModel : public Model {
public:
  RestingModel(const Model& model, const State& state)
      : model_(model), state_(state), system_(model.system(), state_) {
    static_cast<ModelFacts&>(*this) = model;
  }

  const System& system() const override { return system_; }
  State start(Counters&) const override {
    State rest = state_;
    rest.ydot.assign(rest.y.size(), 0.0);
    return rest;
  }
  Observation observe(const State& state) const override { return model_.observe(state); }
  std::vector<GridField> fields(const State& state) const override { return model_.fields(state); }
  std::optional<ContactSurface> contact(const State& state) const override {
    return model_.contact(state);
  }

private:
  const Model& model_;
  State state_;
  RestingSystem system_;
};

}  // namespace gnomon
