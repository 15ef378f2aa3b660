#include <algorithm>
#include <gnomon/terms/mortar_pair.hpp>

#include "mesh/facet_bins.hpp"

namespace gnomon {

namespace {

template <int dim>
struct Ball {
  Vector<dim> centre = Vector<dim>::Zero();
  double radius = 0;

  Ball(const typename Mesh<dim>::Facet& facet, const std::vector<Vector<dim>>& x) {
    for (const int node : facet) centre += x[node] / double(facet.size());
    for (const int node : facet) radius = std::max(radius, (x[node] - centre).norm());
  }
};

/// Of candidates, by the radius of the larger facet.
constexpr double margin = 2;

}  // namespace

template <int dim>
PairPlaces<dim>::PairPlaces(const MortarPair<dim>& pair, const std::vector<BodyPlace<dim>>& bodies)
    : motion(pair.motion) {
  if (bodies.empty()) return;
  for (const std::size_t side : {0, 1})
    of[side] = bodies[static_cast<std::size_t>(pair.numbers[side])];
  motion = relative_motion(of[0].motion, of[1].motion);
}

template <int dim>
std::vector<Vector<dim>> in_space(const std::vector<MortarPair<dim>>& pairs,
                                  const std::vector<BodyPlace<dim>>& places,
                                  std::vector<Vector<dim>> x) {
  if (places.empty()) return x;
  std::map<int, int> body;  // of nodes
  for (const MortarPair<dim>& pair : pairs)
    for (const std::size_t side : {0, 1})
      for (const auto& facet : pair.boundary[side])
        for (const int node : facet) body[node] = pair.numbers[side];
  for (const auto& [node, number] : body)
    x[node] = places[static_cast<std::size_t>(number)].of(x[node]);
  return x;
}

template <int dim>
Vector<dim> facet_normal(const typename Mesh<dim>::Facet& facet,
                         const std::vector<Vector<dim>>& x) {
  if constexpr (dim == 2) {
    const Vector<2> a = x[facet[1]] - x[facet[0]];
    return Vector<2>(a[1], -a[0]).normalized();
  } else {
    return (x[facet[2]] - x[facet[0]]).cross(x[facet[3]] - x[facet[1]]).normalized();
  }
}

template <int dim>
bool is_within_margin(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& near,
                      const std::vector<Vector<dim>>& x, double part) {
  Vector<dim> common = Vector<dim>::Zero();
  for (const auto& facet : pair.master)
    for (const int node : facet)
      common += (x[node] - near[node]) / double(facet.size() * pair.master.size());
  // Relative to the mean motion of the master, along the facets and by their radii: across them the
  // reach allows for it. Slaves look along their normals: one that sinks obliquely to its own meets
  // other masters.
  const auto strays = [&](const auto& facets) {
    double most = 0;
    for (const auto& facet : facets) {
      const Vector<dim> n = facet_normal<dim>(facet, near);
      const double radius = Ball<dim>(facet, near).radius;
      for (const int node : facet) {
        const Vector<dim> moved = x[node] - near[node] - common;
        most = std::max(most, (moved - n * n.dot(moved)).norm() / radius);
      }
    }
    return most;
  };
  return strays(pair.slave) + strays(pair.master) <= part * margin;
}

template <int dim>
std::vector<std::vector<int>> mortar_candidates(const MortarPair<dim>& pair,
                                                const std::vector<Vector<dim>>& x) {
  std::vector<Ball<dim>> masters;
  for (const auto& facet : pair.master) masters.emplace_back(facet, x);
  std::vector<std::vector<int>> result;
  const FacetBins<dim> bins(pair.master, x);
  double largest = 0;
  for (const Ball<dim>& ball : masters) largest = std::max(largest, ball.radius);
  const auto around_of = [](double a, double b) { return a + b + margin * std::max(a, b); };
  for (const auto& facet : pair.slave) {
    const Ball<dim> own(facet, x);
    const Vector<dim> n = facet_normal<dim>(facet, x);
    std::vector<int>& near = result.emplace_back();
    const double farthest = around_of(own.radius, largest);
    for (const int k : bins.near_line(own.centre, n, farthest + pair.reach, farthest)) {
      const double around = around_of(own.radius, masters[k].radius);
      const Vector<dim> to = masters[k].centre - own.centre;
      const double ahead = n.dot(to);
      if ((to - ahead * n).norm() <= around && std::abs(ahead) <= around + pair.reach)
        near.push_back(k);
    }
  }
  return result;
}

template <int dim>
std::vector<std::vector<int>> masters_beside(const MortarPair<dim>& pair,
                                             const typename Mesh<dim>::Facet& slave,
                                             const std::vector<int>& masters,
                                             const std::vector<Vector<dim>>& x) {
  constexpr double strained = 1.5;  // and seen obliquely
  const Ball<dim> own(slave, x);
  std::vector<Ball<dim>> balls;
  for (const int master : masters) balls.emplace_back(pair.master[master], x);
  std::vector<std::vector<int>> result(masters.size());
  for (std::size_t k = 0; k < balls.size(); ++k)
    for (std::size_t l = 0; l < balls.size(); ++l)
      if ((balls[l].centre - balls[k].centre).norm() <=
          strained * (balls[k].radius + 2 * own.radius + balls[l].radius))
        result[k].push_back(masters[l]);
  return result;
}

template struct PairPlaces<2>;
template struct PairPlaces<3>;
template std::vector<Vector<2>> in_space(const std::vector<MortarPair<2>>&,
                                         const std::vector<BodyPlace<2>>&, std::vector<Vector<2>>);
template std::vector<Vector<3>> in_space(const std::vector<MortarPair<3>>&,
                                         const std::vector<BodyPlace<3>>&, std::vector<Vector<3>>);
template Vector<2> facet_normal<2>(const Mesh<2>::Facet&, const std::vector<Vector<2>>&);
template Vector<3> facet_normal<3>(const Mesh<3>::Facet&, const std::vector<Vector<3>>&);
template std::vector<std::vector<int>> masters_beside(const MortarPair<2>&, const Mesh<2>::Facet&,
                                                      const std::vector<int>&,
                                                      const std::vector<Vector<2>>&);
template std::vector<std::vector<int>> masters_beside(const MortarPair<3>&, const Mesh<3>::Facet&,
                                                      const std::vector<int>&,
                                                      const std::vector<Vector<3>>&);
template bool is_within_margin(const MortarPair<2>&, const std::vector<Vector<2>>&,
                               const std::vector<Vector<2>>&, double);
template bool is_within_margin(const MortarPair<3>&, const std::vector<Vector<3>>&,
                               const std::vector<Vector<3>>&, double);
template std::vector<std::vector<int>> mortar_candidates(const MortarPair<2>&,
                                                         const std::vector<Vector<2>>&);
template std::vector<std::vector<int>> mortar_candidates(const MortarPair<3>&,
                                                         const std::vector<Vector<3>>&);

}  // namespace gnomon
