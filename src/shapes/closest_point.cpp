// The nearest point of a spline curve. On each piece that may hold it all places are found where
// the line to x is perpendicular to the curve, (c - x) . c' = 0: the roots of a polynomial of
// degree 5, isolated by the signs of its Bernstein coefficients (Descartes) and refined by Newton's
// method within the bracket. No start value, so nothing to go wrong with one.

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/spline_curve.hpp>
#include <limits>
#include <utility>

namespace gnomon {

namespace {

using Coefficients = std::array<double, 6>;

int sign_changes(const Coefficients& f) {
  int changes = 0, last = 0;
  for (const double value : f) {
    const int sign = value > 0 ? 1 : value < 0 ? -1 : 0;
    if (sign != 0 && last != 0 && sign != last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

int first_sign(const Coefficients& f) {
  for (const double value : f)
    if (value != 0) return value > 0 ? 1 : -1;
  return 0;
}

double largest(const Coefficients& f) {
  double result = 0;
  for (const double value : f) result = std::max(result, std::abs(value));
  return result;
}

/// The coefficients over the left half; `f` becomes those of the right (de Casteljau).
Coefficients split(Coefficients& f) {
  Coefficients left{};
  for (int level = 0; level < 6; ++level) {
    left[level] = f[0];
    for (int i = 0; i + level < 5; ++i) f[i] = (f[i] + f[i + 1]) / 2;
  }
  return left;
}

/// (b - x) . b' of a cubic, b' without its factor 3 / span.
Coefficients stationary(const std::array<Vector<2>, 4>& b, const Vector<2>& x) {
  constexpr std::array<double, 4> three = {1, 3, 3, 1};
  constexpr std::array<double, 3> two = {1, 2, 1};
  constexpr std::array<double, 6> five = {1, 5, 10, 10, 5, 1};
  Coefficients f{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j)
      f[i + j] += three[i] * two[j] / five[i + j] * (b[i] - x).dot(b[j + 1] - b[j]);
  return f;
}

}  // namespace

double SplineCurve::Box::least_distance(const Vector<2>& x) const {
  const Vector<2> outside = (low - x).cwiseMax(x - high).cwiseMax(Vector<2>::Zero());
  return outside.norm();
}

/// The two nearest places so far that are apart from each other.
struct SplineCurve::Search {
  Vector<2> x;
  double apart;  // places closer than this are one
  double equal;  // distances that differ by less are the same
  Nearest best{0, {x, x, x}, std::numeric_limits<double>::infinity(), true};
  bool rival = false;  // whether `best` is a minimum along the curve, not just a given point
  double second = std::numeric_limits<double>::infinity();
  bool flat = false;  // a whole piece is equally near

  void offer(double parameter, const Place& place, bool is_minimum) {
    const double distance = (place.position - x).norm();
    const bool other = (place.position - best.place.position).norm() > apart;
    if (distance < best.distance) {
      if (rival && other) second = std::min(second, best.distance);
      best = {parameter, place, distance, true};
      rival = is_minimum;
    } else if (is_minimum && other) {
      second = std::min(second, distance);
    }
  }
  /// (c - x) . c' and its derivative by the parameter.
  double slope(const Place& place) const { return (place.position - x).dot(place.first); }
  double bend(const Place& place) const {
    return place.first.squaredNorm() + (place.position - x).dot(place.second);
  }
};

/// The nearer box first, and none that cannot hold a place as near as the best so far.
void SplineCurve::search_box(const Box& box, Search& search) const {
  if (box.within[0] == 0) return search_piece(pieces_[box.piece], search);
  std::array<std::pair<double, std::size_t>, 2> inner;
  for (int i = 0; i < 2; ++i)
    inner[i] = {boxes_[box.within[i]].least_distance(search.x), box.within[i]};
  std::sort(inner.begin(), inner.end());
  for (const auto& [distance, index] : inner)
    if (distance <= search.best.distance + search.equal) search_box(boxes_[index], search);
}

/// The one root between `low` and `high`, by Newton's method that bisects where it would leave.
double SplineCurve::refine(const Piece& piece, const Search& search, double low, double high,
                           bool rises) {
  constexpr double rounding = 1e-16;
  double u = (low + high) / 2;
  for (int k = 0; k < 100 && high - low > rounding; ++k) {
    const Place place = piece.at(u);
    const double f = search.slope(place), bend = piece.span * search.bend(place);
    if (f == 0) break;
    ((f < 0) == rises ? low : high) = u;
    double next = (low + high) / 2;
    if (bend != 0 && u - f / bend > low && u - f / bend < high) next = u - f / bend;
    if (std::abs(next - u) <= rounding) break;
    u = next;
  }
  return u;
}

/// Both ends, which rounding may hide from the pieces that meet there, and all roots.
void SplineCurve::search_piece(const Piece& piece, Search& search) const {
  struct Part {
    Coefficients f;
    double low, high;
  };
  constexpr double nothing = 1e-14, narrow = 1e-9, wide = 1e-3;
  const auto offer = [&](double u) {
    const Place place = piece.at(u);
    search.offer(piece.from + u * piece.span, place, search.bend(place) >= 0);
  };
  for (const double end : {0.0, 1.0})
    search.offer(piece.from + end * piece.span, piece.at(end), false);
  double size = 0;
  for (int j = 0; j < 3; ++j)
    size = std::max(size, (piece.control[j] - search.x).norm() *
                              (piece.control[j + 1] - piece.control[j]).norm());
  std::vector<Part> parts = {{stationary(piece.control, search.x), 0, 1}};
  while (!parts.empty()) {
    Part part = parts.back();
    parts.pop_back();
    const int changes = sign_changes(part.f);
    const double middle = (part.low + part.high) / 2, width = part.high - part.low;
    if (largest(part.f) <= nothing * size) {  // an arc about x, or x itself is on the curve
      search.flat = search.flat || width > wide;
      offer(middle);
    } else if (changes == 1) {
      offer(refine(piece, search, part.low, part.high, first_sign(part.f) < 0));
    } else if (changes > 1 && width < narrow) {
      offer(middle);
    } else if (changes > 1) {
      const Coefficients left = split(part.f);
      parts.push_back({part.f, middle, part.high});
      parts.push_back({left, part.low, middle});
    }
  }
}

/// Beyond the ends of an open curve.
void SplineCurve::search_rays(Search& search) const {
  for (const double end : {0.0, length()}) {
    const Place place = at(end);
    const double along = (search.x - place.position).dot(place.first) / place.first.squaredNorm();
    if (end == 0 ? along < 0 : along > 0) search.offer(end + along, at(end + along), true);
  }
}

SplineCurve::Nearest SplineCurve::nearest(const Vector<2>& x) const {
  const double size = extent_ + x.norm();
  Search search{.x = x, .apart = 1e-6 * extent_, .equal = 1e-12 * size};
  search_box(boxes_.front(), search);
  if (!closed_) search_rays(search);
  search.best.unique = !search.flat && search.second > search.best.distance + search.equal;
  return search.best;
}

}  // namespace gnomon
