// How much of a surface a load or the wear brings into contact, from the gaps of unloaded bodies.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace gnomon {

/// Gaps between the contact surface and the counter-body where they first touch, with their areas.
/// As if each node were on a spring of its own, it tells how much of the surface a load or the wear
/// brings into contact: enough for scales.
class GapProfile {
public:
  /// One entry for each contact node: gap from the first touch [length], area.
  GapProfile(std::vector<double> gaps, std::vector<double> areas) {
    std::vector<std::size_t> order(gaps.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return gaps[a] < gaps[b]; });
    for (std::size_t k : order) {
      gap_.push_back(gaps[k] - gaps[order.front()]);
      area_.push_back(areas[k]);
    }
  }

  double largest() const { return gap_.empty() ? 0 : gap_.back(); }
  /// Of the surface that overlaps when the bodies approach by `depth`.
  double area(double depth) const {
    double sum = 0;
    for (std::size_t k = 0; k < gap_.size() && gap_[k] <= depth; ++k) sum += area_[k];
    return sum;
  }
  /// Nodes of that surface.
  double count(double depth) const {
    return static_cast<double>(std::upper_bound(gap_.begin(), gap_.end(), depth) - gap_.begin());
  }
  /// Volume of the overlap.
  double volume(double depth) const {
    double sum = 0;
    for (std::size_t k = 0; k < gap_.size() && gap_[k] < depth; ++k)
      sum += area_[k] * (depth - gap_[k]);
    return sum;
  }

  /// The depth with that volume of overlap.
  /// Volume is linear in the depth between one gap and the next.
  double depth_of(double volume) const {
    double area = 0, moment = 0;
    for (std::size_t k = 0; k < gap_.size(); ++k) {
      area += area_[k];
      moment += area_[k] * gap_[k];
      const double depth = (volume + moment) / area;
      if (k + 1 == gap_.size() || depth <= gap_[k + 1]) return depth;
    }
    return 0;
  }

private:
  std::vector<double> gap_, area_;  // ascending gaps
};

/// How far the bodies come together, on springs of stiffness E* by the width of the contact.
struct Indentation {
  double depth, area, force;
};

/// `solid`: areas are areas; else lengths, per unit of thickness.
inline double width_of(double area, bool solid) {
  return solid ? std::sqrt(area) : area;
}

inline Indentation by_force(const GapProfile& gaps, double force, double modulus, bool solid) {
  Indentation at{0, gaps.area(0), force};
  for (int k = 0; k < 30; ++k) {  // the width follows the depth
    at.depth = gaps.depth_of(force * width_of(at.area, solid) / modulus);
    at.area = std::max(gaps.area(at.depth), gaps.area(0));
  }
  return at;
}

inline Indentation by_overlap(const GapProfile& gaps, double depth, double modulus, bool solid) {
  const double area = std::max(gaps.area(depth), gaps.area(0));
  return {depth, area, modulus / width_of(area, solid) * gaps.volume(depth)};
}

}  // namespace gnomon
