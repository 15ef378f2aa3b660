#include <gnomon/integrators/rates.hpp>

namespace gnomon {

void set_rates(const System& system, const ActiveSet* branch, State& state,
               std::optional<double> within) {
  std::vector<double> F(state.y.size());
  state.ydot.assign(state.y.size(), 0.0);
  system.residual({state.t, state.y, state.ydot, branch, within}, F);
  const std::vector<char>& differential = system.structure().differential;
  for (std::size_t i = 0; i < F.size(); ++i)
    if (differential[i]) state.ydot[i] = -F[i];
}

}  // namespace gnomon
