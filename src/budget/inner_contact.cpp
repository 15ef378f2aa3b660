#include "budget/inner_contact.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <set>

#include "base/spectrum.hpp"

namespace gnomon::budget {

namespace {

using Nodes = std::vector<std::size_t>;

Eigen::Vector3d place_of(const ContactSurface& surface, std::size_t node) {
  return Eigen::Vector3d::Map(surface.initial[node].data());
}

}  // namespace

std::vector<Nodes> patches_of(const ContactSurface& surface, const std::vector<Nodes>& neighbours) {
  std::vector<Nodes> patches;
  std::vector<char> open(surface.pressure.size());
  std::ranges::transform(surface.pressure, open.begin(), [](double p) { return !(p > 0); });
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (open[first]) continue;
    if (patches.empty() || !neighbours.empty()) patches.emplace_back();
    Nodes& patch = patches.back();
    const std::size_t begin = patch.size();
    const auto add = [&](std::size_t i) {
      if (!open[i]) patch.push_back(i);
      open[i] = true;
    };
    add(first);
    for (std::size_t k = begin; k < patch.size() && !neighbours.empty(); ++k)
      std::ranges::for_each(neighbours[patch[k]], add);
  }
  return patches;
}

namespace {

/// Whether the nodes of a patch at an end of its box do not move out of that plane, while others do
/// move along its normal.
bool is_symmetric(const ContactSurface& surface, const Nodes& patch, double end, double extent,
                  int k) {
  constexpr double small = 1e-9;
  double there = 0, elsewhere = 0;
  const auto c = static_cast<std::size_t>(k);
  for (const std::size_t i : patch) {
    const bool at_end = std::abs(surface.initial[i][c] - end) <= small * extent;
    double& largest = at_end ? there : elsewhere;
    largest = std::max(largest, std::abs(surface.current[i][c] - surface.initial[i][c]));
  }
  return there < small * elsewhere;
}

/// Whether a patch of a plane contact goes all round: each of its nodes lies between two others.
bool is_closed(const ContactSurface& surface, const std::vector<Nodes>& neighbours,
               const Nodes& patch) {
  if (surface.dim != 2 || neighbours.empty()) return false;
  return std::ranges::all_of(patch, [&](std::size_t i) {
    const std::set<std::size_t> others(neighbours[i].begin(), neighbours[i].end());
    return others.size() >= 2 &&
           std::ranges::all_of(others, [&](std::size_t j) { return surface.pressure[j] > 0; });
  });
}

Nodes inside_of(const ContactSurface& surface, const Nodes& patch) {
  constexpr double flat = 1e-6, inner_part = 0.9, rounding = 1e-9;
  std::vector<Vector<3>> places;
  for (const std::size_t i : patch) places.push_back(place_of(surface, i));
  const auto [low, high] = Box<3>::around(places);
  const Eigen::Vector3d extent = high - low;
  Eigen::Vector3d middle = 0.5 * (low + high);
  std::array<bool, 3> mirrored{};
  for (int k = 0; k < 3; ++k) {
    if (extent[k] <= flat * extent.norm()) continue;
    for (const double end : {low[k], high[k]})
      if (is_symmetric(surface, patch, end, extent[k], k)) {
        middle[k] = end;
        mirrored[static_cast<std::size_t>(k)] = true;
      }
  }
  const auto apart = [&](std::size_t i) -> Eigen::Vector3d {
    return place_of(surface, i) - middle;
  };
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3, 3);
  for (const std::size_t i : patch) covariance += apart(i) * apart(i).transpose();
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      if (j != k && mirrored[static_cast<std::size_t>(k)]) covariance(j, k) = covariance(k, j) = 0;
  const Eigen::Matrix3d metric = pseudo_inverse(covariance, flat);
  const auto radius = [&](std::size_t i) { return std::sqrt(apart(i).dot(metric * apart(i))); };
  double edge = 0;
  for (const std::size_t i : patch) edge = std::max(edge, radius(i));
  Nodes inside;
  std::ranges::copy_if(patch, std::back_inserter(inside), [&](std::size_t i) {
    return radius(i) <= inner_part * edge * (1 + rounding);
  });
  // On an arc between two planes of symmetry no node is nearer to the axis than another.
  return inside.empty() ? patch : inside;
}

}  // namespace

std::vector<Nodes> surface_neighbours(const std::optional<Grid>& grid,
                                      const ContactSurface& surface) {
  if (!grid) return {};
  constexpr std::size_t none = -1;
  std::vector<std::size_t> place_of(grid->points.size(), none);
  for (std::size_t i = 0; i < surface.node.size(); ++i)
    place_of[static_cast<std::size_t>(surface.node[i])] = i;
  std::vector<Nodes> neighbours(surface.node.size());
  Nodes of_cell;
  for (std::size_t first = 0; first < grid->cells.size(); first += grid->corners()) {
    of_cell.clear();
    for (std::size_t k = first; k < first + grid->corners(); ++k)
      if (const std::size_t i = place_of[static_cast<std::size_t>(grid->cells[k])]; i != none)
        of_cell.push_back(i);
    for (const std::size_t i : of_cell)
      for (const std::size_t j : of_cell)
        if (i != j) neighbours[i].push_back(j);
  }
  return neighbours;
}

double reaches_edges(const ContactSurface& surface, const Nodes& inner) {
  constexpr double middle = 0.5, outer = 0.8;  // of the way from the middle of `inner` to its end
  constexpr double of_ellipse = 0.957;         // its mean over the middle
  constexpr double too_even = 0.95;
  std::vector<Vector<3>> touching, inside;
  for (std::size_t i = 0; i < surface.pressure.size(); ++i)
    if (surface.pressure[i] > 0) touching.push_back(place_of(surface, i));
  for (const std::size_t i : inner) inside.push_back(place_of(surface, i));
  if (inside.empty()) return 0;
  const Box<3> whole = Box<3>::around(touching), part = Box<3>::around(inside);
  Eigen::Index along = 0;
  (whole.high - whole.low).maxCoeff(&along);
  const auto way = [&](const Box<3>& box, const Vector<3>& x) {  // from -1 to 1
    const double low = box.low[along], high = box.high[along];
    return high > low ? (2 * x[along] - low - high) / (high - low) : 0;
  };
  struct Mean {
    double pressure = 0, ellipse = 0, count = 0;
  };
  std::array<Mean, 3> means;  // near one end, in the middle, near the other
  for (std::size_t k = 0; k < inner.size(); ++k) {
    const double at = way(part, inside[k]), by_whole = way(whole, inside[k]);
    if (std::abs(at) > middle && std::abs(at) < outer) continue;
    Mean& mean = means[std::abs(at) <= middle ? 1 : at < 0 ? 0 : 2];
    mean.pressure += surface.pressure[inner[k]];
    mean.ellipse += std::sqrt(1 - by_whole * by_whole) / of_ellipse;
    ++mean.count;
  }
  if (std::ranges::any_of(means, [](const Mean& mean) { return mean.count == 0; })) return 0;
  double reach = 1;
  for (const Mean& end : {means[0], means[2]}) {
    const double ellipse = end.ellipse / end.count,
                 found = end.pressure / end.count / (means[1].pressure / means[1].count);
    if (ellipse > too_even) return 0;
    reach = std::min(reach, (found - ellipse) / (1 - ellipse));
  }
  return std::max(reach, 0.0);
}

Nodes inner_nodes(const ContactSurface& surface, const std::vector<Nodes>& neighbours) {
  constexpr std::size_t least = 3;  // of a patch that has an inside
  Nodes inner;
  const std::vector<Nodes> patches = patches_of(surface, neighbours);
  const bool all_small =
      std::ranges::all_of(patches, [&](const Nodes& patch) { return patch.size() < least; });
  for (const Nodes& patch : patches)
    if (all_small || patch.size() >= least)
      std::ranges::copy(is_closed(surface, neighbours, patch) ? patch : inside_of(surface, patch),
                        std::back_inserter(inner));
  return inner;
}

Nodes without_edges(const ContactSurface& surface, const std::vector<Nodes>& neighbours,
                    const Nodes& inner) {
  constexpr std::size_t least = 3;
  Nodes best = inner;
  std::vector<char> beside(surface.pressure.size());
  std::ranges::transform(surface.pressure, beside.begin(), [](double p) { return !(p > 0); });
  for (int layer = 0; layer < 2; ++layer) {
    const std::vector<char> before = beside;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i])
        for (const std::size_t j : neighbours[i]) beside[j] = true;
    Nodes rest;
    std::ranges::copy_if(inner, std::back_inserter(rest),
                         [&](std::size_t i) { return !beside[i]; });
    if (rest.size() < least) return best;
    best = std::move(rest);
  }
  return best;
}

}  // namespace gnomon::budget
