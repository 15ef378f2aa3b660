#include <gnomon/integrators/rates.hpp>
#include <gnomon/model/wear_model.hpp>

#include "model/path_march.hpp"

namespace gnomon {

/// Two cycles, as at the start: in the first one bodies leave what they remember.
template <int dim>
State WearModel<dim>::behind_jump(const State& state) const {
  Counters counters;
  const FieldValues<dim> before = system().values(state.t, state.y);
  PathMarch<dim> march(equations_, before, state.t, counters);
  march.go_on_from(before, before.vector(equations_.fields().memory));
  march.cycle();
  State behind{state.t, std::vector<double>(state.y.size()), {}};
  system().numbering().gather(march.cycle(), behind.y);
  set_rates(system(), nullptr, behind);
  return behind;
}

template State WearModel<2>::behind_jump(const State&) const;
template State WearModel<3>::behind_jump(const State&) const;

}  // namespace gnomon
