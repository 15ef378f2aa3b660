#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_model.hpp>

#include "model/path_march.hpp"

namespace gnomon {

/// As at the start, at the shape that is worn; of paths after a first cycle, in which bodies leave
/// what they remember.
template <int dim>
State WearModel<dim>::behind_jump(const State& state) const {
  Counters counters;
  const FieldValues<dim> before = system().values(state.t, state.y);
  const auto second_cycle = [&] {
    PathMarch<dim> march(equations_, before, state.t, counters);
    march.go_on_from(before, before.vector(equations_.fields().memory));
    march.cycle();
    return march.cycle();
  };
  State behind =
      at_rest(state.t, assembly().interface.sticks ? second_cycle()
                                                   : equilibrium(before, state.t, counters));
  // Their facets would have to be found anew within a step.
  if (!assembly().pairs.empty() && have_moved(positions(behind), 1))
    throw SolutionError(
        "bodies slide on each other by more than a facet; a ramp in time is followed");
  return behind;
}

template State WearModel<2>::behind_jump(const State&) const;
template State WearModel<3>::behind_jump(const State&) const;

}  // namespace gnomon
