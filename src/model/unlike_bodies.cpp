#include "model/unlike_bodies.hpp"

#include <cmath>

namespace gnomon {

namespace {

double dundurs(const Material& first, const Material* second) {
  const auto coupled = [](const Material& of) {
    return (1 - 2 * of.poisson_ratio) * (1 + of.poisson_ratio) / of.young_modulus;
  };
  const auto whole = [](const Material& of) {
    return 2 * (1 - of.poisson_ratio) * (1 + of.poisson_ratio) / of.young_modulus;
  };
  if (!second) return coupled(first) / whole(first);
  return (coupled(first) - coupled(*second)) / (whole(first) + whole(*second));
}

}  // namespace

template <int dim>
double dundurs_of(const std::vector<Body>& bodies, const std::vector<MortarPair<dim>>& pairs) {
  double farthest = 0;
  const auto count = [&](double beta) {
    if (std::abs(beta) > std::abs(farthest)) farthest = beta;
  };
  if (pairs.empty())
    for (const Body& body : bodies) count(dundurs(body.material, nullptr));
  for (const MortarPair<dim>& pair : pairs) {
    const auto [slave, master] = pair.numbers;
    count(dundurs(bodies[static_cast<std::size_t>(slave)].material,
                  &bodies[static_cast<std::size_t>(master)].material));
  }
  return farthest;
}

template double dundurs_of(const std::vector<Body>&, const std::vector<MortarPair<2>>&);
template double dundurs_of(const std::vector<Body>&, const std::vector<MortarPair<3>>&);

}  // namespace gnomon
