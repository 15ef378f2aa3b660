// Friction that may stick between two bodies: derivatives, frames, similar bodies, limits.
#include <fmt/format.h>

#include <cmath>

#include "stick/stick_scenes.hpp"
#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_stick_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// A cap of a cylinder of 6 mm radius on a block, without common points: where they touch, squares
/// of `half` elements to both sides of the middle, and layers around them.
std::string two_half_planes(int half, int layers, double growth) {
  return fmt::format(R"(b = 0.06; w = 2; R = 6; n = {}; m = {}; r = {};
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
  Transfinite Curve {{o+1, o+3, o+9, o+11}} = n + 1;
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
                     half, layers, growth);
}

class PairFretting : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    if (IsSkipped()) return;
    folder_.write("two.geo", two_half_planes(16, 14, 1.32));
    folder_.write("coarse.geo", two_half_planes(4, 4, 3));
  }
  /// Pressed by 18.5 N/mm; the cap moves to and fro.
  static std::string similar(const std::string& drive = "x = \"1e-3 * sin(2*pi*tau)\"") {
    return fmt::format(R"(problem = "worn_body"
mesh.file = "two.geo"
body = [ {{ name = "cap", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "flat", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["cap", "flat"], friction = 0.6, stick = true }} ]
motion = [ {{ body = "cap", cycle = {{ {} }} }} ]
support = [ {{ on = "bottom" }}, {{ on = "sides", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -18.5] }} ]
wear = {{ on = ["round", "face"], coefficient = 2.9e-8 }}
time.cycles = 1000
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
[cycle]
period = 1.0
phases = 4
)",
                       drive);
  }
};

TEST_F(PairFretting, JacobianEqualsFiniteDifferences) {
  const auto model = this->model(similar(), {"mesh.file=coarse.geo", "cycle.phases=3",
                                             "time.cycles=1e5", "wear.coefficient=2.9e-7"});
  Counters counters;
  std::vector<double> y = model->start(counters).y;
  const Structure& structure = model->system().structure();
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += 0.05 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  const ActiveSet branch = active_set(model->system(), 0, y);
  EXPECT_GT(std::ranges::count(branch, 1), 4);
  EXPECT_GT(std::ranges::count(branch, 0), 4);
  check_jacobian(model->system(), 0, y, 0.2, &branch, 1e-5);
}

/// Two phases, in which both bodies are turned together and the master goes on by `stroke`.
template <int dim>
AssemblyParts<dim> on_a_path(const TwoBodies& pair, double stroke) {
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  parts.pairs.front().motion = {};
  parts.interface.sticks = true;
  Cycle cycle;
  cycle.period = 2;
  parts.cycle = CyclicContact<dim>{{.cycle = cycle, .axis = {}}, {2, {}}};
  parts.cycle->motion.sliding = parts.pairs.front().numbers;
  for (int p = 0; p < 2; ++p) {
    Phase<dim> phase{.position = 0.5 * (p + 1), .weight = 0.5, .interval = 0.5, .places = {}};
    Tensor<dim> turn = Tensor<dim>::Identity();
    turn.template topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.7 + p).toRotationMatrix();
    phase.places.assign(2, {.turn = turn, .shift = Vector<dim>::Constant(0.3)});
    phase.places[1].shift += p * stroke * turn.col(0);
    parts.phases.push_back(std::move(phase));
  }
  return parts;
}

TEST(PairFrettingInSpace, JacobianEqualsFiniteDifferences) {
  TwoBodies pair{.upper = {.along = 5, .high = 2, .wear = 1e-3},
                 .lower = {.along = 7, .high = 2, .from = 0.1, .wear = 2e-3},
                 .friction = 0.3};
  const auto check = [](const auto& model) {
    std::vector<double> y = rough_state(model, {.every = 3});
    const ActiveSet branch = active_set(model.system(), 0, y);
    EXPECT_GT(std::ranges::count(branch, 1), 4);
    EXPECT_GT(std::ranges::count(branch, 0), 4);
    check_jacobian(model.system(), 0, y, 0.2, &branch, 1e-6);
  };
  check(WearModel<2>(on_a_path<2>(pair, 0.1)));
  pair.upper.along = 2, pair.upper.high = pair.lower.high = 1, pair.upper.across = 2;
  pair.lower.along = 3, pair.lower.across = 1;
  check(WearModel<3>(on_a_path<3>(pair, 0.1)));
}

}  // namespace
}  // namespace gnomon::pair_stick_test
