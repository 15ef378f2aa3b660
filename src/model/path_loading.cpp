// The first loading, where a path begins.

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <optional>

#include "model/first_loading.hpp"
#include "model/near_facets.hpp"
#include "model/path_phase.hpp"
#include "model/wear_start.hpp"

namespace gnomon {

/// Whether bodies of pairs have left this part of the margin of the facets that they may meet.
template <int dim>
bool PathMarch<dim>::has_left_facets(const Alone& alone, const Phase<dim>& phase,
                                     const FieldValues<dim>& at, double part) const {
  const FieldId d = alone.fields().d, u = alone.fields().u;
  return !near_->pairs.empty() &&
         have_strayed(*near_, phase, deformed(near_->mesh, at.vector(d), at.vector(u)), part);
}

/// From bodies without load. Without `by_facets`, which finds the facets of pairs that may meet
/// anew on the way, false where they do not stay at these.
template <int dim>
bool PathMarch<dim>::press(const Phase<dim>& phase, bool by_facets) {
  constexpr double increment = 0.1;
  RampOptions options = ramp_options(whole_.assembly());
  options.first = std::min(options.first, increment);
  options.largest = increment;
  options.good_iterations = 12;  // of equilibria that are solved for to rounding
  std::optional<FieldValues<dim>> on_the_way;
  for (;;) {
    Alone alone(*this, phase);
    const WornBodyFields& fields = alone.fields();
    if (on_the_way) {
      alone.values = *on_the_way;
      alone.remember(on_the_way->vector(fields.memory));
    }
    RampOptions here = options;
    if (by_facets)
      here.strays = [&](std::span<const double> y, double part) {
        return has_left_facets(alone, phase, alone.system.values(t_, y), part);
      };
    const RampReport ramp =
        find_equilibrium(alone.equations, alone.system, here, alone.values, counters_,
                         [&alone](std::span<double> y) { alone.go_on_from(y); });
    if (ramp.reached == 1 && !has_left_facets(alone, phase, alone.values, 1)) {
      keep(alone, last_);
      return true;
    }
    if (!by_facets && !near_->pairs.empty()) return false;
    options.most -= ramp.increments + ramp.failures;
    if (!by_facets || ramp.increments == 0 || options.most <= 0) {
      if (press_sliding(phase)) return true;
      throw SolutionError(failure_of(ramp, whole_.assembly(), phase));
    }
    options.begin = ramp.reached;
    on_the_way = alone.values;
    come_near(phase, alone.values.vector(fields.u), 0);
  }
}

/// The forces where the path begins grow to the first step of the loading, and on from step to
/// step.
template <int dim>
void PathMarch<dim>::load() {
  const Phase<dim>& begin = whole_.phases().back();
  const std::vector<LoadingStep> steps = with_a_pressed_start(whole_.assembly().interface.loading);
  const Phase<dim> pressed = with_parts(begin, steps.front());
  if (!press(pressed, false)) press(pressed, true);
  for (std::size_t k = 1; k < steps.size(); ++k)
    advance(last_,
            [&](double part) { return with_parts(begin, between(steps[k - 1], steps[k], part)); });
}

template <int dim>
FieldValues<dim> start_of_path(const WornBodyEquations<dim>& equations, Counters& counters) {
  constexpr int cycles = 2;
  const FieldValues<dim> unworn(*equations.composition()->fields);
  PathMarch<dim> march(equations, unworn, 0, counters);
  march.load();
  for (int cycle = 1; cycle < cycles; ++cycle) march.cycle();
  return march.cycle();
}

template bool PathMarch<2>::press(const Phase<2>&, bool);
template bool PathMarch<3>::press(const Phase<3>&, bool);
template bool PathMarch<2>::has_left_facets(const Alone&, const Phase<2>&, const FieldValues<2>&,
                                            double) const;
template bool PathMarch<3>::has_left_facets(const Alone&, const Phase<3>&, const FieldValues<3>&,
                                            double) const;
template void PathMarch<2>::load();
template void PathMarch<3>::load();
template FieldValues<2> start_of_path(const WornBodyEquations<2>&, Counters&);
template FieldValues<3> start_of_path(const WornBodyEquations<3>&, Counters&);

}  // namespace gnomon
