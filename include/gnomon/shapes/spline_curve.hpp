// A smooth plane curve through given points, and the points of it that are nearest to another.
#pragma once

#include <array>
#include <gnomon/base/error.hpp>
#include <gnomon/base/tensor.hpp>
#include <vector>

namespace gnomon {

/// The points make no curve. The message says which of them (counted from 1), without a prefix.
struct CurveError : InputError {
  using InputError::InputError;
};

/// The cubic spline through given points, over the sum of the distances between them: C2 in this
/// parameter, and so a curve with continuous tangent and curvature. A closed one is periodic; an
/// open one is natural, without curvature at its ends, and continues straight beyond them without
/// end.
///
/// It never changes; many threads may use one.
class SplineCurve {
public:
  /// Most points of a curve.
  static constexpr std::size_t max_points = 10'000;
  static constexpr double largest_coordinate = 1e30;

  /// Throws CurveError for fewer than two points (closed: three), more than max_points, numbers
  /// that are not finite, two points in succession that coincide, and a curve that turns back on
  /// itself (a cusp) or crosses itself. A closed curve may repeat its first point at the end.
  SplineCurve(std::vector<Vector<2>> points, bool closed);

  /// Position and derivatives by the parameter.
  struct Place {
    Vector<2> position, first, second;
  };
  /// `parameter` is in [0, length()]; beyond, an open curve is straight and a closed one goes
  /// round.
  Place at(double parameter) const;

  struct Nearest {
    double parameter;
    Place place;
    double distance;
    bool unique;  ///< no other part of the curve is as near, and the curvature leaves no doubt
  };
  /// The nearest point of the curve to x. The same for the same x, and global: parts of the curve
  /// are only left out where a bound says that they are further away.
  Nearest nearest(const Vector<2>& x) const;

  bool closed() const { return closed_; }
  double length() const { return knots_.back(); }  ///< of the parameter [length]
  /// The parameters of the given points; of a closed curve, its end too.
  const std::vector<double>& knots() const { return knots_; }
  double extent() const { return extent_; }  ///< no curved part is further from the origin
  /// Of a closed curve: positive if it runs anticlockwise.
  double signed_area() const;
  /// The same curve in the other direction.
  SplineCurve reversed() const;

private:
  /// Between two knots, in Bernstein form over [0, 1].
  struct Piece {
    std::array<Vector<2>, 4> control;
    double from, span;  // parameters

    Place at(double u) const;
  };
  /// A box around some pieces in succession; two smaller ones are within, or it has one piece.
  struct Box {
    Vector<2> low, high;
    std::size_t piece;
    std::array<std::size_t, 2> within;  // zero: none

    double least_distance(const Vector<2>& x) const;  // of the pieces, a bound from below
  };
  struct Search;

  void build(const std::vector<Vector<2>>& points);
  std::size_t add_box(std::size_t first_piece, std::size_t end);
  void refuse_cusps() const;
  void refuse_crossings() const;
  void search_box(const Box& box, Search& search) const;
  void search_piece(const Piece& piece, Search& search) const;
  static double refine(const Piece& piece, const Search& search, double low, double high,
                       bool rises);
  void search_rays(Search& search) const;

  std::vector<Vector<2>> points_;
  bool closed_;
  std::vector<double> knots_;
  std::vector<Piece> pieces_;
  std::vector<Box> boxes_;  // the first is around all
  double extent_ = 0;
};

}  // namespace gnomon
