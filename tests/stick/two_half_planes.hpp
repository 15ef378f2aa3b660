// Two bodies that touch as half-planes do: a cap of a cylinder on a block.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "stick/stick_scenes.hpp"

namespace gnomon::testing {

/// By which `count` heights that begin at `first` grow from one to the next, of a sum of one.
inline double growth_of_heights(double first, int count) {
  double least = 1, most = 3;
  for (int k = 0; k < 60; ++k) {
    const double growth = (least + most) / 2;
    double sum = 0, height = first;
    for (int i = 0; i < count; ++i, height *= growth) sum += height;
    (sum < 1 ? least : most) = growth;
  }
  return least;
}

/// A cap of a cylinder of 6 mm radius on a block, without common points: where they touch, squares
/// of `half` elements over `side` to both sides of the middle, and layers around them. The elements
/// that touch are `flat` times as high as wide.
inline std::string two_half_planes(int half, int layers, double growth, double side = 0.06,
                                   double flat = 1) {
  const int down = flat < 1 ? half * 6 / 5 : half;
  return fmt::format(R"(b = {}; w = 2; R = 6; n = {}; v = {}; q = {}; m = {}; r = {};
lift = R - Sqrt(R * R - b * b); side = R - Sqrt(R * R - w * w);
For k In {{0:1}}
  s = 1 - 2 * k; o = 20 * k; e = k * lift; g = k * side;
  Point(o+1) = {{-b, e, 0}}; Point(o+2) = {{-b, e - s * b, 0}};
  Point(o+3) = {{b, e - s * b, 0}}; Point(o+4) = {{b, e, 0}};
  Point(o+5) = {{-w, g, 0}}; Point(o+6) = {{-w, g - s * w, 0}};
  Point(o+7) = {{w, g - s * w, 0}}; Point(o+8) = {{w, g, 0}};
  Line(o+1) = {{o+1, o+2}}; Line(o+2) = {{o+2, o+3}}; Line(o+3) = {{o+3, o+4}};
  If (k == 0)
    Line(o+4) = {{o+4, o+1}}; Line(o+5) = {{o+1, o+5}}; Line(o+8) = {{o+4, o+8}};
  Else
    Point(o+9) = {{0, R, 0}};
    Circle(o+4) = {{o+4, o+9, o+1}}; Circle(o+5) = {{o+1, o+9, o+5}}; Circle(o+8) = {{o+4, o+9, o+8}};
  EndIf
  Line(o+6) = {{o+2, o+6}}; Line(o+7) = {{o+3, o+7}};
  Line(o+9) = {{o+5, o+6}}; Line(o+10) = {{o+6, o+7}}; Line(o+11) = {{o+7, o+8}};
  Curve Loop(o+1) = {{o+1, o+2, o+3, o+4}}; Plane Surface(o+1) = {{o+1}};
  Curve Loop(o+2) = {{o+5, o+9, -(o+6), -(o+1)}}; Plane Surface(o+2) = {{o+2}};
  Curve Loop(o+3) = {{o+6, o+10, -(o+7), -(o+2)}}; Plane Surface(o+3) = {{o+3}};
  Curve Loop(o+4) = {{o+7, o+11, -(o+8), -(o+3)}}; Plane Surface(o+4) = {{o+4}};
  Transfinite Curve {{o+2, o+4, o+10}} = 2 * n + 1;
  Transfinite Curve {{o+1, -(o+3)}} = v + 1 Using Progression q;
  Transfinite Curve {{o+9, o+11}} = v + 1;
  Transfinite Curve {{o+5, o+6, o+7, o+8}} = m + 1 Using Progression r;
  Transfinite Surface {{o+1}}; Transfinite Surface {{o+2}};
  Transfinite Surface {{o+3}}; Transfinite Surface {{o+4}};
  Recombine Surface {{o+1, o+2, o+3, o+4}};
EndFor
Physical Curve("bottom") = {{10}}; Physical Curve("face") = {{4}};
Physical Curve("top") = {{30}}; Physical Curve("round") = {{24}};
Physical Curve("sides") = {{29, 31}};
Physical Surface("flat") = {{1, 2, 3, 4}}; Physical Surface("cap") = {{21, 22, 23, 24}};
)",
                     side, half, down, flat < 1 ? growth_of_heights(flat / half, down) : 1, layers,
                     growth);
}

/// Of two similar bodies under a tangential force of ratio Q / (f P), found by the run.
struct Mindlin {
  static constexpr double P = 18.5, R = 6, f = 0.6, k = 2 * 2.9e-8, modulus = 2e5 / (2 * 0.91);
  double ratio = 0;
  static double a() { return std::sqrt(4 * P * R / (M_PI * modulus)); }
  static double p0() { return 2 * P / (M_PI * a()); }
  double c() const { return a() * std::sqrt(1 - ratio); }
  static double elliptic(double half, double x) {
    return p0() / a() * std::sqrt(std::max(0.0, half * half - x * x));
  }
  double traction(double x) const { return f * (elliptic(a(), x) - elliptic(c(), x)); }
  /// Area per cycle, the integral of 4 k f p g*, g* the gap under P (1 - ratio).
  double worn_per_cycle() const {
    constexpr int parts = 20000;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
      const double x = c() + (a() - c()) * (i + 0.5) / parts, xi = x / c();
      const double gap = c() * c() / (2 * R) * (xi * std::sqrt(xi * xi - 1) - std::acosh(xi));
      sum += 4 * k * f * elliptic(a(), x) * gap;
    }
    return 2 * sum * (a() - c()) / parts;
  }
};

}  // namespace gnomon::testing
