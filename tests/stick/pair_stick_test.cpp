// Friction that may stick between two bodies: derivatives, frames, similar bodies, limits.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/checks/checks.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <limits>

#include "stick/two_half_planes.hpp"
#include "support/fretting_loop.hpp"
#include "support/problem_run.hpp"
#include "support/rough_state.hpp"
#include "support/turned_bodies.hpp"

namespace gnomon::pair_stick_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

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
  // Elements that are flat where the bodies touch: a square one yields otherwise to friction than
  // to pressure, and its edge of stick hands on. That of theory is at 0.65 of an element.
  std::vector<double> areas;
  for (const int half : {16, 32}) {
    const double element = theory.c() / (half == 16 ? 6.65 : 12.65);
    folder_.write("two.geo", two_half_planes(half, 14, 1.32, half * element, 0.2));
    const auto model = this->model(text, {"shape.motion=gap", "time.cycles=2e6"});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 2e6);
    EXPECT_LT(observed(*model, run.last(), "wear_flux"),
              1e-3 * observed(*model, run.states.front(), "wear_flux"));
    areas.push_back(observed(*model, run.last(), "worn_volume"));
    const WornLimit limit = WornLimit::of_area(areas.back());
    EXPECT_NEAR(2 * observed(*model, run.last(), "wear_depth") / limit.depth, 1, 0.02);
    EXPECT_LT(limit.c, theory.c());
    EXPECT_GT(limit.c, theory.c() - element);
    EXPECT_NEAR(observed(*model, run.last(), "stick_area"), 2 * theory.c(), element);
  }
  EXPECT_LT(areas[1] / WornLimit(theory.c()).area, 1.25);
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
  const auto beyond = this->model(swinging_pad(), {"load.2.force=[3.1, 0.0]"});
  try {
    beyond->start(counters);
    FAIL() << "friction holds it";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("tau = 0.25: loads of 3.1 along the contact are more than friction "
                          "holds, f P = 3"));
  }
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

/// The flank of a blade root, at 45 degrees, is pulled until all slips: N = sqrt(2) F / (1 + f) and
/// T = f N, for 42 N.
TEST_F(PairFretting, FrictionOfAnInclinedFlankIsAlongIt) {
  constexpr double f = 0.1, F = 42;
  const auto model = make_model(load_scene(
      shipped("dovetail.toml"),
      {"pair.1.friction=0.1", "load.1.force=[0.0,30.0]", "cycle.phases=4", "mesh.factor=2"},
      key_table));
  Counters counters;
  EXPECT_NEAR(
      observed(*model, model->start(counters), "friction_force") / (f * std::sqrt(2) * F / (1 + f)),
      1, 0.015);
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

/// The cap carries the tractions, and friction reads its depth.
TEST_F(PairFretting, AFactorByTheDepthOfWhatDoesNotWearIsTold) {
  for (const std::string worn : {"face", "round"}) {
    const auto model = this->model(
        similar(), {"mesh.file=coarse_two.geo", "wear.on=" + worn, "friction.factor=\"1 + h\""});
    const auto told = Contains(HasSubstr("no effect by h between \"cap\" and \"flat\""));
    if (worn == "face")
      EXPECT_THAT(model->remarks, told);
    else
      EXPECT_THAT(model->remarks, Not(told));
  }
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

TEST(PairFrettingInSpace, PhasesNeedNoCyclesOfBodies) {
  constexpr double stroke = 0.02;
  const TwoBodies pair = bodies_to_turn<3>();
  const WearModel<3> model(on_a_path<3>(pair, stroke, 1));
  Counters counters;
  EXPECT_NEAR(observed(model, model.start(counters), "stroke"), stroke, 1e-12);
}

/// The same bodies in steady rolling.
template <int dim>
AssemblyParts<dim> rolling(const TwoBodies& pair, std::optional<double> moment = {}) {
  AssemblyParts<dim> parts = two_bodies<dim>(pair);
  const Vector<dim> V = Vector<dim>::Unit(0);
  Rolling<dim> rolling{.velocity = V, .creepage_scale = 0.01};
  rolling.force.front() = 0.01;
  if constexpr (dim == 3) {
    (moment ? rolling.turn : rolling.spin) = spin_about(Vector<3>::UnitZ(), moment ? 1 : 0.02);
    rolling.moment = moment;
  }
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

/// With a law that reads the mean over the contact, in which nodes count by a share.
template <int dim>
AssemblyParts<dim> rolling_with_mean(const TwoBodies& pair) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  AssemblyParts<dim> parts = rolling<dim>(pair);
  parts.scales.stress = 4e3;
  for (Surface<dim>& surface : parts.interface.surfaces)
    surface.wear = expression_wear_law(
        Expression("1e-3 * (p * v + q_mean * (1 + h)) * (1 + q_mean / 100)^2", names), 100, 1);
  return parts;
}

TEST(PairFrettingInSpace, JacobianEqualsFiniteDifferences) {
  TwoBodies pair{.upper = {.along = 5, .high = 2, .wear = 1e-3},
                 .lower = {.along = 7, .high = 2, .from = 0.1, .wear = 2e-3},
                 .friction = 0.3};
  const auto check = [](const auto& model, double closed = -2000) {
    std::vector<double> y = rough_state(model, {.closed = closed, .every = 3});
    const ActiveSet branch = active_set(model.system(), 0, y);
    EXPECT_GT(std::ranges::count(branch, 1), 4);
    EXPECT_GE(std::ranges::count(branch, 0), 3);
    check_jacobian(model.system(), 0, y, 0.2, &branch, 1e-6);
  };
  check(WearModel<2>(on_a_path<2>(pair, 0.1, 1)));
  check(WearModel<2>(rolling<2>(pair)));
  pair.upper.along = 2, pair.upper.high = pair.lower.high = 1, pair.upper.across = 2;
  pair.lower.along = 3, pair.lower.across = 1;
  check(WearModel<3>(on_a_path<3>(pair, 0.1, 1)));
  check(WearModel<3>(rolling<3>(pair)));
  check(WearModel<3>(rolling<3>(pair, 0.02)));
  check(WearModel<3>(rolling_with_mean<3>(pair)), -200);
}

}  // namespace
}  // namespace gnomon::pair_stick_test
