#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <gnomon/shapes/spline_curve.hpp>
#include <utility>

namespace gnomon {

namespace {

using Points = std::vector<Vector<2>>;

/// The second derivatives at the points: zero at the ends of a natural spline; of a closed one,
/// whose last point repeats the first, periodic.
Points moments_of(const Points& p, const std::vector<double>& h, bool closed) {
  const auto pieces = static_cast<int>(h.size()), first = closed ? 0 : 1, count = pieces - first;
  Points moments(p.size(), Vector<2>::Zero());
  if (count == 0) return moments;
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d rhs(count, 2);
  for (int k = 0; k < count; ++k) {
    const int i = first + k, before = i == 0 ? pieces - 1 : i - 1;
    entries.emplace_back(k, k, 2 * (h[before] + h[i]));
    const int next = k + 1 < count ? k + 1 : 0;
    if (closed || next > k) entries.insert(entries.end(), {{k, next, h[i]}, {next, k, h[i]}});
    rhs.row(k) = 6 * ((p[i + 1] - p[i]) / h[i] - (p[i] - p[before]) / h[before]);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixX2d solved = Eigen::SimplicialLDLT<decltype(matrix)>(matrix).solve(rhs);
  for (int k = 0; k < count; ++k) moments[first + k] = solved.row(k);
  if (closed) moments.back() = moments.front();
  return moments;
}

}  // namespace

SplineCurve::SplineCurve(Points points, bool closed) : points_(std::move(points)), closed_(closed) {
  const auto coincide = [](const Vector<2>& a, const Vector<2>& b) {
    return !((a - b).norm() > 1e-12 * (a.norm() + b.norm()));
  };
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (!(points_[i].cwiseAbs().maxCoeff() <= largest_coordinate))
      throw CurveError(
          fmt::format("expected finite coordinates of less than {:g} mm, got {} and {} at point {}",
                      largest_coordinate, points_[i][0], points_[i][1], i + 1));
  if (closed_ && points_.size() > 1 && coincide(points_.front(), points_.back()))
    points_.pop_back();
  const std::size_t least = closed_ ? 3 : 2;
  if (points_.size() < least || points_.size() > max_points)
    throw CurveError(fmt::format("expected {} to {} different points of {} curve, got {}", least,
                                 max_points, closed_ ? "a closed" : "an open", points_.size()));
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (coincide(points_[i - 1], points_[i]))
      throw CurveError(
          fmt::format("expected different points, but points {} and {} coincide", i, i + 1));
  Points through = points_;
  if (closed_) through.push_back(points_.front());
  build(through);
  refuse_cusps();
  refuse_crossings();
}

void SplineCurve::build(const Points& p) {
  std::vector<double> h;
  knots_ = {0};
  for (std::size_t i = 1; i < p.size(); ++i) {
    h.push_back((p[i] - p[i - 1]).norm());
    knots_.push_back(knots_.back() + h.back());
  }
  const Points M = moments_of(p, h, closed_);
  for (std::size_t i = 0; i < h.size(); ++i) {
    const Vector<2> chord = (p[i + 1] - p[i]) / h[i];
    const Vector<2> start = chord - h[i] / 6 * (2 * M[i] + M[i + 1]);
    const Vector<2> end = chord + h[i] / 6 * (M[i] + 2 * M[i + 1]);
    Piece piece{
        {p[i], p[i] + h[i] / 3 * start, p[i + 1] - h[i] / 3 * end, p[i + 1]}, knots_[i], h[i]};
    for (const Vector<2>& control : piece.control) extent_ = std::max(extent_, control.norm());
    pieces_.push_back(piece);
  }
  add_box(0, pieces_.size());
}

/// The control points of a piece have it in their hull.
std::size_t SplineCurve::add_box(std::size_t first, std::size_t end) {
  const std::size_t own = boxes_.size();
  boxes_.emplace_back();
  Box box{pieces_[first].control[0], pieces_[first].control[0], first, {0, 0}};
  for (std::size_t k = first; k < end; ++k)
    for (const Vector<2>& control : pieces_[k].control)
      box.low = box.low.cwiseMin(control), box.high = box.high.cwiseMax(control);
  if (end - first > 1) {
    const std::size_t middle = first + (end - first) / 2;
    box.within = {add_box(first, middle), add_box(middle, end)};
  }
  boxes_[own] = box;
  return own;
}

SplineCurve::Place SplineCurve::Piece::at(double u) const {
  const double v = 1 - u;
  const auto& b = control;
  const Vector<2> d0 = b[1] - b[0], d1 = b[2] - b[1], d2 = b[3] - b[2];
  return {v * v * v * b[0] + 3 * u * v * v * b[1] + 3 * u * u * v * b[2] + u * u * u * b[3],
          3 / span * (v * v * d0 + 2 * u * v * d1 + u * u * d2),
          6 / (span * span) * (v * (d1 - d0) + u * (d2 - d1))};
}

SplineCurve::Place SplineCurve::at(double parameter) const {
  if (closed_) parameter -= length() * std::floor(parameter / length());
  const double inside = std::clamp(parameter, 0.0, length());
  const auto behind = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, inside);
  const Piece& piece = pieces_[static_cast<std::size_t>(behind - knots_.begin()) - 1];
  Place place = piece.at((inside - piece.from) / piece.span);
  if (inside == parameter) return place;
  place.position += (parameter - inside) * place.first;
  place.second.setZero();
  return place;
}

double SplineCurve::signed_area() const {
  double area = 0;
  for (const Piece& piece : pieces_) {  // of a polynomial of degree 5, by three Gauss points
    const double off = std::sqrt(0.15);
    for (const auto& [u, weight] : {std::pair(0.5 - off, 5.0), {0.5, 8.0}, {0.5 + off, 5.0}}) {
      const Place place = piece.at(u);
      area += weight / 36 * piece.span *
              (place.position[0] * place.first[1] - place.position[1] * place.first[0]);
    }
  }
  return area;
}

SplineCurve SplineCurve::reversed() const {
  return {Points(points_.rbegin(), points_.rend()), closed_};
}

}  // namespace gnomon
