// Two bodies of which one turns about the normal of their contact, to and fro.
#include <fmt/format.h>

#include <cmath>

#include "part/part_scene.hpp"
#include "support/problem_run.hpp"

namespace gnomon::torsion_test {
namespace {

using namespace testing;

/// Square bars of side 1, end to end, whose axis is not that of z.
constexpr const char* two_bars = R"(SetFactory("OpenCASCADE");
Box(1) = {-0.4, -0.3, -0.5, 1, 1, 0.5}; Box(2) = {-0.4, -0.3, 0, 1, 1, 0.5};
Transfinite Curve {1, 3, 5, 7, 13, 15, 17, 19} = 3;
Transfinite Curve {2, 4, 6, 8, 9, 10, 11, 12} = 6;
Transfinite Curve {14, 16, 18, 20, 21, 22, 23, 24} = 7;
Transfinite Surface "*"; Transfinite Volume "*"; Recombine Surface "*";
Physical Surface("bottom") = {5}; Physical Surface("face") = {6}; Physical Surface("top") = {12};
Physical Volume("lower") = {1}; Physical Volume("upper") = {2};
)";

class Torsion : public PartScenes {
protected:
  /// The end of one body turns, the other is pressed on it.
  std::unique_ptr<Model> bars(bool lower_turns, const std::string& angle) const {
    folder_.write("bars.geo", two_bars);
    return model(fmt::format(R"toml(problem = "worn_body"
mesh.file = "bars.geo"
body = [ {{ name = "lower", young_modulus = 2e5, poisson_ratio = 0.0, material = "linear" }},
         {{ name = "upper", young_modulus = 2e5, poisson_ratio = 0.0, material = "linear" }} ]
pair = [ {{ bodies = ["lower", "upper"], friction = 0.1, stick = true }} ]
support = [ {{ on = "bottom" }}, {{ on = "top" }} ]
wear = {{ on = ["face"], coefficient = 1e-8 }}
time.cycles = 10
cycle = {{ period = 1.0, phases = 4 }}
[[motion]]
body = "{}"
center = [0.1, 0.2, 0.0]
axis = [0.0, 0.0, 1.0]
cycle.rotation = "{}"
[[motion]]
body = "{}"
cycle.z = "{}"
)toml",
                             lower_turns ? "lower" : "upper", angle,
                             lower_turns ? "upper" : "lower", lower_turns ? -1e-3 : 1e-3));
  }
};

/// The mean distance from its middle of a square of side 1, by areas of nodes.
double mean_radius(int elements) {
  double sum = 0;
  for (int i = 0; i <= elements; ++i)
    for (int j = 0; j <= elements; ++j) {
      const double area = (i % elements == 0 ? 0.5 : 1) * (j % elements == 0 ? 0.5 : 1);
      sum += area * std::hypot(double(i) / elements - 0.5, double(j) / elements - 0.5);
    }
  return sum / (elements * elements);
}

TEST_F(Torsion, ABarOnAnotherSlipsAtTheMomentOfAnEvenPressure) {
  constexpr double pressure = 200, f = 0.1, angle = 0.02;
  EXPECT_NEAR(mean_radius(400), 0.382598, 1e-5);  // the integral
  const double moment = f * pressure * mean_radius(5);
  const double elastic = moment / (1e5 * 0.140577);  // Saint-Venant, of both halves
  Counters counters;
  for (const bool lower_turns : {false, true}) {
    const auto model = bars(lower_turns, "0.02 * sin(2*pi*tau)");
    const State start = model->start(counters);
    EXPECT_NEAR(observed(*model, start, "contact_force") / pressure, 1, 1e-3);
    EXPECT_NEAR(observed(*model, start, "friction_moment") / moment, 1, 2e-3);
    EXPECT_NEAR(observed(*model, start, "twist"), 2 * angle, 1e-12);
    EXPECT_NEAR(observed(*model, start, "stroke"), 0, 1e-12);
    EXPECT_NEAR(observed(*model, start, "friction_work") / (4 * moment * (angle - elastic)), 1,
                5e-3);
    // The moment acts in the sense of the angle, whichever turns: at the largest angle it is
    // positive.
    const std::vector<double> turn = model->contact(start).value().phase_turn;
    for (std::size_t p = 0; p < turn.size(); p += 2)
      if (std::abs(turn[p]) > angle / 2) EXPECT_GT(turn[p] * turn[p + 1], 0.5 * angle * moment);
  }
}

}  // namespace
}  // namespace gnomon::torsion_test
