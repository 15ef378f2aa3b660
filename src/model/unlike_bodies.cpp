#include "model/unlike_bodies.hpp"

#include <cmath>

#include "model/connected_parts.hpp"

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

template <int dim>
bool are_layered(const Mesh<dim>& mesh, const std::vector<Body>& bodies) {
  if (bodies.size() < 2) return false;
  const std::vector<int> part = connected_parts(mesh, bodies);
  for (std::size_t a = 0; a < part.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Material &one = bodies[a].material, &other = bodies[b].material;
      if (part[a] == part[b] &&
          (one.young_modulus != other.young_modulus || one.poisson_ratio != other.poisson_ratio))
        return true;
    }
  return false;
}

template bool are_layered(const Mesh<2>&, const std::vector<Body>&);
template bool are_layered(const Mesh<3>&, const std::vector<Body>&);
template double dundurs_of(const std::vector<Body>&, const std::vector<MortarPair<2>>&);
template double dundurs_of(const std::vector<Body>&, const std::vector<MortarPair<3>>&);

}  // namespace gnomon
