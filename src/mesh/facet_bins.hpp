// Finds facets near a line without a look at all of them.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <vector>

namespace gnomon {

/// A grid of equal bins over some facets; each facet is in all bins that the box around it meets.
template <int dim>
class FacetBins {
public:
  FacetBins(const std::vector<typename Mesh<dim>::Facet>& facets,
            const std::vector<Vector<dim>>& x);

  /// Facets, ascending: all those that are anywhere within `radius` of the points from + s along,
  /// |s| <= reach, and some that are not. `along` is unit; the reach may be infinite.
  std::vector<int> near_line(const Vector<dim>& from, const Vector<dim>& along, double reach,
                             double radius) const;

private:
  using Place = std::array<int, dim>;
  /// Of a bin; on the border for points outside.
  Place place(const Vector<dim>& x) const;
  template <class Visit>
  void visit_box(const Vector<dim>& low, const Vector<dim>& high, const Visit& visit) const;

  Vector<dim> low_, high_;  // of all facets
  double size_ = 1;         // of a bin [length]
  Place count_{};
  std::vector<std::vector<int>> bins_;
};

}  // namespace gnomon
