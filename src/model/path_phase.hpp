// One phase of a path, alone (path_march.cpp, path_loading.cpp).
#pragma once

#include <gnomon/system/composed_system.hpp>

#include "model/path_march.hpp"

namespace gnomon {

/// The equations of one phase.
template <int dim>
struct PathMarch<dim>::Alone {
  /// Of the tractions that are known where Newton's method begins, so that what slipped before
  /// begins as stuck.
  static constexpr double inside = 0.99;

  WornBodyEquations<dim> equations;
  ComposedSystem<dim> system;
  FieldValues<dim> values;
  double t;

  Alone(const PathMarch& march, const Phase<dim>& phase) : Alone(march, phase, march.near_) {}
  Alone(const PathMarch& march, const Phase<dim>& phase, std::shared_ptr<const Assembly<dim>> body)
      : equations(std::move(body), {phase}),
        system(equations.composition(), equations.deformation()),
        values(*equations.composition()->fields),
        t(march.t_) {
    values.vector(fields().d) = march.values_.vector(march.whole_.fields().d);
    system.freeze(values, t);
  }
  const WornBodyFields& fields() const { return equations.fields(); }
  NodalField<dim> places(const FieldValues<dim>& of) const {
    return equations.places(system, of, t);
  }
  void remember(const NodalField<dim>& place) {
    values.vector(fields().memory) = place;
    system.freeze(values, t);
  }
  /// Of a solution y: the places from which the next one goes on, and where it begins.
  void go_on_from(std::span<double> y) {
    FieldValues<dim> of = system.values(t, y);
    remember(places(of));
    of.vector(fields().traction) *= inside;
    if (fields().place != FieldId::none) of.vector(fields().place) = values.vector(fields().memory);
    system.numbering().gather(of, y);
  }
};

}  // namespace gnomon
