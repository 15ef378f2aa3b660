// The nearest point of a spline curve. On each piece that may hold it all places are found where
// the line to x is perpendicular to the curve, (c - x) . c' = 0: the roots of a polynomial of
// degree 5, isolated by the signs of its Bernstein coefficients (Descartes) and refined by Newton's
// method within the bracket. No start value, so nothing to go wrong with one.

#include <algorithm>
#include <cmath>
#include <gnomon/laws/spline_curve.hpp>
#include <limits>

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

double SplineCurve::Piece::least_distance(const Vector<2>& x) const {
  const Vector<2> outside = (low - x).cwiseMax(x - high).cwiseMax(Vector<2>::Zero());
  return outside.norm();
}

/// The two nearest places so far that are apart from each other.
struct SplineCurve::Search {
  Vector<2> x;
  double apart;  // places closer than this are one
  Nearest best{0, {}, std::numeric_limits<double>::infinity(), true};
  double second = std::numeric_limits<double>::infinity();
  bool flat = false;  // a whole piece is equally near

  void offer(double parameter, const Place& place, bool may_rival) {
    const double distance = (place.position - x).norm();
    const bool other = (place.position - best.place.position).norm() > apart;
    if (distance < best.distance) {
      if (other && rival) second = std::min(second, best.distance);
      best = {parameter, place, distance, true};
      rival = may_rival;
    } else if (other && may_rival) {
      second = std::min(second, distance);
    }
  }

  bool rival = false;  // whether `best` is a minimum along the curve
};

void SplineCurve::search_piece(const Piece& piece, Search& search) const {
  const auto slope = [&](const Place& place) {
    return (place.position - search.x).dot(place.first);
  };
  const auto offer = [&](double u) {
    const Place place = piece.at(u);
    const double bend = place.first.squaredNorm() + (place.position - search.x).dot(place.second);
    search.offer(piece.from + u * piece.span, place, bend >= 0);
  };
  const auto refine = [&](double low, double high, bool rises) {
    double u = (low + high) / 2;
    for (int k = 0; k < 100 && high - low > 1e-16; ++k) {
      const Place place = piece.at(u);
      const double f = slope(place);
      ((f < 0) == rises ? low : high) = u;
      const double bend =
          piece.span * (place.first.squaredNorm() + (place.position - search.x).dot(place.second));
      double next = u - f / bend;
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (std::abs(next - u) <= 1e-16 || f == 0) break;
      u = next;
    }
    offer(u);
  };

  struct Part {
    Coefficients f;
    double low, high;
  };
  const Coefficients whole = stationary(piece.control, search.x);
  double size = 0;
  for (int j = 0; j < 3; ++j)
    size = std::max(size, (piece.control[j] - search.x).norm() *
                              (piece.control[j + 1] - piece.control[j]).norm());
  std::vector<Part> parts = {{whole, 0, 1}};
  while (!parts.empty()) {
    Part part = parts.back();
    parts.pop_back();
    const double largest =
        std::abs(*std::max_element(part.f.begin(), part.f.end(),
                                   [](double a, double b) { return std::abs(a) < std::abs(b); }));
    const int changes = sign_changes(part.f);
    const double middle = (part.low + part.high) / 2;
    if (largest <= 1e-14 * size) {  // a piece of a circle about x, or x itself on the curve
      search.flat = search.flat || part.high - part.low > 1e-3;
      offer(middle);
    } else if (changes == 1) {
      refine(part.low, part.high, first_sign(part.f) < 0);
    } else if (changes > 1 && part.high - part.low < 1e-9) {
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
  Search search{.x = x, .apart = 1e-6 * extent_};
  for (const Piece& piece : pieces_) {
    search.offer(piece.from, piece.at(0), false);
    search.offer(piece.from + piece.span, piece.at(1), false);
  }
  const double equal = 1e-12 * size;
  for (const Piece& piece : pieces_)
    if (piece.least_distance(x) <= search.best.distance + equal) search_piece(piece, search);
  if (!closed_) search_rays(search);
  search.best.unique = !search.flat && search.second > search.best.distance + equal;
  return search.best;
}

}  // namespace gnomon
