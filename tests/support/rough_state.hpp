// A state far from equilibrium, for tests of derivatives.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <random>
#include <vector>

namespace gnomon::testing {

struct RoughState {
  double size = 0.02;                  ///< of displacements and shapes [length]
  double closed = -2000, open = 3000;  ///< multipliers [stress]
  int every = 2;                       ///< contact node is open
};

/// Small displacements and shapes at random, contact nodes closed and open in turn.
template <int dim>
std::vector<double> rough_state(const WearModel<dim>& model, const RoughState& rough = {}) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-rough.size, rough.size);
  std::vector<double> y(static_cast<std::size_t>(model.system().structure().size));
  for (double& value : y) value = uniform(generator);
  const Numbering& numbering = model.system().numbering();
  for (int c = 0; c < static_cast<int>(model.assembly().contact_nodes.size()); ++c)
    if (const int at = numbering.number(model.equations().fields().lambda, c); at >= 0)
      y[at] = c % rough.every ? rough.closed : rough.open;
  return y;
}

}  // namespace gnomon::testing
