#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>

namespace gnomon {

namespace {

template <int dim>
using Facet = typename decltype(FacetedSurface<dim>::facets)::value_type;

template <int dim>
using Place = std::array<int, dim>;  // of a node of the grid, or of the cell above it

/// The nodes of a grid over a box, with gaps.
template <int dim>
class GapGrid {
public:
  using Distance = std::function<SignedDistance<dim>(const Vector<dim>&)>;

  GapGrid(const Distance& distance, const Box<dim>& box, int most) : low_(box.low) {
    const Vector<dim> extent = box.high - box.low;
    const double wanted = extent.maxCoeff() / most;
    long nodes = 1;
    for (int i = 0; i < dim; ++i) {
      cells_[i] = std::max(1, static_cast<int>(std::ceil(extent[i] / wanted * (1 - 1e-9))));
      spacing_[i] = extent[i] / cells_[i];
      stride_[i] = nodes;
      nodes *= cells_[i] + 1;
    }
    gaps_.resize(nodes);
    for (long n = 0; n < nodes; ++n) gaps_[n] = distance(position(node(n))).gap;
  }

  long count() const { return static_cast<long>(gaps_.size()); }
  Place<dim> node(long number) const {
    Place<dim> place;
    for (int i = 0; i < dim; ++i) place[i] = int(number / stride_[i]) % (cells_[i] + 1);
    return place;
  }
  Vector<dim> position(const Place<dim>& place) const {
    Vector<dim> x = low_;
    for (int i = 0; i < dim; ++i) x[i] += place[i] * spacing_[i];
    return x;
  }
  /// Whether the node with this number is the lowest corner of a cell.
  bool begins_cell(const Place<dim>& place) const {
    for (int i = 0; i < dim; ++i)
      if (place[i] >= cells_[i]) return false;
    return true;
  }
  bool inside(long number) const { return gaps_[number] <= 0; }
  double gap(long number) const { return gaps_[number]; }
  long stride(int direction) const { return stride_[direction]; }
  int cells(int direction) const { return cells_[direction]; }

private:
  Vector<dim> low_, spacing_;
  Place<dim> cells_;
  std::array<long, dim> stride_;
  std::vector<double> gaps_;
};

/// The mean of the points in which the level crosses the edges of a cell; not finite if there is
/// none.
template <int dim>
Vector<dim> mean_crossing(const GapGrid<dim>& grid, long cell) {
  Vector<dim> sum = Vector<dim>::Zero();
  int crossings = 0;
  for (int i = 0; i < dim; ++i)
    for (int corner = 0; corner < 1 << dim; ++corner) {
      if (corner >> i & 1) continue;
      long from = cell;
      for (int j = 0; j < dim; ++j) from += (corner >> j & 1) * grid.stride(j);
      const long to = from + grid.stride(i);
      if (grid.inside(from) == grid.inside(to)) continue;
      const double part = grid.gap(from) / (grid.gap(from) - grid.gap(to));
      const Vector<dim> a = grid.position(grid.node(from)), b = grid.position(grid.node(to));
      sum += (1 - part) * a + part * b;
      ++crossings;
    }
  return sum / crossings;
}

/// One step would do, but for edges and for distances that are not exact.
template <int dim>
Vector<dim> on_level(const typename GapGrid<dim>::Distance& distance, Vector<dim> x) {
  SignedDistance<dim> here = distance(x);
  for (int k = 0; k < 3 && here.normal.allFinite(); ++k) {
    const Vector<dim> next = x - here.gap * here.normal;
    const SignedDistance<dim> there = distance(next);
    if (!(std::abs(there.gap) < std::abs(here.gap))) break;
    x = next;
    here = there;
  }
  return x;
}

/// The facet that crosses the edge from a node along direction i, by the points of the cells around
/// the edge.
template <int dim>
Facet<dim> facet_across(const GapGrid<dim>& grid, const std::vector<int>& point_of, long node,
                        int i) {
  const int j = (i + 1) % dim;
  Facet<dim> facet;
  if constexpr (dim == 2) {
    facet = {point_of[node - grid.stride(j)], point_of[node]};
    if (i == 1) std::swap(facet[0], facet[1]);
  } else {
    const long down = grid.stride(j), back = grid.stride((i + 2) % dim);
    facet = {point_of[node - down - back], point_of[node - back], point_of[node],
             point_of[node - down]};
  }
  if (!grid.inside(node)) std::reverse(facet.begin(), facet.end());
  return facet;
}

}  // namespace

template <int dim>
Box<dim> Box<dim>::around(const std::vector<Vector<dim>>& points) {
  Box box{points.front(), points.front()};
  for (const Vector<dim>& point : points) {
    box.low = box.low.cwiseMin(point);
    box.high = box.high.cwiseMax(point);
  }
  return box;
}

template <int dim>
Box<dim> Box<dim>::widened(double part) const {
  const Vector<dim> margin = Vector<dim>::Constant(part * (high - low).maxCoeff());
  return {low - margin, high + margin};
}

template <int dim>
FacetedSurface<dim> zero_level(
    const std::function<SignedDistance<dim>(const Vector<dim>&)>& distance, const Box<dim>& box,
    int most) {
  const GapGrid<dim> grid(distance, box, most);
  FacetedSurface<dim> surface;
  std::vector<int> point_of(grid.count(), -1);
  for (long cell = 0; cell < grid.count(); ++cell) {
    if (!grid.begins_cell(grid.node(cell))) continue;
    const Vector<dim> x = mean_crossing(grid, cell);
    if (!x.allFinite()) continue;
    point_of[cell] = static_cast<int>(surface.points.size());
    surface.points.push_back(on_level<dim>(distance, x));
  }
  for (long node = 0; node < grid.count(); ++node) {
    const Place<dim> place = grid.node(node);
    for (int i = 0; i < dim; ++i) {
      bool within = place[i] < grid.cells(i);
      for (int j = 0; j < dim; ++j)
        if (j != i) within = within && place[j] > 0 && place[j] < grid.cells(j);
      if (within && grid.inside(node) != grid.inside(node + grid.stride(i)))
        surface.facets.push_back(facet_across(grid, point_of, node, i));
    }
  }
  return surface;
}

template struct Box<2>;
template struct Box<3>;
template FacetedSurface<2> zero_level(const std::function<SignedDistance<2>(const Vector<2>&)>&,
                                      const Box<2>&, int);
template FacetedSurface<3> zero_level(const std::function<SignedDistance<3>(const Vector<3>&)>&,
                                      const Box<3>&, int);

}  // namespace gnomon
