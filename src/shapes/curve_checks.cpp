// What makes a curve useless as the border of a body: cusps, and places where it crosses itself.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <gnomon/shapes/spline_curve.hpp>

namespace gnomon {

namespace {

constexpr int parts = 16;  // straight lines for each piece of the curve

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

struct Line {
  Vector<2> start, end;
  std::size_t piece;  // of the curve, counted from 1; where it belongs to a ray, the nearest one
};

bool cross_each_other(const Line& a, const Line& b) {
  const Vector<2> along = a.end - a.start, other = b.end - b.start;
  const double from = cross(along, b.start - a.start), to = cross(along, b.end - a.start);
  const double back = cross(other, a.start - b.start), there = cross(other, a.end - b.start);
  return ((from < 0) != (to < 0)) && ((back < 0) != (there < 0));
}

bool boxes_meet(const Line& a, const Line& b) {
  return Eigen::AlignedBox2d(a.start).extend(a.end).intersects(
      Eigen::AlignedBox2d(b.start).extend(b.end));
}

}  // namespace

/// Where points lie far apart beside near ones a spline may nearly stand still or turn back.
void SplineCurve::refuse_cusps() const {
  constexpr double least_speed = 0.05;  // of the chord's
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    for (int i = 0; i <= parts; ++i)
      if (!(pieces_[k].at(double(i) / parts).first.norm() >= least_speed))
        throw CurveError(fmt::format(
            "the curve turns back between points {} and {}; expected points that follow each other "
            "along it, closer together where it bends",
            k + 1, k + 2 > points_.size() ? 1 : k + 2));
}

/// Of the polygon with `parts` sides for each piece, by a sweep along the direction in which it is
/// longer. The rays beyond the ends of an open curve count for 10,000 times its length.
void SplineCurve::refuse_crossings() const {
  std::vector<Line> lines;
  Vector<2> last = pieces_.front().at(0).position;
  const double far = 1e4 * (extent_ + length());
  if (!closed_) lines.push_back({at(-far).position, last, 1});
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    for (int i = 1; i <= parts; ++i) {
      const Vector<2> next = pieces_[k].at(double(i) / parts).position;
      lines.push_back({last, next, k + 1});
      last = next;
    }
  if (!closed_) lines.push_back({last, at(length() + far).position, pieces_.size()});

  const Vector<2> size = boxes_.front().high - boxes_.front().low;
  const int sweep = size[0] >= size[1] ? 0 : 1;
  std::vector<std::size_t> order(lines.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto left = [&](std::size_t i) {
    return std::min(lines[i].start[sweep], lines[i].end[sweep]);
  };
  const auto right = [&](std::size_t i) {
    return std::max(lines[i].start[sweep], lines[i].end[sweep]);
  };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return left(a) < left(b); });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && left(order[j]) <= right(order[i]); ++j) {
      const std::size_t a = std::min(order[i], order[j]), b = std::max(order[i], order[j]);
      const bool neighbours = b - a == 1 || (closed_ && a == 0 && b == lines.size() - 1);
      if (neighbours || !boxes_meet(lines[a], lines[b]) || !cross_each_other(lines[a], lines[b]))
        continue;
      const auto name = [&](std::size_t line) {
        const std::size_t piece = lines[line].piece;
        if (!closed_ && line == 0) return std::string("before point 1");
        if (!closed_ && line == lines.size() - 1)
          return fmt::format("beyond point {}", points_.size());
        return fmt::format("between points {} and {}", piece,
                           piece == points_.size() ? 1 : piece + 1);
      };
      throw CurveError(fmt::format("the curve crosses itself: {} and {}{}", name(a), name(b),
                                   closed_ ? "" : " (it goes on straight beyond its ends)"));
    }
}

}  // namespace gnomon
