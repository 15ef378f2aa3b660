// Cycles: a flat that a reciprocating cylinder wears, against steady sliding, the balance of what
// wears, and derivatives.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

#include "part/cyclic_flat.hpp"

namespace gnomon::cycle_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Cycles, OnePhaseIsTheSteadyState) {
  const auto steady = model(text("motion.velocity = [0.4, 0.0]")),
             cycle = model(text("[cycle]\nperiod = 2.0\nphases = 1\nx = \"0.8 * (tau - 0.5)\""));
  const ModelRun expected = run_model(*steady, "esdirk-3", 0, 1e-4, 100),
                 actual = run_model(*cycle, "esdirk-3", 0, 1e-4, 100);
  EXPECT_EQ(actual.counters.newton_iterations, expected.counters.newton_iterations);
  const std::vector<double>& scale = steady->system().structure().unknown_scale;
  for (std::size_t i = 0; i < scale.size(); ++i)
    EXPECT_NEAR(actual.last().y[i], expected.last().y[i], 1e-8 * scale[i]);  // rounding, magnified
}

/// Four amplitudes a period; the force along the press, whatever the slope of the scar's sides.
TEST_F(Cycles, LoseWhatTheForceAndThePathSay) {
  const std::string triangle =
      "[cycle]\nperiod = 1.0\nphases = 6\nx = \"0.1 * (1 - 4 * abs(tau - 0.5))\"\n";
  const auto flat =
      model(text(triangle), {"counter_body.radius=60.0", "counter_body.center=[0, 60]"});
  for (const char* integrator : {"esdirk-3", "bdf", "forward-euler"}) {
    const double step = std::string(integrator) == "forward-euler" ? 0.5 : 0;
    const ModelRun run = run_model(*flat, integrator, step, 1e-4, 100);
    const double expected = 2.9e-6 * 18.5 * 4 * 0.1 * 100;
    EXPECT_NEAR(observed(*flat, run.last(), "worn_volume") / expected, 1, 1e-5) << integrator;
    EXPECT_NEAR(observed(*flat, run.last(), "contact_force") / 18.5, 1, 1e-5) << integrator;
  }
}

/// Steps of whole turns would see an eccentric cylinder at one angle only.
TEST_F(Cycles, AShapeThatTurnsIsNotSteppedOver) {
  const std::string turning = text("motion.rotation = 6.2832\nmotion.center = [0.0, 11.0]");
  try {
    model(turning, {"integrator.step=50"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("integrator.step: expected at most 0.0625 s"));
  }
  model(turning, {"integrator.step=0.06"});
  EXPECT_THAT(model(turning)->remarks, Contains(HasSubstr("turns 100 times in the run")));
  EXPECT_THAT(model(turning, {"time.end=5"})->remarks,
              Not(Contains(HasSubstr("times in the run"))));
}

TEST_F(Cycles, WearTheSameOnBothSides) {
  const auto flat = model(text(reciprocating));
  const ModelRun run = run_model(*flat, "esdirk-3", 0, 1e-4, 100);
  const ContactSurface surface = flat->contact(run.last()).value();
  const std::size_t count = surface.node.size();
  ASSERT_EQ(surface.phase_position.size(), 6u);
  ASSERT_EQ(surface.phase_pressure.size(), 6 * count);
  double deepest = 0;
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t other = 0; other < count; ++other)
      if (std::abs(surface.initial[c][0] + surface.initial[other][0]) < 1e-9) {
        EXPECT_NEAR(surface.worn[c][1], surface.worn[other][1], 1e-7);
        deepest = std::max(deepest, -surface.worn[c][1]);
      }
  EXPECT_GT(deepest, 1e-3);
}

TEST_F(Cycles, JacobianEqualsFiniteDifferences) {
  for (const char* constraint : {"eliminated", "multiplier"}) {
    const auto flat =
        model(text("[cycle]\nperiod = 1.0\nphases = 3\nx = \"0.1 * sin(2*pi*tau)\"\nforce = \"20 + "
                   "10*cos(2*pi*tau)\"\nrotation = \"0.01 * sin(2*pi*tau)\"\nload = \"tau\"\n",
                   ""),
              {fmt::format("shape.constraint={}", constraint), "mesh.factor=3",
               "friction.coefficient=0.3"});
    Counters counters;
    std::vector<double> y = flat->start(counters).y;
    const Structure& structure = flat->system().structure();
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += 0.02 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
    check_jacobian(flat->system(), 0, y, 0.2, nullptr, 1e-4);
    for (const AlgebraicStage& stage : flat->system().algebraic_stages()) {
      stage.freeze(0, y);
      std::vector<double> part;
      for (int unknown : stage.unknowns) part.push_back(y[unknown]);
      check_jacobian(*stage.system, 0, part, 0, nullptr, 1e-4);
    }
  }
}

TEST_F(Cycles, BothSolversAgree) {
  const auto run = [&](const char* method) {
    const auto flat = model(text(reciprocating), {fmt::format("solver.method={}", method)});
    return observed(*flat, run_model(*flat, "bdf", 0, 1e-6, 100).last(), "max_pressure");
  };
  EXPECT_NEAR(run("block") / run("direct"), 1, 1e-5);
}

/// A held counter-body: the worn volume is less, because pressures fall; phases far away do not
/// wear.
TEST_F(Cycles, PhasesWithoutContactDoNotWear) {
  const std::string held = "approach = 0.002";
  const auto flux = [&](const std::string& phases, const std::string& x) {
    const auto flat =
        model(text("[cycle]\nperiod = 1.0\nphases = " + phases + "\nx = \"" + x + "\"\n", held));
    Counters counters;
    return observed(*flat, flat->start(counters), "wear_flux");
  };
  // Two of four equal phases are 5 mm away, where the cylinder passes beside the flat's end.
  const double there = flux("1", "0.4 * (tau - 0.5)"),
               half = flux("[0.0, 0.25, 0.5, 0.75]",
                           "if(tau < 0.3, 0, 5) + 0.4 * tau - "
                           "if(tau < 0.2, 0, if(tau < 0.3, 0.1, 0))");
  EXPECT_GT(there, 0);
  EXPECT_NEAR(half / there, 0.5, 1e-9);
}

/// The differential components.
std::vector<double> shape_of(const Model& model, const std::vector<double>& y) {
  std::vector<double> shape;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (model.system().structure().differential[i]) shape.push_back(y[i]);
  return shape;
}

/// The largest difference, divided by the deepest wear.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest / -*std::ranges::min_element(b);
}

/// Every cycle, of one unit of time, through its phases as ordinary time, each for an equal part of
/// it: the explicit midpoint rule, whose error is of second order in the wear of a phase.
std::vector<double> worn_through_every_cycle(const std::vector<std::unique_ptr<Model>>& phases,
                                             int cycles) {
  Counters counters;
  State state = phases.front()->start(counters);
  const double step = 1 / double(phases.size());
  const std::vector<char>& differential = phases.front()->system().structure().differential;
  const auto move_from = [&](const System& system, const State& from, double length) {
    EXPECT_EQ(AlgebraicSolver(system, counters).solve(state.t, state.y), "");
    set_rates(system, nullptr, state);
    State moved = state;
    for (std::size_t i = 0; i < moved.y.size(); ++i)
      if (differential[i]) moved.y[i] = from.y[i] + length * state.ydot[i];
    state = moved;
  };
  for (int cycle = 0; cycle < cycles; ++cycle)
    for (const auto& phase : phases) {
      const State begin = state;
      move_from(phase->system(), begin, step / 2);
      move_from(phase->system(), begin, step);
    }
  return shape_of(*phases.front(), state.y);
}

/// The same wear by several wear coefficients, in fewer and longer cycles: the mean over a cycle
/// differs from the run through all of them by a part of the wear of one cycle.
TEST_F(Cycles, DifferFromTheRunThroughAllByTheWearOfOneCycle) {
  const auto scene = [&](const std::string& phases) {
    return text("[cycle]\nperiod = 1.0\nphases = " + phases + "\nx = \"0.1 * sin(2*pi*tau)\"\n");
  };
  const std::vector<std::string> positions = {"0.05", "0.3", "0.55", "0.8"};
  const auto mean = model(scene("[0.05, 0.3, 0.55, 0.8]"));
  const auto expected = shape_of(*mean, run_model(*mean, "esdirk-4", 0, 1e-7, 40).last().y);
  std::vector<double> differences;
  for (const int cycles : {5, 10, 20, 40}) {
    std::vector<std::unique_ptr<Model>> phases;
    for (const std::string& position : positions)
      phases.push_back(model(scene("[" + position + "]"),
                             {fmt::format("wear.coefficient={}", 2.9e-6 * 40 / cycles)}));
    differences.push_back(difference(worn_through_every_cycle(phases, cycles), expected));
    std::printf("%d cycles: %.2e of the depth\n", cycles, differences.back());
  }
  EXPECT_NEAR(std::log2(differences[0] / differences[3]) / 3, 1, 0.15);
  EXPECT_LT(differences[3], 0.25 / 40);  // a quarter of the wear of one cycle
}

/// A force that rises and falls, as a history of ordinary time through every cycle.
TEST_F(Cycles, DifferFromAnOrdinaryHistoryInTheFirstOrder) {
  const auto mean = model(text(
      "motion.velocity = [0.4, 0.0]\n[cycle]\nperiod = 1.0\nphases = 16\nforce = \"saw(tau)\"\n"
      "[tables]\nsaw = { x = [0.0, 0.3, 1.0], y = [9.25, 27.75, 9.25] }\n",
      ""));
  const auto expected = shape_of(*mean, run_model(*mean, "esdirk-4", 0, 1e-6, 40).last().y);
  std::vector<double> differences;
  for (const int cycles : {4, 8, 16}) {
    std::string times = "0", factors = "0.5";
    for (int cycle = 0; cycle < cycles; ++cycle) {
      times += fmt::format(", {}, {}", 40.0 / cycles * (cycle + 0.3), 40.0 / cycles * (cycle + 1));
      factors += ", 1.5, 0.5";
    }
    const auto all =
        model(text("motion.velocity = [0.4, 0.0]",
                   fmt::format("force = 18.5, times = [{}], factors = [{}]", times, factors)));
    const State last = run_model(*all, "esdirk-4", 0, 1e-6, 40).last();
    differences.push_back(difference(shape_of(*all, last.y), expected));
    std::printf("%d cycles: %.2e of the depth\n", cycles, differences.back());
  }
  EXPECT_NEAR(std::log2(differences[0] / differences[2]) / 2, 1, 0.15);
}

// The history of the press multiplies a force of the cycle as one of the press.
TEST_F(Cycles, TheForceOfACycleHasAHistory) {
  const std::string history = "times = [0, 50, 50, 100], factors = [1, 1, 2, 3]";
  const auto ended = [&](const std::string& cycle, const std::string& press) {
    const auto flat = model(text(reciprocating + cycle, press));
    const State last = run_model(*flat, "esdirk-3", 0, 1e-4, 100).last();
    const Observation observed = flat->observe(last);
    return std::pair(value_of(observed, "contact_force").value(),
                     value_of(observed, "worn_volume").value());
  };
  const auto [force, worn] = ended("force = \"10.0\"\n", history);
  const auto [of_press, worn_by_press] = ended("", "force = 10.0, " + history);
  EXPECT_NEAR(force, 30, 0.05);  // the tolerance of the solves
  EXPECT_NEAR(of_press, force, 1e-6);
  EXPECT_NEAR(worn / worn_by_press, 1, 1e-9);
}

TEST_F(Cycles, RefuseWhatTheyCannotDo) {
  EXPECT_THAT(refusal(text(reciprocating + "force = \"10.0\"\n")),
              HasSubstr("cycle.force`: expected either cycle.force or counter_body.press.force"));
  EXPECT_THAT(refusal(text(reciprocating + "force = \"10 * sin(2*pi*tau)\"\n", "")),
              HasSubstr("expected a force above zero"));
  EXPECT_EQ(refusal(text(reciprocating + "force = \"10.0\"\n", "")), "");
}

/// Strokes shorter than the elastic shear of the contact, about 2 um here: also with a rest between
/// them, and among long ones; and orbits, which never reverse.
TEST_F(Cycles, RefusePartialSlip) {
  const auto with = [&](const std::string& motion, double friction = 0.5) {
    return refusal(text("[cycle]\nperiod = 1.0\nphases = 32\n" + motion),
                   {fmt::format("friction.coefficient={}", friction)});
  };
  const std::string tables =
      "[tables]\nrests = { x = [0.0, 0.2, 0.5, 0.7, 1.0], y = [0.0, 1.0, 1.0, "
      "0.0, 0.0] }\n";
  for (const char* motion : {"x = \"1e-4 * sin(2*pi*tau)\"\n", "x = \"1e-4 * rests(tau)\"\n",
                             "x = \"2e-4 * sin(2*pi*tau)\"\nz = \"2e-4 * cos(2*pi*tau)\"\n",
                             "x = \"0.002 * sin(2*pi*tau) + 3e-4 * sin(40*pi*tau)\"\n"}) {
    EXPECT_THAT(with(motion + tables), HasSubstr("partial slip")) << motion;
    EXPECT_EQ(with(motion + tables, 0), "") << motion;
  }
  for (const char* motion :
       {"x = \"0.1 * rests(tau)\"\n", "x = \"0.1 * sin(2*pi*tau)\"\nz = \"0.1 * cos(2*pi*tau)\"\n",
        "x = \"0.1 * sin(2*pi*tau) + 1e-5 * sin(200*pi*tau)\"\n"})
    EXPECT_EQ(with(motion + tables), "") << motion;
}

/// With fewer phases than the motion has parts: a table with a point at every thousandth, whose
/// speed jumps at each of them. The path and the force on it are exact, and so is the worn area.
TEST_F(Cycles, FewPhasesLoseWhatTheForceAndThePathSay) {
  std::string x, y;
  double path = 0, last = 0, work = 0;
  const int points = 101;
  const auto force = [](double tau) { return 18.5 * (1 + 0.5 * std::cos(16 * M_PI * tau)); };
  for (int k = 0; k < points; ++k) {
    const double tau = k / (points - 1.0), noise = k % 100 == 0 ? 0 : 0.01 * std::sin(37.0 * k);
    const double place = 0.1 * std::sin(2 * M_PI * tau) + noise, step = std::abs(place - last);
    x += fmt::format("{}{}", k ? ", " : "", tau);
    y += fmt::format("{}{}", k ? ", " : "", place);
    const auto integral = [](double t) { return t + 0.5 * std::sin(16 * M_PI * t) / (16 * M_PI); };
    if (k) {
      path += step;
      work += 18.5 * step * (integral(tau) - integral(tau - 0.01)) / 0.01;
    }
    last = place;
  }
  for (const int phases : {1, 8, 16}) {
    const auto flat = model(
        text(fmt::format("[cycle]\nperiod = 2.0\nphases = {}\nx = \"noisy(tau)\"\nforce = \"18.5 * "
                         "(1 + 0.5 * cos(16*pi*tau))\"\ntables.noisy = {{ x = [{}], y = [{}] }}\n",
                         phases, x, y),
             ""),
        {"counter_body.radius=60.0", "counter_body.center=[0, 60]"});
    Counters counters;
    const double flux = observed(*flat, flat->start(counters), "wear_flux");
    EXPECT_NEAR(flux / (2.9e-6 * work / 2), 1, 1e-5) << phases << " phases";
  }
  EXPECT_GT(std::abs(force(0) * path / work - 1), 0.1);  // the force matters
}

/// A law that fades with s, by its closed form where the force and the path are constant:
/// V = k F v (c / v_s) (1 - exp(-v_s T / c)).
double faded_area(double speed, double counted_speed, double end) {
  const double c = 50;
  return 2.9e-6 * 18.5 * speed * c / counted_speed * (1 - std::exp(-counted_speed * end / c));
}

TEST_F(Cycles, CountTheSlidingDistanceAsTheSceneSays) {
  const std::string triangle =
      "[cycle]\nperiod = 0.1\nphases = 6\nx = \"0.1 * (1 - 4 * abs(tau - 0.5))\"\n";
  const double speed = 4;
  for (const double counted : {0.0, 1.0}) {
    Overrides overrides = {"wear.rate=\"k*p*v*exp(-s/50)\"", "wear.coefficient=2.9e-6",
                           "integrator.rtol=1e-6"};
    if (counted > 0) overrides.push_back(fmt::format("wear.velocity={}", counted));
    const auto flat = model(text(triangle), overrides);
    const State last = run_model(*flat, "esdirk-3", 0, 1e-6, 20).last();
    EXPECT_NEAR(
        observed(*flat, last, "worn_volume") / faded_area(speed, counted > 0 ? counted : speed, 20),
        1, 1e-4)
        << counted;
  }
}

/// Under a force a lift moves the place of the counter-body, but nothing slides by it.
TEST_F(Cycles, DoNotSlideByLifting) {
  const std::string
      motion = "[cycle]\nperiod = 0.1\nphases = 6\nx = \"0.1 * (1 - 4 * abs(tau - 0.5))\"\n",
      lifted = motion + "y = \"0.5 * sin(14*pi*tau)\"\n";
  const auto flux = [&](const std::string& of) {
    const auto flat =
        model(text(of), {"wear.rate=\"k*p*v*exp(-s/50)\"", "counter_body.radius=600.0",
                         "counter_body.center=[0, 600]"});
    EXPECT_THAT(flat->remarks, Not(Contains(HasSubstr("mean of speed")))) << of;
    State start = flat->start(unused_);
    start.t = 10;
    return observed(*flat, start, "wear_flux");
  };
  EXPECT_NEAR(flux(lifted) / flux(motion), 1, 0.05);  // on the inclined sides of contact it slides
  EXPECT_THAT(refusal(text("[cycle]\nperiod = 1.0\nphases = 6\nx = \"1e-5 * sin(2*pi*tau)\"\n"
                           "y = \"0.5 * sin(2*pi*tau)\"\n"),
                      {"friction.coefficient=0.6"}),
              HasSubstr("partial slip"));
}

/// Out of the plane and in it: an orbit, of which a phase has the length of its arc, not its chord.
TEST_F(Cycles, FewPhasesHaveThePathOfAnOrbit) {
  std::string tau, x, z;
  const int points = 121;
  for (int k = 0; k < points; ++k) {
    const double at = k / (points - 1.0);
    tau += fmt::format("{}{}", k ? ", " : "", at);
    x += fmt::format("{}{}", k ? ", " : "", 0.1 * std::cos(2 * M_PI * at));
    z += fmt::format("{}{}", k ? ", " : "", 0.1 * std::sin(2 * M_PI * at));
  }
  const double path = (points - 1) * 0.2 * std::sin(M_PI / (points - 1));
  for (const int phases : {2, 3, 8}) {
    const auto flat = model(
        text(fmt::format("[cycle]\nperiod = 1.0\nphases = {}\nx = \"a(tau)\"\nz = \"b(tau)\"\n"
                         "[tables]\na = {{ x = [{}], y = [{}] }}\nb = {{ x = [{}], y = [{}] }}\n",
                         phases, tau, x, tau, z)),
        {"counter_body.radius=60.0", "counter_body.center=[0, 60]"});
    const double flux = observed(*flat, flat->start(unused_), "wear_flux");
    EXPECT_NEAR(flux / (2.9e-6 * 18.5 * path), 1, 1e-4) << phases << " phases";
  }
}

/// Where a table begins a phase has the speed of what follows; and a stroke of a millionth of the
/// cycle is not lost between corners that are nearly the same.
TEST_F(Cycles, LoseWhatTablesOfTheMotionSay) {
  const auto flux = [&](const char* phases, const char* x, const char* y) {
    const auto flat = model(text(fmt::format("[cycle]\nperiod = 1.0\nphases = {}\nx = \"a(tau)\"\n"
                                             "[tables]\na = {{ x = {}, y = {} }}\n",
                                             phases, x, y)),
                            {"counter_body.radius=60.0", "counter_body.center=[0, 60]"});
    return observed(*flat, flat->start(unused_), "wear_flux") / (2.9e-6 * 18.5);
  };
  EXPECT_NEAR(flux("[0.0, 0.25, 0.5, 0.75]", "[0.0, 0.5, 1.0]", "[-0.1, 0.1, -0.1]"), 0.4, 1e-5);
  EXPECT_NEAR(flux("8", "[0.0, 0.5, 0.5000005, 1.0]", "[-0.1, 0.1, -0.1, 0.1]"), 0.6, 1e-5);
}

}  // namespace
}  // namespace gnomon::cycle_test
