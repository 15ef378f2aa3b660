#include "mesh/facet_bins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/facet_table.hpp"

namespace gnomon {

namespace {

/// The part of the line from + s along where it is within the box; empty where first > last.
template <int dim>
std::array<double, 2> within(const Vector<dim>& low, const Vector<dim>& high,
                             const Vector<dim>& from, const Vector<dim>& along, double reach) {
  double first = -reach, last = reach;
  for (int i = 0; i < dim; ++i) {
    const double to_low = low[i] - from[i], to_high = high[i] - from[i];
    if (along[i] == 0) {
      if (to_low > 0 || to_high < 0) return {1, 0};
      continue;
    }
    first = std::max(first, std::min(to_low / along[i], to_high / along[i]));
    last = std::min(last, std::max(to_low / along[i], to_high / along[i]));
  }
  return {first, last};
}

}  // namespace

template <int dim>
FacetBins<dim>::FacetBins(const std::vector<typename Mesh<dim>::Facet>& facets,
                          const std::vector<Vector<dim>>& x)
    : low_(Vector<dim>::Constant(std::numeric_limits<double>::infinity())), high_(-low_) {
  std::vector<std::array<Vector<dim>, 2>> boxes;
  double mean = 0;
  for (const auto& facet : facets) {
    auto& [low, high] = boxes.emplace_back(std::array<Vector<dim>, 2>{x[facet[0]], x[facet[0]]});
    for (const int node : facet) low = low.cwiseMin(x[node]), high = high.cwiseMax(x[node]);
    low_ = low_.cwiseMin(low), high_ = high_.cwiseMax(high);
    mean += (high - low).maxCoeff() / static_cast<double>(facets.size());
  }
  if (facets.empty()) return;
  // As large as a facet, but not many more than the facets.
  const double most = 8.0 * static_cast<double>(facets.size());
  const auto number = [&] {
    double bins = 1;
    for (int i = 0; i < dim; ++i) bins *= std::floor((high_[i] - low_[i]) / size_) + 1;
    return bins;
  };
  size_ = mean > 0 ? mean : 1;
  while (number() > most) size_ *= 1.2;
  std::size_t bins = 1;
  for (int i = 0; i < dim; ++i) {
    count_[i] = static_cast<int>((high_[i] - low_[i]) / size_) + 1;
    bins *= static_cast<std::size_t>(count_[i]);
  }
  bins_.resize(bins);
  for (std::size_t f = 0; f < boxes.size(); ++f)
    visit_box(boxes[f][0], boxes[f][1],
              [&](std::size_t bin) { bins_[bin].push_back(static_cast<int>(f)); });
}

template <int dim>
typename FacetBins<dim>::Place FacetBins<dim>::place(const Vector<dim>& x) const {
  Place result;
  for (int i = 0; i < dim; ++i)
    result[i] = static_cast<int>(
        std::clamp((x[i] - low_[i]) / size_, 0.0, static_cast<double>(count_[i] - 1)));
  return result;
}

template <int dim>
template <class Visit>
void FacetBins<dim>::visit_box(const Vector<dim>& low, const Vector<dim>& high,
                               const Visit& visit) const {
  const Place first = place(low), last = place(high);
  for (Place at = first;;) {
    std::size_t bin = 0;
    for (int i = dim - 1; i >= 0; --i)
      bin = bin * static_cast<std::size_t>(count_[i]) + static_cast<std::size_t>(at[i]);
    visit(bin);
    int i = 0;
    for (; i < dim && at[i] == last[i]; ++i) at[i] = first[i];
    if (i == dim) return;
    ++at[i];
  }
}

template <int dim>
std::vector<int> FacetBins<dim>::near_line(const Vector<dim>& from, const Vector<dim>& along,
                                           double reach, double radius) const {
  std::vector<int> result;
  if (bins_.empty()) return result;
  // Rounding may put a facet on the other side of a border.
  const double wide = radius + 1e-6 * size_;
  const Vector<dim> around = Vector<dim>::Constant(wide);
  const auto [first, last] = within<dim>(low_ - around, high_ + around, from, along, reach + wide);
  if (!(first <= last)) return result;
  // Boxes about pieces of the line.
  const auto pieces = static_cast<int>((last - first) / std::max(size_, radius)) + 1;
  for (int k = 0; k < pieces; ++k) {
    const Vector<dim> a = from + (first + (last - first) * k / pieces) * along,
                      b = from + (first + (last - first) * (k + 1) / pieces) * along;
    visit_box(a.cwiseMin(b) - around, a.cwiseMax(b) + around, [&](std::size_t bin) {
      result.insert(result.end(), bins_[bin].begin(), bins_[bin].end());
    });
  }
  sort_once(result);
  return result;
}

template class FacetBins<2>;
template class FacetBins<3>;

}  // namespace gnomon
