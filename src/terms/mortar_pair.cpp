#include <algorithm>
#include <gnomon/terms/mortar_pair.hpp>

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

}  // namespace

template <int dim>
std::vector<std::vector<int>> mortar_candidates(const MortarPair<dim>& pair,
                                                const std::vector<Vector<dim>>& x) {
  std::vector<Ball<dim>> masters;
  for (const auto& facet : pair.master) masters.emplace_back(facet, x);
  std::vector<std::vector<int>> result;
  for (const auto& facet : pair.slave) {
    const Ball<dim> own(facet, x);
    std::vector<int>& near = result.emplace_back();
    for (std::size_t k = 0; k < masters.size(); ++k) {
      const double margin = 2 * std::max(own.radius, masters[k].radius);
      if ((masters[k].centre - own.centre).norm() <=
          own.radius + masters[k].radius + margin + pair.reach)
        near.push_back(static_cast<int>(k));
    }
  }
  return result;
}

template std::vector<std::vector<int>> mortar_candidates(const MortarPair<2>&,
                                                         const std::vector<Vector<2>>&);
template std::vector<std::vector<int>> mortar_candidates(const MortarPair<3>&,
                                                         const std::vector<Vector<3>>&);

}  // namespace gnomon
