// Friction that may stick between two bodies: derivatives, frames, similar bodies, limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/checks/checks.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <limits>

#include "stick/stick_scenes.hpp"
#include "support/fretting_loop.hpp"
#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/turned_bodies.hpp"

namespace gnomon::pair_stick_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A cap of a cylinder of 6 mm radius on a block, without common points: where they touch, squares
/// of `half` elements over `side` to both sides of the middle, and layers around them.
std::string two_half_planes(int half, int layers, double growth, double side = 0.06) {
  return fmt::format(R"(b = {}; w = 2; R = 6; n = {}; m = {}; r = {};
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
                     side, half, layers, growth);
}

/// A pad, 0.8 mm wide, on a base of 1.2 mm.
constexpr const char* pad_on_base = R"(Point(1) = {0, -0.5, 0}; Point(2) = {1.2, -0.5, 0};
Point(3) = {1.2, 0, 0}; Point(4) = {0, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(11) = {0.3, 0, 0}; Point(12) = {1.1, 0, 0}; Point(13) = {1.1, 0.5, 0};
Point(14) = {0.3, 0.5, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Transfinite Curve {1, 3} = 19; Transfinite Curve {11, 13} = 14;
Transfinite Curve {2, 4, 12, 14} = 8;
Transfinite Surface {1}; Transfinite Surface {11}; Recombine Surface {1, 11};
Physical Curve("bottom") = {1}; Physical Curve("face") = {3}; Physical Curve("foot") = {11};
Physical Curve("top") = {13}; Physical Curve("sides") = {12, 14};
Physical Surface("base") = {1}; Physical Surface("pad") = {11};
)";

class PairFretting : public Fretting {
protected:
  void SetUp() override {
    Fretting::SetUp();
    if (IsSkipped()) return;
    folder_.write("two.geo", two_half_planes(16, 14, 1.32));
    folder_.write("coarse_two.geo", two_half_planes(6, 5, 2.2, 0.12));
    std::string lower = two_half_planes(16, 14, 1.32);
    lower.replace(lower.find("For k In {0:1}"), 14, "For k In {0:0}");
    lower.erase(lower.find("Physical Curve(\"top\")"));
    folder_.write("pad.geo", pad_on_base);
    folder_.write("lower.geo", lower + "Physical Surface(\"flat\") = {1, 2, 3, 4};\n");
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
  /// A pad under 10 N/mm, driven by `motion` or `load`.
  static std::string pad(const std::string& motion, const std::string& load,
                         const std::string& sides) {
    return fmt::format(R"(problem = "worn_body"
mesh.file = "pad.geo"
body = [ {{ name = "pad", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "base", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["base", "pad"], friction = 0.3 }} ]
friction.stick = true
{}
support = [ {{ on = "bottom" }}, {{ on = "sides", directions = ["x"]{} }} ]
load = [ {{ on = "top", force = [0.0, -10.0] }}{} ]
wear = {{ on = ["foot", "face"], coefficient = 1e-8 }}
time.cycles = 1000
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
[cycle]
period = 1.0
phases = 16
)",
                       motion, sides, load);
  }
  static std::string swinging_pad() {
    return pad("", ", { on = \"top\", force = [1.8, 0.0], cycle = \"sin(2*pi*tau)\" }",
               ", stiffness = 1e-6");
  }
};

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

TEST_F(PairFretting, SimilarBodiesSlipAndWearAsCattaneosAndMindlins) {
  const auto model = this->model(similar("x = \"2.6e-4 * sin(2*pi*tau)\""));
  Counters counters;
  const State start = model->start(counters);
  const ContactSurface surface = model->contact(start).value();
  constexpr std::size_t force = 8;  // at tau = 0.75, after two phases of place and force
  const Mindlin theory{std::abs(surface.phase_loop[force + 2]) / (Mindlin::f * Mindlin::P)};
  EXPECT_NEAR(theory.ratio, 0.61, 0.01);
  const auto right = of_phase(surface, surface.phase_traction, 0, 0),
             left = of_phase(surface, surface.phase_traction, 2, 0),
             slip = of_phase(surface, surface.phase_slip, 2, 0);
  const auto most = std::ranges::max_element(slip, {}, [](double x) { return std::abs(x); });
  const int slave = surface.body[static_cast<std::size_t>(most - slip.begin())];
  int stuck = 0, slipping = 0;
  double friction = 0, opposite = 0;  // nodes of both have equal distances
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    (surface.body[c] == slave ? friction : opposite) += left[c];
    if (surface.body[c] != slave) continue;
    const double x = surface.initial[c][0], beside = 0.11 * Mindlin::a();
    const bool inside = std::abs(x) < 0.95 * Mindlin::a();
    if (std::abs(std::abs(x) - theory.c()) > beside && inside) {
      EXPECT_NEAR((left[c] - right[c]) / 2, theory.traction(x), 0.02 * Mindlin::p0()) << x;
    }
    if (std::abs(x) < theory.c() - beside) {
      ++stuck;
      EXPECT_NEAR(slip[c], 0, 1e-15) << x;
    } else if (std::abs(x) > theory.c() + beside && inside) {
      ++slipping;
      EXPECT_GT(std::abs(slip[c]), 1e-7) << x;
    }
  }
  EXPECT_NEAR(opposite / friction, -1, 1e-3);
  EXPECT_GE(stuck, 8);
  EXPECT_GE(slipping, 4);
  EXPECT_NEAR(observed(*model, start, "wear_flux") / theory.worn_per_cycle(), 1, 0.02);
  EXPECT_NEAR(observed(*model, start, "stick_area") / (2 * theory.c()), 1, 0.1);
}

/// When what slips carries nothing any more, and sticks as before within c: the pressures are those
/// of the first profile over c and of a flat punch, and both bodies together have lost where they
/// would overlap (2 R) h = a^2 acosh(x/c) - x sqrt(x^2 - c^2).
struct WornLimit {
  double c, area = 0, depth = 0;

  explicit WornLimit(double stick) : c(stick) {
    constexpr double step = 1e-3;
    for (double xi = 1 + step / 2;; xi += step) {
      const double h =
          (std::pow(Mindlin::a(), 2) * std::acosh(xi) - c * c * xi * std::sqrt(xi * xi - 1)) /
          (2 * Mindlin::R);
      if (h < 0) return;
      area += 2 * h * step * c;
      depth = std::max(depth, h);
    }
  }
  /// That which has lost this area.
  static WornLimit of_area(double area) {
    double low = 0.2 * Mindlin::a(), high = Mindlin::a();  // what sticks less wears more
    while (high - low > 1e-9) {
      const double middle = (low + high) / 2;
      (WornLimit(middle).area > area ? low : high) = middle;
    }
    return WornLimit(low);
  }
};

// The width of stick stays that of the start, but for an element at its edge, where the pressures
// of the limit are singular; the area, which this changes much, tends to the limit like h.
TEST_F(PairFretting, SimilarBodiesWearUntilWhatSlipsCarriesNothing) {
  const Mindlin theory{0.6};
  const double Q = theory.ratio * Mindlin::f * Mindlin::P,
               height = 2 + 6 - std::sqrt(36.0 - 4.0);  // where the load acts
  std::string text = similar();
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  };
  replace("motion = [ { body = \"cap\", cycle = { x = \"1e-3 * sin(2*pi*tau)\" } } ]", "");
  replace("directions = [\"x\"] }", "directions = [\"x\"], stiffness = 1e-6 }");
  replace("force = [0.0, -18.5] }",
          fmt::format("force = [0.0, -18.5] }}, {{ on = \"top\", force = [{}, 0.0], cycle = "
                      "\"sin(2*pi*tau)\" }}, {{ on = \"top\", moment = {}, cycle = "
                      "\"sin(2*pi*tau)\" }}",
                      Q, Q * height));
  std::vector<double> areas;
  for (const int half : {16, 32}) {
    folder_.write("two.geo", two_half_planes(half, 14, 1.32));
    const auto model = this->model(text, {"shape.motion=gap", "time.cycles=2e6"});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 2e6);
    EXPECT_LT(observed(*model, run.last(), "wear_flux"),
              1e-3 * observed(*model, run.states.front(), "wear_flux"));
    areas.push_back(observed(*model, run.last(), "worn_volume"));
    const WornLimit limit = WornLimit::of_area(areas.back());
    EXPECT_NEAR(2 * observed(*model, run.last(), "wear_depth") / limit.depth, 1, 0.02);
    EXPECT_LT(limit.c, theory.c());
    EXPECT_GT(limit.c, theory.c() - 0.06 / half);
  }
  EXPECT_NEAR((2 * areas[1] - areas[0]) / WornLimit(theory.c()).area, 1, 0.06);
}

/// A cap that hardly deforms does as the rigid cylinder of a counter-body.
TEST_F(PairFretting, AStiffBodyIsAsACounterBody) {
  const std::string drive = "x = \"4e-4 * sin(2*pi*tau)\"";
  const auto pair = this->model(similar(drive), {"body.1.young_modulus=1e9", "cycle.phases=8"});
  const auto rigid = this->model(R"toml(problem = "worn_body"
mesh.file = "lower.geo"
body = { young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom" } ]
friction = { coefficient = 0.6, stick = true }
wear = { on = ["face"], coefficient = 2.9e-8 }
time.cycles = 1000
[counter_body]
shape = "cylinder"
radius = 6.0
center = [0.0, 6.0]
press = { direction = [0.0, -1.0], force = 18.5 }
[cycle]
period = 1.0
phases = 8
x = "4e-4 * sin(2*pi*tau)"
)toml",
                                 {});
  Counters counters;
  const State one = pair->start(counters), other = rigid->start(counters);
  const double flux = observed(*rigid, other, "wear_flux");
  EXPECT_NEAR(observed(*pair, one, "wear_flux_flat") / flux, 1, 0.01);
  EXPECT_NEAR(observed(*pair, one, "friction_work") / observed(*rigid, other, "friction_work"), 1,
              0.01);
}

TEST_F(PairFretting, LongStrokesTendToGrossSliding) {
  expect_loss_of_first_order([this](double amplitude) {
    const auto model =
        this->model(similar(fmt::format("x = \"{} * (1 - 4 * abs(tau - 0.5))\"", amplitude)),
                    {"cycle.phases=16", "mesh.file=coarse_two.geo"});
    Counters counters;
    return observed(*model, model->start(counters), "wear_flux") /
           (Mindlin::k * Mindlin::P * 4 * amplitude);
  });
}

TEST_F(PairFretting, BlocksSolveAsFactorsOfTheWholeJacobian) {
  std::vector<double> worn;
  for (const char* solver : {"block", "direct"}) {
    const auto model = this->model(similar("x = \"4e-4 * sin(2*pi*tau)\""),
                                   {fmt::format("solver.method={}", solver),
                                    "mesh.file=coarse_two.geo", "wear.coefficient=2.9e-7"});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
    EXPECT_LE(double(run.counters.krylov_iterations), 4.0 * double(run.counters.linear_solves));
  }
  EXPECT_NEAR(worn[0] / worn[1], 1, 1e-5);
}

TEST_F(PairFretting, ASwingingLoadIsWhatFrictionCarries) {
  const auto model = this->model(swinging_pad(), {"cycle.phases=4"});
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  EXPECT_NEAR(std::abs(surface.phase_loop[2]), 1.8, 1e-6);  // at tau = 0.25
  EXPECT_NEAR(surface.phase_loop[2] + surface.phase_loop[4 + 4 + 2], 0, 1e-6);
  EXPECT_THAT(failed_start(swinging_pad(), {"load.2.force=[3.1, 0.0]"}),
              HasSubstr("friction does not balance"));
  expect_refused(swinging_pad(), {"friction.stick=false"}, "expected friction.stick = true");
}

// The loop of force and displacement of a pad that loads alone drive encloses the work of friction.
TEST_F(PairFretting, TheLoopOfASwingingLoadEnclosesTheWorkOfFriction) {
  for (const std::size_t phases : {16u, 64u}) {
    const auto model = this->model(
        swinging_pad(), {"load.2.force=[2.7, 0.0]", fmt::format("cycle.phases={}", phases)});
    Counters counters;
    const State start = model->start(counters);
    const ContactSurface surface = model->contact(start).value();
    EXPECT_NEAR(enclosed_by_loop(surface) / observed(*model, start, "friction_work"), 1,
                0.4 / double(phases));
    const double range =
        std::abs(at_phase(surface, phases / 4 - 1, 0) - at_phase(surface, 3 * phases / 4 - 1, 0));
    EXPECT_NEAR(observed(*model, start, "stroke") / range, 1, 1e-9);
  }
}

// Springs carry what friction does not: the pad slides by (Q - f P) / k to both sides, over more
// facets than it may meet where it is at rest.
TEST_F(PairFretting, ASwingingLoadSlidesThePadAgainstItsSprings) {
  std::string wide = pad_on_base;
  wide.replace(0, wide.find("Line(1)"),
               "Point(1) = {-0.6, -0.5, 0}; Point(2) = {1.8, -0.5, 0};\n"
               "Point(3) = {1.8, 0, 0}; Point(4) = {-0.6, 0, 0};\n");
  wide.replace(wide.find("{1, 3} = 19"), 11, "{1, 3} = 37");
  folder_.write("pad.geo", wide);
  const double k = 9, Q = 4.8, friction = 0.3 * 10, way = (Q - friction) / k;
  const auto model = this->model(
      pad("", fmt::format(", {{ on = \"top\", force = [{}, 0.0], cycle = \"sin(2*pi*tau)\" }}", Q),
          fmt::format(", stiffness = {}", k)),
      {"cycle.phases=32", "shape.motion=gap"});
  Counters counters;
  const State start = model->start(counters);
  ASSERT_TRUE(model->overdue(start));
  const std::optional<Succession> next = model->succeed(start);
  ASSERT_TRUE(next);
  const auto now = [&](const char* name) { return observed(*next->model, next->state, name); };
  EXPECT_NEAR(now("friction_work") / (friction * 4 * way), 1, 1e-3);
  EXPECT_NEAR(now("wear_flux_pad") / (1e-8 * 10 * 4 * way), 1, 1e-3);
}

// The pressures of a phase turn about the centre of the pad as its moment does.
TEST_F(PairFretting, ASwingingMomentMovesThePressures) {
  const auto model = this->model(
      pad("", ", { on = \"top\", moment = 1.0, cycle = \"sin(2*pi*tau)\" }", ", stiffness = 1e-6"),
      {"cycle.phases=4"});
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  const std::size_t count = surface.node.size();
  for (std::size_t p = 0; p < surface.phase_position.size(); ++p) {
    double force = 0, torque = 0;
    for (std::size_t c = 0; c < count; ++c) {
      if (surface.body[c] != 1) continue;  // the pad's, from 0.3 to 1.1
      const double x = surface.initial[c][0] - 0.7, end = std::abs(x) > 0.4 - 1e-9 ? 0.5 : 1,
                   share = end * surface.phase_pressure[p * count + c];
      force += share, torque += share * x;
    }
    const double moment = std::sin(2 * M_PI * surface.phase_position[p]);
    EXPECT_NEAR(torque / force, -moment / 10, 2e-3) << p;
  }
}

// With the mesh that follows the wear, with wear as a gap, and that over a condensed stiffness.
TEST_F(PairFretting, WearAsAGapSticksAlike) {
  struct Ended {
    double worn, stuck;
    std::vector<double> loop;
  };
  const auto run = [&](const Overrides& more) {
    Overrides overrides = {"cycle.phases=4", "wear.coefficient=1e-6"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    const auto model = this->model(swinging_pad(), overrides);
    const State end = run_model(*model, "esdirk-3", 0, 1e-5, 1000).last();
    return Ended{observed(*model, end, "worn_volume"), observed(*model, end, "stick_area"),
                 model->contact(end)->phase_loop};
  };
  const Ended mesh = run({}), gap = run({"shape.motion=gap", "solver.reduce=false"}),
              condensed = run({"shape.motion=gap", "solver.reduce=true"});
  EXPECT_GT(mesh.worn, 0);
  EXPECT_NEAR(gap.worn / mesh.worn, 1, 1e-3);
  EXPECT_EQ(gap.stuck, mesh.stuck);
  EXPECT_NEAR(condensed.worn / gap.worn, 1, 1e-5);
  ASSERT_EQ(condensed.loop.size(), gap.loop.size());
  for (std::size_t k = 0; k < gap.loop.size(); ++k)
    EXPECT_NEAR(condensed.loop[k], gap.loop[k], 1e-4 * 10);
}

/// Its nodes leave the base and come back in every cycle.
TEST_F(PairFretting, AnOverhangingPadWearsByItsPath) {
  const auto model = this->model(
      pad("motion = [ { body = \"pad\", cycle = { x = \"0.2 * sin(2*pi*tau)\" } } ]", "", ""), {});
  Counters counters;
  const State start = model->start(counters);
  const double gross = 1e-8 * 10 * 0.8;
  for (const char* body : {"wear_flux_pad", "wear_flux_base"})
    EXPECT_NEAR(observed(*model, start, body) / gross, 1, 0.015) << body;
  EXPECT_NEAR(observed(*model, start, "friction_work") / (0.3 * 10 * 0.8), 1, 0.015);
  // The nodes at its sides, which are held, rub, too.
  const ContactSurface surface = model->contact(start).value();
  double most = 0;
  for (std::size_t p = 0; p < surface.phase_position.size(); ++p)
    most = std::max(most, std::abs(surface.phase_loop[4 * p + 2]));
  EXPECT_NEAR(most / (0.3 * 10), 1, 1e-4);
}

TEST_F(PairFretting, WhatDoesNotGoTogetherIsRefused) {
  expect_refused(similar(), {"pair.1.friction=0"}, "expected a coefficient above zero");
  expect_refused(similar("x = \"1e-3 * tau\""), {}, "ends where it begins");
  std::string across = similar();
  across.replace(across.find("cycle = {"), 9, "velocity = [0.0, 0.0, 1.0], cycle = {");
  expect_refused(across, {}, "a steady motion does not stick");
  expect_refused(similar(), {"pair.1.stick=false"}, "friction.stick = true follows");
}

TEST_F(PairFretting, JacobianEqualsFiniteDifferences) {
  const auto model =
      this->model(similar(), {"mesh.file=coarse_two.geo", "cycle.phases=3", "time.cycles=1e5",
                              "wear.coefficient=2.9e-7", "friction.factor=\"1+h/1e-4+0.1*x0\""});
  const auto [y, branch] = near_the_start(*model);
  check_jacobian(model->system(), 0, y, 0.2, &branch, 3e-5);
}

/// Sides that supports of both bodies hold along the motion rub, too: they are no symmetry.
TEST_F(PairFretting, WhatBothBodiesHoldRubsWhereTheyMove) {
  std::string text = pad_on_base;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("{0, ", "{0.3, ");
  replace("{1.2, ", "{1.1, ");
  replace("{12, 14};\nPhysical Surface", "{12, 14, 2, 4};\nPhysical Surface");
  folder_.write("pad.geo", text);
  const auto model = this->model(
      pad("motion = [ { body = \"pad\", cycle = { x = \"0.02 * sin(2*pi*tau)\" } } ]", "", ""));
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "friction_force") / (0.3 * 10), 1, 1e-3);
}

/// A node that opens may keep the least number as its multiplier, which is no pressure once divided
/// by an area that is more than one.
TEST_F(PairFretting, TheLeastPressureHasDerivatives) {
  folder_.write("large_pad.geo",
                std::string(pad_on_base) + "Dilate {{0, 0, 0}, 30} { Surface{1, 11}; }\n");
  const auto model = this->model(
      swinging_pad(), {"mesh.file=large_pad.geo", "cycle.phases=3", "load.1.force=[0.0,-3e3]"});
  Counters counters;
  std::vector<double> y = model->start(counters).y;
  const std::vector<double> ydot(y.size());
  const Structure& structure = model->system().structure();
  for (int presses = 0; const int i : unknowns_of(structure, {Role::multiplier}))
    y[i] = ++presses % 3 == 0 ? -4 * std::numeric_limits<double>::denorm_min() : 1.0;
  std::vector<double> J(structure.pattern.row_index.size());
  model->system().jacobian({0, y, ydot}, 1, J);
  EXPECT_TRUE(std::ranges::all_of(J, [](double value) { return std::isfinite(value); }));
}

/// The path begins where hardly anything presses the bodies, and the more so, the same.
TEST_F(PairFretting, StartsFromAVanishingLoad) {
  std::vector<double> work;
  for (const double least : {1e-2, 1e-3, 1e-4}) {
    const auto model = this->model(
        similar(), {"mesh.file=coarse_two.geo", "motion.1.cycle.x=\"0.01*(1-4*abs(tau-0.5))\"",
                    fmt::format("cycle.load=\"max({}, sin(2*pi*tau))\"", least), "cycle.phases=8"});
    Counters counters;
    work.push_back(observed(*model, model->start(counters), "friction_work"));
  }
  EXPECT_NEAR(work[1] / work[0], 1, 0.02);
  EXPECT_NEAR(work[2] / work[1], 1, 0.002);
}

TEST_F(PairFretting, ExplicitMethodsWearAsImplicitOnes) {
  std::vector<double> worn, work;
  for (const char* name : {"esdirk-3", "erk-2"}) {
    const auto model = this->model(
        similar(), {"mesh.file=coarse_two.geo", "cycle.phases=4", "wear.coefficient=2.9e-7",
                    fmt::format("integrator.name={}", name)});
    const ModelRun run = run_model(*model, name, 0, 1e-4, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
    // Of the last state alone: its memory of slip belongs to it.
    work.push_back(observed(*model, run.last(), "friction_work"));
  }
  EXPECT_NEAR(worn[1] / worn[0], 1, 1e-3);
  EXPECT_NEAR(work[1] / work[0], 1, 1e-3);
}

TEST_F(PairFretting, AFactorIsAsAnotherCoefficient) {
  std::vector<double> work;
  for (const auto& set :
       {std::vector<std::string>{"pair.1.friction=0.3"}, {"friction.factor=\"0.5\""}}) {
    std::vector<std::string> all = {"mesh.file=coarse_two.geo", "cycle.phases=4"};
    all.insert(all.end(), set.begin(), set.end());
    const auto model = this->model(similar(), all);
    Counters counters;
    work.push_back(observed(*model, model->start(counters), "friction_work"));
  }
  EXPECT_NEAR(work[1] / work[0], 1, 1e-6);
  expect_refused(similar(), {"friction.factor=\"2\"", "wear.rate=\"1e-8*q\""}, "expected no q");
}

/// A cap that rolls on a block, whose material passes at 1000 mm/s.
std::string rolling_cap(double velocity_of_cap) {
  return fmt::format(R"(problem = "worn_body"
mesh.file = "rail.geo"
body = [ {{ name = "cap", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "flat", young_modulus = 2e5, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["cap", "flat"], friction = 0.3, stick = true }} ]
motion = [ {{ body = "cap", velocity = [{}, 0.0] }}, {{ body = "flat", velocity = [1000.0, 0.0] }} ]
support = [ {{ on = "bottom" }}, {{ on = "ends", directions = ["x"] }},
            {{ on = "sides", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -18.5] }} ]
integrator = {{ name = "esdirk-3", rtol = 1e-3 }}
time.end = 1000
[wear]
on = ["face"]
coefficient = 1e-9
[wear.surfaces.face]
path = 100.0
)",
                     velocity_of_cap);
}

class PairRolling : public PairFretting {
protected:
  void SetUp() override {
    PairFretting::SetUp();
    if (IsSkipped()) return;
    folder_.write("rail.geo", rail(two_half_planes(16, 14, 1.32)));
  }
  /// With a surface from end to end of the block.
  static std::string rail(std::string bodies) {
    const std::string face = "Physical Curve(\"face\") = {4};", round = "Physical Curve(\"round\")";
    bodies.replace(bodies.find(face), face.size(),
                   "Physical Curve(\"face\") = {4, 5, 8}; Physical Curve(\"ends\") = {9, 11};");
    bodies.erase(bodies.find(round), round.size() + 8);
    return bodies;
  }
};

/// Similar bodies: stick of half width b = a - creepage R / f at the leading edge (F. W. Carter).
TEST_F(PairRolling, SimilarBodiesCreepAsCarters) {
  constexpr double f = 0.3, creepage = 5e-4, V = 1000;
  const auto model = this->model(rolling_cap(V * (1 + creepage)), {});
  Counters counters;
  const State start = model->start(counters);
  const double a = Mindlin::a(), b = a - creepage * Mindlin::R / f;
  const double Q = f * Mindlin::P * (1 - b * b / (a * a));
  const double power = observed(*model, start, "friction_power");
  EXPECT_NEAR(observed(*model, start, "stick_area") / (2 * b), 1, 0.05);
  // A tenth of a on blocks of 56 a: -9 %; on 560 a -4.4 %, at a 24th of a -0.07 %.
  EXPECT_NEAR(power / (creepage * Q * V), 1, 0.1);
  EXPECT_NEAR(observed(*model, start, "wear_flux") / (1e-9 * power / f), 1, 1e-6);
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (1e-9 * power / f * 1000), 1, 1e-3);
}

/// Without creepage similar bodies exert no friction on each other.
TEST_F(PairRolling, SimilarBodiesRollFreely) {
  const auto model = this->model(rolling_cap(1000), {});
  Counters counters;
  const State start = model->start(counters);
  const ContactSurface surface = model->contact(start).value();
  // Most at the node that enters: a gap on a slope counts as a shift until it is closed.
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    EXPECT_NEAR(surface.phase_traction[2 * c], 0, 0.07 * 0.3 * Mindlin::p0());
  EXPECT_LT(observed(*model, start, "friction_power"), 1e-3 * 0.3 * Mindlin::P * 0.5);
}

TEST_F(PairRolling, FarBeyondStickItSlides) {
  const auto model = this->model(rolling_cap(1020), {});
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "friction_power") / (0.3 * Mindlin::P * 20),
              1, 0.02);
}

/// The cap, whose surface is curved, is the slave then. Its track is half as long, so that it wears
/// twice as deep.
TEST_F(PairRolling, BothSurfacesWearAlongTheirTracks) {
  std::string bodies = rail(two_half_planes(16, 14, 1.32));
  bodies += "Physical Curve(\"tread\") = {24, 25, 28};\n";
  folder_.write("both.geo", bodies);
  const auto model = this->model(rolling_cap(1020) + "[wear.surfaces.tread]\npath = 50.0\n",
                                 {"mesh.file=both.geo", "wear.on=[\"face\", \"tread\"]"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  const double worn = 1e-9 * Mindlin::P * 20 * 1000;
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cap") / worn, 1, 0.02);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cap") /
                  observed(*model, run.last(), "worn_volume_flat"),
              1, 1e-3);
  const ContactSurface surface = model->contact(run.last()).value();
  EXPECT_NEAR(std::ranges::max(surface.wear_depth) / (worn / 50), 1, 5e-3);
}

/// A force on either body finds the creepage that makes it, and the opposite one its mirror image.
TEST_F(PairRolling, AForceFindsItsCreepage) {
  constexpr double creepage = 5e-4;
  Counters counters;
  const auto given = this->model(rolling_cap(1000 * (1 + creepage)), {});
  const double power = observed(*given, given->start(counters), "friction_power");
  const double force = observed(*given, given->start(counters), "force_support_3_x");
  const auto found = [&](const std::string& body, double of) {
    const auto model =
        this->model(rolling_cap(1000), {fmt::format("motion.{}.force={:.15g}", body, of)});
    const State start = model->start(counters);
    EXPECT_NEAR(std::abs(observed(*model, start, "force_support_3_x") / of), 1, 1e-8);
    return std::pair(observed(*model, start, "creepage_x"),
                     observed(*model, start, "friction_power"));
  };
  const auto [driven, driven_power] = found("1", force);
  EXPECT_NEAR(driven / creepage, 1, 1e-3);  // by the velocity of the one body or of the other
  EXPECT_NEAR(driven_power / power, 1, 1e-3);
  const auto [beside, beside_power] = found("2", -force);
  EXPECT_NEAR(beside / driven, 1, 1e-8);
  EXPECT_NEAR(beside_power / driven_power, 1, 1e-8);
  EXPECT_NEAR(found("1", -force).first / driven, -1, 0.03);
}

/// Half-planes of nu = 0.3, one with ten times the modulus: beta of Dundurs is 0.234. With large
/// friction nearly all sticks, and the softer one rolls freely with 0.644 beta a / R more than the
/// other (tools/validation/unlike_rollers.py; 2 / pi where tractions leave the pressure alone).
/// With 0.3 beta there are three zones of slip, the middle one opposite (R. H. Bentall, K. L.
/// Johnson).
TEST_F(PairRolling, UnlikeBodiesCreepWhereTheyRollFreely) {
  constexpr double beta = 0.2338, modulus = 1 / (0.91 / 2e4 + 0.91 / 2e5);
  const double a = Mindlin::a(), by_R = a / Mindlin::R, P = M_PI * modulus * a * by_R / 4;
  const auto rolls = [&](double creepage, double friction) {
    return this->model(rolling_cap(1000 * (1 + creepage * by_R)),
                       {"body.1.young_modulus=2e4", fmt::format("pair.1.friction={}", friction),
                        fmt::format("load.1.force=[0.0, {:.17g}]", -P)});
  };
  const auto force_on_sides = [](const Model& model, const State& state) {
    return observed(model, state, "force_support_3_x");
  };
  {
    const auto model = this->model(
        rolling_cap(1000), {"body.1.young_modulus=2e4", "pair.1.friction=0.5", "motion.1.force=0",
                            fmt::format("load.1.force=[0.0, {:.17g}]", -P)});
    Counters counters;
    EXPECT_NEAR(observed(*model, model->start(counters), "creepage_x") / by_R / (0.644 * beta), 1,
                0.03);
  }

  // From cold with much friction, where the tangential multiplier may not be too stiff.
  const auto sticky = rolls(0.05, 2);
  Counters of_sticky;
  EXPECT_GT(observed(*sticky, sticky->start(of_sticky), "stick_area"), 1.7 * a);

  constexpr double friction = 0.07, free = 0.1791;  // creepage by a / R, from there
  const auto model = rolls(free, friction);
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(force_on_sides(*model, start) / (friction * P), 0, 0.06);
  const ContactSurface surface = model->contact(start).value();
  const auto slip = of_phase(surface, surface.phase_slip, 0, 0);
  const auto of_zone = [&](double from, double to) {
    double sum = 0;
    for (std::size_t c = 0; c < slip.size(); ++c)
      if (const double x = surface.initial[c][0] / a; x > from && x < to) sum += slip[c];
    return sum;
  };
  const double entering = of_zone(-1, -0.7), middle = of_zone(0.5, 0.75),
               leaving = of_zone(0.92, 1);
  EXPECT_GT(std::abs(middle), 1e-9);
  EXPECT_LT(entering * middle, 0);
  EXPECT_LT(leaving * middle, 0);
  EXPECT_LT(std::abs(of_zone(-0.5, 0.3)), 1e-6 * std::abs(middle));
}

/// With little force nothing slips on a coarse mesh, and nothing wears.
TEST_F(PairRolling, FrictionWithoutThePowerOfWhatDrivesSimilarBodiesIsTold) {
  for (const double young : {2e5, 1e5})
    for (const double force : {0.4, 2.5}) {
      const auto model = this->model(rolling_cap(1000),
                                     {fmt::format("motion.1.force={}", force), "mesh.factor=1.5",
                                      fmt::format("body.1.young_modulus={}", young)});
      Counters counters;
      const State start = model->start(counters);
      const double driving = std::abs(observed(*model, start, "force_support_3_x") *
                                      observed(*model, start, "creepage_x") * 1000),
                   part = observed(*model, start, "friction_power") / driving;
      if (force < 1) EXPECT_LT(part, 0.9);
      const bool similar = young == 2e5;
      const Examination facts = model->examine(start);
      // The force along the contact has a part of the pressures, on slopes.
      EXPECT_NEAR(facts.power_by_driving, similar ? part : 1, 2e-3);
      const std::vector<std::string> found = doubts(facts);
      EXPECT_EQ(std::ranges::count_if(found,
                                      [](const std::string& doubt) {
                                        return doubt.find("times the power of what drives them") !=
                                               std::string::npos;
                                      }),
                similar && std::abs(part - 1) > 0.1);
    }
}

/// A disc of 6 mm radius in its unrolled frame: R^2 falls in proportion to time where the law has
/// the path that is left, and the depth does without.
TEST_F(PairRolling, TheSquareOfTheRadiusFallsSteadily) {
  constexpr double R = 6, depth = 0.6, time = 1000, path = 2 * M_PI * R;
  const double k = depth * path / (Mindlin::P * 20 * time);  // full slip at a creepage of 0.02
  const std::vector<std::pair<std::string, double>> laws = {
      {"k * p * v", depth}, {"k * p * v / (1 - h / 6)", R - std::sqrt(R * R - 2 * R * depth)}};
  for (const auto& [law, expected] : laws) {
    const auto model =
        this->model(rolling_cap(1020), {fmt::format("wear.rate=\"{}\"", law),
                                        fmt::format("wear.coefficient={:.17g}", k),
                                        fmt::format("wear.surfaces.face.path={:.17g}", path)});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, time);
    EXPECT_NEAR(observed(*model, run.last(), "wear_depth") / expected, 1, 3e-3) << law;
    const Examination facts = model->examine(run.last());
    EXPECT_NEAR(facts.worn_radius, expected / R, 3e-3 * expected / R);
    EXPECT_THAT(doubts(facts), Contains(HasSubstr("radius of a roller with this path has worn")));
  }
}

TEST_F(PairRolling, WhatDoesNotGoTogetherIsRefused) {
  std::string text = rolling_cap(1000);
  expect_refused(text, {"motion.1.force=1", "motion.2.force=1"}, "a force on one of the two");
  expect_refused(text, {"motion.1.force_across=1"}, "none in the plane");
  expect_refused(text, {"motion.1.rotation=1", "motion.1.center=[0.0, 0.0]"}, "none in the plane");
  expect_refused(text, {"shape.constraint=multiplier"}, "where bodies roll");
  expect_refused(text, {"pair.1.friction=0"}, "a coefficient above zero where bodies roll");
  expect_refused(text, {"motion.1.velocity=[0.0, 0.0]"}, "by whose velocities they roll");
  text.erase(text.find("[wear.surfaces.face]"));
  expect_refused(text, {}, "expected also wear.surfaces.face.path");
}

/// Two phases, in which both bodies are turned together and the master goes on by `stroke`.
template <int dim>
AssemblyParts<dim> on_a_path(const TwoBodies& pair, double stroke, double turning) {
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
    turn.template topLeftCorner<2, 2>() =
        Eigen::Rotation2Dd(turning * (0.7 + p)).toRotationMatrix();
    phase.places.assign(2, {.turn = turn, .shift = Vector<dim>::Constant(0.3)});
    phase.places[1].shift += p * stroke * turn.col(0);
    parts.phases.push_back(std::move(phase));
  }
  return parts;
}

/// Of a path along which they are turned, beside one without.
template <int dim>
double difference_in_a_turned_frame() {
  const TwoBodies pair = bodies_to_turn<dim>();
  return difference_of_starts<dim>(on_a_path<dim>(pair, 0.02, 0), on_a_path<dim>(pair, 0.02, 1));
}

TEST(PairFrettingInSpace, WhatTurnsTogetherIsAsAtRest) {
  EXPECT_LT(difference_in_a_turned_frame<2>(), 1e-9);
  EXPECT_LT(difference_in_a_turned_frame<3>(), 1e-9);
}

/// The same bodies in steady rolling.
template <int dim>
AssemblyParts<dim> rolling(const TwoBodies& pair) {
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  const Vector<dim> V = Vector<dim>::Unit(0);
  Rolling<dim> rolling{.velocity = V, .creepage_scale = 0.01};
  rolling.force.front() = 0.01;
  if constexpr (dim == 3) rolling.spin = spin_about(Vector<3>::UnitZ(), 0.02);
  parts.interface.rolling = rolling;
  parts.pairs.front().velocities = {V, 1.01 * V};
  for (Surface<dim>& surface : parts.interface.surfaces) {
    surface.track = Track<dim>{{V}, 100};
    for (const auto& facet : surface.facets)  // lines recede as a whole
      for (const int node : facet) {
        parts.shape.held.row(node).setOnes();
        parts.shape.held(node, dim - 1) = 0;
      }
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
    EXPECT_GE(std::ranges::count(branch, 0), 4);
    check_jacobian(model.system(), 0, y, 0.2, &branch, 1e-6);
  };
  check(WearModel<2>(on_a_path<2>(pair, 0.1, 1)));
  check(WearModel<2>(rolling<2>(pair)));
  pair.upper.along = 2, pair.upper.high = pair.lower.high = 1, pair.upper.across = 2;
  pair.lower.along = 3, pair.lower.across = 1;
  check(WearModel<3>(on_a_path<3>(pair, 0.1, 1)));
  check(WearModel<3>(rolling<3>(pair)));
}

}  // namespace
}  // namespace gnomon::pair_stick_test
