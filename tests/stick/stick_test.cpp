// Friction that may stick: springs, Cattaneo and Mindlin, limits, derivatives and solvers.
#include <gnomon/checks/checks.hpp>

#include "stick/stick_scenes.hpp"

namespace gnomon::stick_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

/// A stiff body on springs kt per area slides by U - f p / kt of an amplitude U: 4 k p N of it
/// wears off in N cycles.
TEST_F(Fretting, SpringsWearByTheSlipThatIsLeft) {
  const auto model = this->model(bed());
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1e6);
  const double slip = 0.01 - 0.5 * 20 / 1e4;
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (4e-9 * 20 * slip * 1e6), 1, 1e-5);
}

/// f0 (1 + h / h0) lets less and less of the amplitude slip: dh/dN = a - b h.
TEST_F(Fretting, FrictionGrowsWithDepth) {
  const auto model = this->model(bed(), {"friction.coefficient=0.05", "support.1.stiffness=1e3",
                                         "friction.factor=\"1 + h/4e-5\""});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1e6);
  const double a = 4e-9 * 20 * 0.009, b = 4e-9 * 20 * 1e-3 / 4e-5;
  const double depth = a / b * (1 - std::exp(-b * 1e6));
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / depth, 1, 1e-4);
}

/// s is solved for in each stage, and the shape keeps its order in time.
TEST_F(Fretting, ExplicitMethodsKeepTheirOrder) {
  for (const auto& [name, order] :
       {std::pair{"forward-euler", 1.0}, std::pair{"erk-2", 2.0}, std::pair{"erk-3", 3.0}}) {
    const auto model = this->model(cylinder(), {"mesh.file=coarse.geo", "wear.coefficient=2.9e-7",
                                                fmt::format("integrator.name={}", name)});
    std::vector<double> worn;
    for (const double step : {400, 200, 100}) {
      const ModelRun run = run_model(*model, name, step, 0, 2000);
      worn.push_back(observed(*model, run.last(), "worn_volume"));
    }
    EXPECT_NEAR(std::log2((worn[0] - worn[1]) / (worn[1] - worn[2])), order, 0.25) << name;
  }
}

/// Slip of unlike bodies depends on the first loading, that of similar ones does not.
TEST_F(Fretting, TheFirstLoadingMattersForUnlikeBodies) {
  const auto work = [this](double nu, const std::vector<std::string>& loading) {
    std::vector<std::string> set = {"counter_body.press.2.cycle=\"cos(2*pi*tau)\""};
    set.insert(set.end(), loading.begin(), loading.end());
    const auto model = this->model(cylinder("", nu), set);
    Counters counters;
    return observed(*model, model->start(counters), "friction_work");
  };
  const std::vector<std::string> oblique = {"cycle.loading.press=[1.0]",
                                            "cycle.loading.others=[1.0]"};
  EXPECT_GT(std::abs(work(0.2, oblique) / work(0.2, {}) - 1), 0.01);
  EXPECT_NEAR(work(0.4999, oblique) / work(0.4999, {}), 1, 1e-3);
  expect_refused(cylinder(), {"cycle.loading.press=[1.0]"}, "expected also");
  expect_refused(cylinder(), {"cycle.loading.press=[1.0, 0.9]", "cycle.loading.others=[0.0, 1.0]"},
                 "the last 1");
}

/// What sticks throughout the cycle keeps its place, what slips follows.
TEST_F(Fretting, ExplicitMethodsWearAsImplicitOnes) {
  std::vector<double> worn, area;
  for (const char* name : {"esdirk-3", "erk-2"}) {
    const auto model = this->model(cylinder(), {"mesh.file=coarse.geo", "wear.coefficient=2.9e-7",
                                                fmt::format("integrator.name={}", name)});
    const ModelRun run = run_model(*model, name, 0, 1e-4, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
    area.push_back(observed(*model, run.last(), "stick_area"));
    EXPECT_GT(area.back(), 0);
  }
  EXPECT_NEAR(worn[1] / worn[0], 1, 1e-3);
  EXPECT_NEAR(area[1] / area[0], 1, 1e-9);
}

TEST_F(Fretting, FrictionChangesWithTimeAndPlace) {
  const auto worn = [this](const std::string& factor) {
    const auto model = this->model(bed(), {"friction.factor=\"" + factor + "\""});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1e6);
    return observed(*model, run.last(), "worn_volume") / (4e-9 * 20 * 1e6);
  };
  EXPECT_NEAR(worn("if(t < 3e5, 1, 4)") / (0.3 * 0.009 + 0.7 * 0.006), 1, 1e-4);
  EXPECT_NEAR(worn("1 + x0") / (0.01 - 1.5 * 0.001), 1, 1e-3);
}

TEST_F(Fretting, NothingWearsBelowIncipientSliding) {
  const auto model = this->model(bed("x = \"0.0008 * sin(2*pi*tau)\""));
  const ModelRun run = run_model(*model, "bdf", 0, 1e-4, 1e6);
  EXPECT_LT(std::abs(observed(*model, run.last(), "worn_volume")), 1e-15);
  EXPECT_EQ(model->examine(run.last()).slip_zone, 0);  // rounding does not slip
}

/// A rotation slips by the arcs of the surface.
TEST_F(Fretting, ARotationSlipsAsItsArcs) {
  const auto model =
      this->model(bed("rotation = \"1e-3 * sin(2*pi*tau)\""),
                  {"counter_body.motion.center=[0.0, 10.1]", "body.young_modulus=1e7"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1e6);
  // The block turns with the plane, about its springs 0.1 mm below.
  const double slip = 0.01 + 1e-3 * 0.1 - 0.5 * 20 / 1e4;
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (4e-9 * 20 * slip * 1e6), 1, 1e-3);
}

/// A cylinder that swings by a radian about its axis slides by the arcs, whatever the phases are.
TEST_F(Fretting, ASwingingCylinderWearsByItsArcs) {
  for (const char* phases : {"4", "12"}) {
    const auto model = this->model(cylinder("rotation = \"sin(2*pi*tau)\"", 0.3),
                                   {fmt::format("cycle.phases={}", phases)});
    Counters counters;
    const double gross = Cattaneo::k * Cattaneo::P * 4 * Cattaneo::R;
    EXPECT_NEAR(observed(*model, model->start(counters), "wear_flux") / gross, 1, 2e-3) << phases;
  }
}

/// A half with its plane of symmetry held is as the whole, by either solver.
TEST_F(Fretting, HeldDirectionsCarryNoTraction) {
  folder_.write("half.geo", half_block);
  const std::string text = R"toml(problem = "worn_body"
mesh.file = "half.geo"
body = { young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom" }, { on = "symmetry", directions = ["y"] } ]
friction = { coefficient = 0.6, stick = true }
wear = { on = ["surface"], coefficient = 2.9e-8 }
time.cycles = 1000
integrator = { name = "esdirk-3", rtol = 1e-3 }
cycle = { period = 1.0, phases = 4, x = "5e-4 * sin(2*pi*tau)" }
[counter_body]
shape = "ball"
radius = 5.0
center = [0.0, 0.0, 5.0]
press = { direction = [0.0, 0.0, -1.0], force = 25.0 }
)toml";
  std::vector<double> flux;
  for (const char* solver : {"block", "direct"}) {
    const auto model = this->model(text, {fmt::format("solver.method={}", solver)});
    Counters counters;
    flux.push_back(observed(*model, model->start(counters), "wear_flux"));
  }
  EXPECT_GT(flux[0], 0);
  EXPECT_NEAR(flux[1] / flux[0], 1, 1e-8);
}

/// The force of friction over the place of the counter-body is a parallelogram: f P slides by twice
/// the slip that is left, there and back.
TEST_F(Fretting, TheLoopHoldsTheWorkOfFriction) {
  // Phases at all corners of the loop: it slips again after two of them.
  const auto model =
      this->model(bed("x = \"0.01 * (1 - 4 * abs(tau - 0.5))\""), {"cycle.phases=20"});
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "stroke"), 0.02, 1e-12);
  EXPECT_NEAR(observed(*model, start, "friction_force"), 10, 1e-8);
  const ContactSurface surface = model->contact(start).value();
  double work = 0, most = 0;
  const std::size_t phases = surface.phase_position.size();
  ASSERT_EQ(surface.phase_loop.size(), 4 * phases);
  for (std::size_t p = 0; p < phases; ++p) {
    const double* at = &surface.phase_loop[4 * p];
    const double* before = &surface.phase_loop[4 * ((p + phases - 1) % phases)];
    work += (at[0] - before[0]) * (at[2] + before[2]) / 2;
    most = std::max(most, std::abs(at[2]));
    EXPECT_NEAR(at[3], -20, 1e-8);
  }
  EXPECT_NEAR(most, 10, 1e-8);
  EXPECT_NEAR(work / (4 * 10 * (0.01 - 1e-3)), 1, 1e-4);
}

TEST_F(Fretting, CattaneosTractionsOnAHalfPlane) {
  const auto model = this->model(cylinder());
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  ASSERT_EQ(surface.phase_position.size(), 4u);
  const auto right = of_phase(surface, surface.phase_traction, 0, 0),
             left = of_phase(surface, surface.phase_traction, 2, 0),
             slip = of_phase(surface, surface.phase_slip, 2, 0);
  EXPECT_NEAR(surface.phase_loop[2], Cattaneo::ratio * Cattaneo::f * Cattaneo::P, 1e-8);
  EXPECT_NEAR(observed(*model, model->start(counters), "friction_force"),
              Cattaneo::ratio * Cattaneo::f * Cattaneo::P, 1e-8);
  int stuck = 0, slipping = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double x = surface.initial[c][0], beside = 0.1 * Cattaneo::a();
    // What the first loading has locked in is the same in both, and falls out.
    const bool inside = std::abs(x) < 0.95 * Cattaneo::a();
    if (std::abs(std::abs(x) - Cattaneo::c()) > beside && inside) {
      EXPECT_NEAR((right[c] - left[c]) / 2, Cattaneo::traction(x), 0.04 * Cattaneo::p0()) << x;
    }
    if (std::abs(x) < Cattaneo::c() - beside) {
      ++stuck;
      EXPECT_NEAR(slip[c], 0, 1e-15) << x;
    } else if (std::abs(x) > Cattaneo::c() + beside && inside) {
      ++slipping;
      EXPECT_GT(std::abs(slip[c]), 1e-7) << x;
    }
  }
  EXPECT_GT(stuck, 8);
  EXPECT_GT(slipping, 4);
  EXPECT_NEAR(observed(*model, model->start(counters), "wear_flux") / Cattaneo::worn_per_cycle(), 1,
              0.05);
}

TEST_F(Fretting, LongStrokesTendToGrossSliding) {
  expect_loss_of_first_order([this](double amplitude) {
    const std::string drive =
        fmt::format("x = \"{} * (1 - 4 * abs(tau - 0.5))\"\nphases = 8", amplitude);
    std::string text = cylinder(drive, 0.3);
    text.erase(text.find("phases = 4\n"), 11);
    const auto model = this->model(text);
    Counters counters;
    return observed(*model, model->start(counters), "wear_flux") /
           (Cattaneo::k * Cattaneo::P * 4 * amplitude);
  });
}

TEST_F(Fretting, JacobianEqualsFiniteDifferences) {
  std::string moving = cylinder("x = \"1e-4 * sin(2*pi*tau)\"\nforce = \"20 + 5*cos(2*pi*tau)\"");
  moving.erase(moving.find("force = 18.5\n"), 13);
  moving.replace(moving.find("[[counter_body.press]]"), 22, "[counter_body.press]");
  const std::string factor = "friction.factor=\"1 + h/1e-4 + x0\"",
                    turning = cylinder(
                        "x = \"1e-4 * sin(2*pi*tau)\"\nrotation = \"0.6 + 2e-5 * cos(2*pi*tau)\"");
  for (const auto& [text, more] :
       {std::pair{cylinder(), factor}, std::pair{moving, std::string("integrator.name=erk-2")},
        std::pair{turning, std::string("integrator.name=esdirk-3")}}) {
    const auto model =
        this->model(text, {"mesh.file=coarse.geo", "cycle.phases=3", "time.cycles=1e6",
                           "wear.coefficient=2.9e-6", "wear.normal=averaged", more});
    const auto [y, branch] = near_the_start(*model);
    check_jacobian(model->system(), 0, y, 0.2, &branch, 1e-4);
    for (const AlgebraicStage& stage : model->system().algebraic_stages()) {
      stage.freeze(0, y);
      std::vector<double> part;
      for (const int unknown : stage.unknowns) part.push_back(y[unknown]);
      const ActiveSet own = active_set(*stage.system, 0, part);
      check_jacobian(*stage.system, 0, part, 0, &own, 1e-4);
    }
  }
}

/// Far beyond stick a cylinder slips by 4 theta R in a cycle, wherever it comes from.
TEST_F(Fretting, ACylinderThatTurnsSlipsByItsArc) {
  for (const double gap : {0.0, 1.0}) {
    const auto model = this->model(cylinder("rotation = \"0.6 * sin(2*pi*tau)\"", 0.3),
                                   {"friction.coefficient=0.3", "wear.coefficient=1e-14",
                                    fmt::format("contact.initial_gap={}", gap)});
    Counters counters;
    const State start = model->start(counters);
    const double slip = 4 * 0.6 * Cattaneo::R;
    EXPECT_NEAR(observed(*model, start, "friction_work") / (0.3 * Cattaneo::P * slip), 1, 0.01);
    EXPECT_NEAR(observed(*model, start, "slip_path") / slip, 1, 0.01);
  }
}

/// A flat that moves on a circle of 0.5 mm, and turns by the same angle, turns about the origin.
TEST_F(Fretting, TheCentreOfARotationMovesWithTheCounterBody) {
  folder_.write("square.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-1, -1, -1, 2, 2, 1};
Transfinite Curve "*" = 9; Transfinite Curve {1, 3, 5, 7} = 3;
Transfinite Surface "*"; Transfinite Volume {1}; Recombine Surface "*";
Physical Surface("bottom") = {5}; Physical Surface("surface") = {6}; Physical Volume("block") = {1};
)");
  const auto model = this->model(R"toml(problem = "worn_body"
mesh.file = "square.geo"
body = { young_modulus = 1e5, poisson_ratio = 0.0, material = "linear" }
support = [ { on = "bottom" } ]
friction = { coefficient = 0.3, stick = true }
wear = { on = ["surface"], coefficient = 1e-8 }
shape.motion = "gap"
time.cycles = 1
[cycle]
period = 1.0
phases = 16
x = "0.5*cos(1.5*sin(2*pi*tau))"
y = "0.5*sin(1.5*sin(2*pi*tau))"
rotation = "1.5*sin(2*pi*tau)"
[counter_body]
shape = "plane"
center = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, -1.0]
motion = { axis = [0.0, 0.0, 1.0], center = [0.0, 0.0, 0.0] }
press = { direction = [0.0, 0.0, -1.0], force = 40.0 }
)toml");
  Counters counters;
  const State start = model->start(counters);
  const double mean_distance = (std::sqrt(2.0) + std::asinh(1.0)) / 3;  // of a square of 2 x 2
  EXPECT_NEAR(observed(*model, start, "friction_work") / (0.3 * 40 * 6 * mean_distance), 1, 0.03);
}

TEST_F(Fretting, ACycleOfFewPhasesDoesNotTurnTooFar) {
  expect_refused(cylinder("rotation = \"4 * sin(2*pi*tau)\"", 0.3), {"cycle.phases=4"},
                 "cycle.rotation turns by");
}

/// A stiff square block between springs of stiffness k per area and a plane that a moment M turns
/// by M / (k I): I = 1 / 6 of the unit square, times 1 + 2 h^2 of springs at nodes. All slips at M
/// = 0.38 f P.
TEST_F(Fretting, AMomentTurnsTheCounterBody) {
  folder_.write("square.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-0.5, -0.5, -0.2, 1, 1, 0.2};
Transfinite Curve "*" = 2; Transfinite Curve {2, 4, 6, 8, 9, 10, 11, 12} = 6;
Transfinite Surface "*"; Transfinite Volume {1}; Recombine Surface "*";
Physical Surface("bottom") = {5}; Physical Surface("surface") = {6}; Physical Volume("block") = {1};
)");
  const std::string text = R"toml(problem = "worn_body"
mesh.file = "square.geo"
body = { young_modulus = 1e9, poisson_ratio = 0.0, material = "linear" }
support = [ { on = "bottom", stiffness = 1e3 } ]
friction = { coefficient = 0.5, stick = true }
wear = { on = ["surface"], coefficient = 1e-8 }
time.cycles = 1000
cycle = { period = 1.0, phases = 4 }
[counter_body]
shape = "plane"
center = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, -1.0]
[[counter_body.press]]
direction = [0.0, 0.0, -1.0]
force = 100.0
[[counter_body.press]]
moment = 5.0
center = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
cycle = "sin(2*pi*tau)"
)toml";
  Counters counters;
  const auto model = this->model(text);
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "twist") / (2 * 5.0 * 6 / 1e3 / (1 + 2 * 0.2 * 0.2)), 1,
              1e-5);
  EXPECT_NEAR(observed(*model, start, "friction_moment"), 5, 1e-8);
  EXPECT_TRUE(std::ranges::any_of(doubts(model->examine(start)), [](const std::string& doubt) {
    return doubt.find("of first order in") != std::string::npos;
  }));
  const ContactSurface surface = model->contact(start).value();
  ASSERT_EQ(surface.phase_turn.size(), 2 * surface.phase_position.size());
  EXPECT_NEAR(surface.phase_turn[1], 5, 1e-8);
  const auto soft = this->model(text, {"body.young_modulus=1e5", "support.1.stiffness=1e8",
                                       "wear.coefficient=1e-5", "counter_body.press.2.moment=15"});
  std::vector<double> y = soft->start(counters).y;
  const ActiveSet branch = active_set(soft->system(), 0, y);
  for (std::size_t i = 0; i < y.size(); ++i)  // away from nodes that do not slip
    y[i] += 0.1 * soft->system().structure().unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
  check_jacobian(soft->system(), 0, y, 0.2, &branch, 1e-3);
  const auto more = this->model(text, {"counter_body.press.2.moment=20"});
  EXPECT_THROW((void)more->start(counters), SolutionError);
}

TEST_F(Fretting, BlocksSolveAsFactorsOfTheWholeJacobian) {
  std::vector<double> worn;
  for (const char* solver : {"block", "direct"}) {
    const auto model =
        this->model(cylinder("x = \"0.002 * sin(2*pi*tau)\"", 0.3),
                    {fmt::format("solver.method={}", solver), "mesh.file=coarse.geo"});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
    // The rows of contact are inverted exactly.
    EXPECT_LE(double(run.counters.krylov_iterations), 3.0 * double(run.counters.linear_solves));
  }
  EXPECT_NEAR(worn[0] / worn[1], 1, 1e-5);
}

TEST_F(Fretting, WearAsAGapWearsTheSame) {
  std::vector<double> worn;
  for (const char* motion : {"mesh", "gap"}) {
    const auto model = this->model(cylinder(), {fmt::format("shape.motion={}", motion)});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
    worn.push_back(observed(*model, run.last(), "worn_volume"));
  }
  EXPECT_NEAR(worn[0] / worn[1], 1, 1e-3);
}

TEST_F(Fretting, TheErrorOfThePhasesIsThatOfHalvedOnes) {
  const std::string drive = "x = \"0.002 * sin(2*pi*tau)\"";
  std::vector<double> flux, error;
  for (const char* phases : {"8", "16"}) {
    const auto model = this->model(cylinder(drive, 0.3), {fmt::format("cycle.phases={}", phases)});
    Counters counters;
    const State start = model->start(counters);
    flux.push_back(observed(*model, start, "wear_flux"));
    error.push_back(model->phase_error(start).value().error);
  }
  EXPECT_GT(error[0], 0.5 * std::abs(flux[0] / flux[1] - 1));
  EXPECT_LT(error[1], 0.5 * error[0]);
  EXPECT_LT(error[0], 0.05);
}

/// Halved phases end their first cycle with other places than it began with.
TEST_F(Fretting, TheErrorOfThePhasesIsThatOfAClosedCycle) {
  std::string text = bed("x = \"0.02 * sin(2*pi*tau)\"\ny = \"-0.015 * cos(2*pi*tau)\"");
  for (const auto& [from, to] :
       {std::pair{"{ on = \"bottom\", stiffness = 1e4 }",
                  "{ on = \"bottom\", directions = [\"x\"], stiffness = 400.0 }, "
                  "{ on = \"bottom\", directions = [\"y\"], stiffness = 1e3 }"},
        {"force = 20.0", "approach = 0.01"},  // which lets go in a part of the cycle
        {"1e9", "1e5"}})
    text.replace(text.find(from), std::string(from).size(), to);
  std::vector<double> flux, error;
  for (const char* phases : {"32", "64"}) {
    const auto model = this->model(text, {fmt::format("cycle.phases={}", phases)});
    Counters counters;
    const State start = model->start(counters);
    flux.push_back(observed(*model, start, "wear_flux"));
    error.push_back(model->phase_error(start).value().error);
  }
  EXPECT_GT(std::abs(flux[0] / flux[1] - 1), 0.01);
  EXPECT_NEAR(error[0] / std::abs(flux[0] / flux[1] - 1), 1, 0.1);
}

TEST_F(Fretting, PhasesAreChosenByTheirError) {
  const auto model = this->model(cylinder("x = \"0.002 * sin(2*pi*tau)\"", 0.3),
                                 {"cycle.phases=auto", "integrator.rtol=4e-3"});
  Counters counters;
  EXPECT_LE(model->phase_error(model->start(counters)).value().error, 4e-3);
  EXPECT_GT(model->phases, 4);
  EXPECT_LE(model->phases, 64);
}

TEST_F(Fretting, AForceThatFrictionDoesNotBalanceIsRefused) {
  const std::string reason = failed_start(cylinder(), {"counter_body.press.2.force=13.0"});
  EXPECT_THAT(reason, HasSubstr("friction does not balance"));
  EXPECT_THAT(reason, HasSubstr("only just balances one it may not be found"));
  EXPECT_THAT(reason, HasSubstr("tau = 0.25"));
}

// Cattaneo::ratio of the force along the surface needs as much of the normal force.
TEST_F(Fretting, ANormalForceThatBecomesTooSmallIsTold) {
  const Overrides history = {"counter_body.press.1.times=[0.0, 500.0, 1000.0]",
                             "counter_body.press.1.factors=[1.0, 0.5, 1.0]"};
  EXPECT_THAT(model(cylinder(), history)->remarks,
              Contains(HasSubstr("at t = 400 s and tau = 0.25 the force along the surface")));
  EXPECT_THAT(model(cylinder())->remarks, Not(Contains(HasSubstr("force along the surface"))));
  const Overrides jump = {"counter_body.press.1.times=[0.0, 500.0, 500.0]",
                          "counter_body.press.1.factors=[1.0, 0.5, 1.0]"};
  EXPECT_THAT(model(cylinder(), jump)->remarks, Contains(HasSubstr("at t = 400 s and tau = 0.25")));
}

/// How many elements slip beside what sticks, with this part of the force that friction holds.
class SlipZone : public Fretting {
protected:
  std::optional<int> width(double part) {
    const auto model = this->model(cylinder(), {fmt::format("counter_body.press.2.force={}",
                                                            part * Cattaneo::f * Cattaneo::P)});
    Counters counters;
    return model->examine(model->start(counters)).slip_zone;
  }
  static double elements(double part) {
    constexpr double element = 0.045 / 18;
    return Cattaneo::a() * (1 - std::sqrt(1 - part)) / element;
  }
};

TEST_F(SlipZone, IsThatOfCattaneo) {
  EXPECT_NEAR(width(0.6).value(), elements(0.6), 1);
  EXPECT_NEAR(width(0.9).value(), elements(0.9), 1);
}

TEST_F(SlipZone, NarrowerThanElementsIsTold) {
  ASSERT_LT(elements(0.01), 0.1);
  EXPECT_EQ(width(0.01), 0);
  EXPECT_EQ(width(1e-5), std::nullopt);  // nothing drives it
  Examination facts{.slip_zone = 0};
  EXPECT_THAT(doubts(facts), Contains(HasSubstr("no contact node slips")));
  facts.slip_zone = 2;
  EXPECT_THAT(doubts(facts), Contains(HasSubstr("is 2 elements wide")));
  facts.slip_zone = 3;
  EXPECT_THAT(doubts(facts), Not(Contains(HasSubstr("wide"))));
}

/// Of a stick that shrinks, the part of what stuck or of what slipped that begins to slip.
TEST_F(SlipZone, ThatGrowsIsTold) {
  const Examination start{.stick_area = 1, .slip_area = 0.2};
  for (const double end : {0.94, 0.98, 0.995}) {
    const auto found = doubts(start, Examination{.stick_area = end, .slip_area = 1.2 - end});
    const bool is_told = std::ranges::any_of(found, [](const std::string& text) {
      return text.find("has shrunk") != std::string::npos;
    });
    EXPECT_EQ(is_told, end < 0.99) << end;
  }
}

/// Rounding errors of slip are no wear that steps must follow.
TEST_F(Fretting, WhatHardlyMovesTakesNoStepsAndIsTold) {
  const auto model =
      this->model(cylinder("x = \"8e-10 * sin(2*pi*tau)\""),
                  {"friction.coefficient=0.01", "time.cycles=1", "mesh.file=coarse.geo"});
  Counters counters;
  EXPECT_THAT(doubts(model->examine(model->start(counters))),
              Contains(HasSubstr("expected a longer motion or a larger force")));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1);
  EXPECT_LT(run.states.size(), 20);
  EXPECT_LT(observed(*model, run.last(), "worn_volume"), 1e-15);
}

/// A load that goes round presses a shaft on one place of a bore after the other: the way is that
/// of its centre, a polygon around the clearance.
TEST_F(Fretting, ALoadMayGoRound) {
  folder_.write("bush.geo", R"(r = 10.05; s = 14;
Point(1) = {0, 0, 0};
For i In {0:3}
  Point(10+i) = {r * Cos(i*Pi/2), r * Sin(i*Pi/2), 0};
  Point(20+i) = {s * Cos(i*Pi/2), s * Sin(i*Pi/2), 0};
EndFor
For i In {0:3}
  j = (i + 1) % 4;
  Circle(10+i) = {10+i, 1, 10+j}; Circle(20+i) = {20+i, 1, 20+j}; Line(30+i) = {10+i, 20+i};
EndFor
For i In {0:3}
  Curve Loop(i+1) = {30+i, 20+i, -(30+(i+1)%4), -(10+i)}; Plane Surface(i+1) = {i+1};
EndFor
Transfinite Curve {10:13, 20:23} = 13; Transfinite Curve {30:33} = 4;
Transfinite Surface "*"; Recombine Surface "*";
Physical Curve("bore") = {10:13}; Physical Curve("housing") = {20:23}; Physical Surface("bush") = {1:4};
)");
  const auto model = this->model(R"toml(problem = "worn_body"
mesh.file = "bush.geo"
body = { young_modulus = 3e5, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "housing" } ]
friction = { coefficient = 0.05, stick = true }
wear = { on = ["bore"], coefficient = 1e-8 }
time.cycles = 10
[counter_body]
shape = "cylinder"
radius = 10.0
center = [0.0, 0.0]
[[counter_body.press]]
direction = [0.0, -1.0]
force = 100.0
cycle = "cos(2*pi*tau)"
[[counter_body.press]]
direction = [1.0, 0.0]
force = 100.0
cycle = "sin(2*pi*tau)"
[cycle]
period = 1.0
phases = 16
)toml",
                                 {});
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 100, 1);
  const double way = 16 * 2 * std::sin(M_PI / 16) * 0.05;
  EXPECT_NEAR(observed(*model, start, "friction_work") / (0.05 * 100 * way), 1, 0.03);
  expect_refused(cylinder(), {"counter_body.press.1.cycle=\"abs(cos(2*pi*tau))\""},
                 "expected forces that press the counter-body on the surface");
}

TEST_F(Fretting, WhatDoesNotGoTogetherIsRefused) {
  expect_refused(bed(), {"integrator.name=theta"}, "expected more than 0.5");
  expect_refused(bed(), {"friction.coefficient=0"}, "expected a coefficient above zero");
  expect_refused(bed(), {"friction.factor=\"1 + p\""}, "got p");
  expect_refused(bed(), {"friction.factor=\"x0 - 0.5\""}, "zero or more");
  expect_refused(bed(), {"friction.factor=\"2\"", "wear.rate=\"k*f*p*v\""}, "expected no f");
  expect_refused(bed(), {"friction.factor=\"2\"", "friction.stick=false"}, "friction.stick");
  expect_refused(bed(), {"cycle.z=\"tau\""}, "stays in the plane");
  expect_refused(bed(), {"cycle.x=\"0.01*tau\""}, "ends where it begins");
  expect_refused(bed("rotation = \"2*pi*tau\""), {"counter_body.motion.center=[0.0, 100.1]"},
                 "not whole turns");
  expect_refused(bed(), {"counter_body.motion.velocity=[1.0, 0.0]"}, "no counter_body.motion");
  std::string steady = bed("");
  steady.erase(steady.find("[cycle]"));
  steady.replace(steady.find("time.cycles = 1e6"), 17, "time.end = 1.0");
  expect_refused(steady, {}, "expected also [cycle]");
  expect_refused(cylinder(), {"counter_body.press.1.cycle=\"sin(\""}, "counter_body.press");
  expect_refused(cylinder(), {"counter_body.press.1.cycle=\"sin(2*pi*tau)\""},
                 "expected forces that press");
  expect_refused(cylinder(), {"friction.stick=false"}, "expected friction.stick = true");
  expect_refused(cylinder(), {"wear.rate=\"k*p*v*exp(-s)\""}, "expected no sliding distance s");
  expect_refused(cylinder(), {"friction.factor=\"1+s\""},
                 "friction.factor: expected no sliding distance s");
}

/// The start loads by what presses, then by the other forces of the begin of the path; the cycle is
/// the same from a quarter later on.
TEST_F(Fretting, APathMayBeginAtItsLargestForce) {
  std::vector<double> flux;
  for (const char* factor : {"sin(2*pi*tau)", "cos(2*pi*tau)"}) {
    const auto model =
        this->model(cylinder(), {fmt::format("counter_body.press.2.cycle=\"{}\"", factor)});
    Counters counters;
    flux.push_back(observed(*model, model->start(counters), "wear_flux"));
  }
  EXPECT_NEAR(flux[1] / flux[0], 1, 1e-3);
}

/// The force that swings may have the larger number, and a small factor.
TEST_F(Fretting, TheSwingingForceIsNotTheOneThatPresses) {
  std::vector<double> work;
  for (const auto& set : {std::vector<std::string>{},
                          {fmt::format("counter_body.press.2.force={}",
                                       100 * Cattaneo::ratio * Cattaneo::f * Cattaneo::P),
                           "counter_body.press.2.cycle=\"0.01*sin(2*pi*tau)\""}}) {
    const auto model = this->model(cylinder(), set);
    Counters counters;
    work.push_back(observed(*model, model->start(counters), "friction_work"));
  }
  EXPECT_NEAR(work[1] / work[0], 1, 1e-6);
}

/// Friction alone holds a plane along itself.
TEST_F(Fretting, APlaneMayBeDrivenByAForce) {
  std::string text = bed("x = \"0\"");
  text.replace(text.find("press = {"), text.find("}\n[cycle]") - text.find("press = {") + 2,
               "[[counter_body.press]]\ndirection = [0.0, -1.0]\nforce = 20.0\n"
               "[[counter_body.press]]\ndirection = [1.0, 0.0]\nforce = 8.0\n"
               "cycle = \"sin(2*pi*tau)\"\n");
  text.erase(text.find("x = \"0\""), 7);
  const auto model = this->model(text);
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  EXPECT_NEAR(surface.phase_loop[0], 8 / 1e4, 1e-5);  // on the springs
  EXPECT_NEAR(surface.phase_loop[2], 8, 1e-8);
}

/// Each phase stands for half of the intervals on both sides.
TEST_F(Fretting, MeansOfForcesAreThoseOfTheCycle) {
  const std::string drive =
      "x = \"0.01 * sin(2*pi*tau)\"\nforce = \"20 * (1 + 0.5*sin(4*pi*tau))\"";
  std::string text = bed(drive);
  text.erase(text.find(", force = 20.0"), 14);
  const auto model = this->model(text, {"cycle.phases=16"});
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "contact_force"), 20, 0.05);
}

/// Wherever the origin of the coordinates lies.
TEST_F(Fretting, TheStrokeIsThatOfTheContactWhereACounterBodyTurns) {
  folder_.write("flat.geo", half_plane(4, 4, 3) + "Translate {0, 7, 0} {Surface {1, 2, 3, 4};}\n");
  const auto model = this->model(cylinder("rotation = \"1e-4 * sin(2*pi*tau)\""),
                                 {"counter_body.center=[0.0, 13.0]"});
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "stroke"), 2 * 6e-4, 1e-9);
}

/// A half-plane program of the author of the scene has 16 % more work in one increment than in
/// many.
TEST_F(Fretting, ForcesThatJumpAreToldOf) {
  std::string text = cylinder();
  text.replace(text.find("sin(2*pi*tau)"), 13, "if(tau < 0.5, 1, -1)");
  EXPECT_THAT(model(text)->remarks, Contains(HasSubstr("the cycle jumps at tau = 0")));
  text.replace(text.find("if(tau < 0.5, 1, -1)"), 20, "if(tau > 0.25, if(tau > 0.75, 1, -1), 1)");
  EXPECT_THAT(model(text)->remarks, Contains(HasSubstr("the cycle jumps at tau = 0.25")));
  EXPECT_THAT(model(cylinder())->remarks, Each(Not(HasSubstr("jumps"))));
}

TEST_F(Fretting, ExpressionsInThePlaneHaveNoThirdCoordinate) {
  const std::string text = cylinder("x = \"1e-4 * sin(2*pi*tau)\"");
  expect_refused(text, {"friction.factor=\"1 + z0\""}, "expected x0 and y0, got z0");
  expect_refused(text, {"wear.rate=\"k*p*v*(1 + z0)\""}, "expected x0 and y0, got z0");
}

TEST_F(Fretting, PartialSlipWithoutStickIsRefusedAndToldOf) {
  EXPECT_THAT(refusal(cylinder("x = \"1e-4 * sin(2*pi*tau)\""), {"friction.stick=false"}),
              HasSubstr("friction.stick = true"));
}

}  // namespace
}  // namespace gnomon::stick_test
