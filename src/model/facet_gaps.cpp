#include "model/facet_gaps.hpp"

#include <algorithm>
#include <gnomon/terms/mortar_kernel.hpp>
#include <limits>

#include "mesh/facet_bins.hpp"

namespace gnomon {

namespace {

/// Flat, where it is now.
template <int dim>
FacetPair<dim> pair_of(const typename Mesh<dim>::Facet& slave,
                       const typename Mesh<dim>::Facet& master, const std::vector<Vector<dim>>& x) {
  FacetPair<dim> pair;
  const Vector<dim> n = facet_normal<dim>(slave, x);
  for (int a = 0; a < Mesh<dim>::facet_nodes; ++a) {
    pair.x.row(a) = x[slave[a]].transpose();
    pair.n.row(a) = n.transpose();
    pair.y.row(a) = x[master[a]].transpose();
  }
  pair.X = pair.x;
  return pair;
}

}  // namespace

template <int dim>
FacetGaps facet_gaps(const std::vector<typename Mesh<dim>::Facet>& slave,
                     const std::vector<typename Mesh<dim>::Facet>& master,
                     const std::vector<Vector<dim>>& x, Section section,
                     const std::array<double, 2>& range, Cover* cover) {
  constexpr double opposite = -0.2;  // cosine
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto [least, most] = range;
  const double reach = std::max(most, -least);
  FacetGaps gaps = {std::vector<double>(slave.size(), none),
                    std::vector<double>(master.size(), none)};
  std::vector<Vector<dim>> normals;
  for (const auto& facet : master) normals.push_back(facet_normal<dim>(facet, x));
  const FacetBins<dim> bins(master, x);
  for (std::size_t s = 0; s < slave.size(); ++s) {
    const Vector<dim> n = facet_normal<dim>(slave[s], x), &corner = x[slave[s][0]];
    double size = 0;
    for (const int node : slave[s]) size = std::max(size, (x[node] - corner).norm());
    for (const int m : bins.near_line(corner, n, reach + size, size)) {
      if (n.dot(normals[m]) > opposite) continue;
      const CoveredPart<dim> part =
          covered_part(pair_of<dim>(slave[s], master[m], x), section, reach);
      if (!(part.mass.sum() > 0)) continue;
      const double gap = part.gap.sum() / part.mass.sum();
      if (gap < least || gap > most) continue;
      if (cover) {
        cover->area += part.mass.sum();
        cover->volume += part.gap.sum();
      }
      gaps[0][s] = std::min(gaps[0][s], gap);
      gaps[1][m] = std::min(gaps[1][m], gap);
    }
  }
  return gaps;
}

template <int dim>
double deepest_overlap(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x,
                       Section section, double most) {
  const FacetGaps gaps = facet_gaps<dim>(pair.slave, pair.master, x, section, {-most, 0});
  double least = 0;
  for (const double gap : gaps[0]) least = std::min(least, gap);
  return -least;
}

template double deepest_overlap(const MortarPair<2>&, const std::vector<Vector<2>>&, Section,
                                double);
template double deepest_overlap(const MortarPair<3>&, const std::vector<Vector<3>>&, Section,
                                double);
template FacetGaps facet_gaps<2>(const std::vector<Mesh<2>::Facet>&,
                                 const std::vector<Mesh<2>::Facet>&, const std::vector<Vector<2>>&,
                                 Section, const std::array<double, 2>&, Cover*);
template FacetGaps facet_gaps<3>(const std::vector<Mesh<3>::Facet>&,
                                 const std::vector<Mesh<3>::Facet>&, const std::vector<Vector<3>>&,
                                 Section, const std::array<double, 2>&, Cover*);

}  // namespace gnomon
