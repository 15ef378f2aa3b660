// The equilibrium of a phase at a fixed shape and time, from bodies without load.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <memory>

#include "model/wear_start.hpp"

namespace gnomon {

/// With a part of the coefficients of friction.
template <int dim>
std::shared_ptr<const Assembly<dim>> with_friction(const Assembly<dim>& body, double part);

/// Where friction does not stick, so that no phase of a cycle knows of another.
template <int dim>
class PhaseStart {
public:
  /// Equations of one phase; they and `counters` must outlive the object.
  PhaseStart(const WornBodyEquations<dim>& alone, const NodalField<dim>& d, double t,
             Counters& counters)
      : alone_(alone), t_(t), counters_(counters), values_(*alone.composition()->fields) {
    values_.vector(alone.fields().d) = d;
  }
  /// By a ramp of the load. Where bodies of pairs move beyond the facets that they were expected to
  /// meet, these are found anew, at its end or on the way; where friction turns a body by more,
  /// under any load, it grows.
  RampReport find();
  FieldValues<dim>& values() { return values_; }

private:
  using Body = std::shared_ptr<const Assembly<dim>>;
  const Phase<dim>& phase() const { return alone_.phases().front(); }
  std::vector<Vector<dim>> positions(const FieldValues<dim>& of) const;
  void lift();
  RampReport ramp();
  bool settles(Body body);
  RampReport ramp_by_facets(Body body);
  bool friction_grows();

  const WornBodyEquations<dim>& alone_;
  double t_;
  Counters& counters_;
  FieldValues<dim> values_;
};

}  // namespace gnomon
