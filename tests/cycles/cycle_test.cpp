// Cycles of motion and load: functions of the position, the counter-body in a phase, and [cycle].

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gnomon/cycles/cycle.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <numbers>

namespace gnomon::cycle_test {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CycleFunction function(const std::string& text) {
  ExpressionNames names;
  names.variables = {"tau"};
  names.constants["pi"] = std::numbers::pi;
  names.tables.emplace("triangle", PiecewiseLinear({0, 0.25, 0.75, 1}, {0, 2, -2, 0}));
  return CycleFunction(Expression(text, names));
}

TEST(CycleFunction, SlopeIsTheDerivative) {
  const CycleFunction f = function("0.1 * sin(2*pi*tau) + tau^2");
  for (const double tau : {0.0, 0.1, 0.37, 0.9}) {
    const double step = 1e-6;
    EXPECT_NEAR(f.slope(tau), (f.value(tau + step) - f.value(tau - step)) / (2 * step), 1e-8);
  }
}

TEST(CycleFunction, KnowsItsKinks) {
  EXPECT_THAT(function("sin(2*pi*tau)").kinks(), testing::IsEmpty());
  EXPECT_THAT(function("abs(sin(2*pi*tau - 1))").kinks(),
              ElementsAre(DoubleNear(0.5 / M_PI, 1e-12), DoubleNear(0.5 + 0.5 / M_PI, 1e-12)));
  EXPECT_THAT(function("0.05*sin(2*pi*1000*tau)").kinks(), testing::IsEmpty());
  // These end otherwise than they begin.
  EXPECT_THAT(function("abs(tau - 0.5)").kinks(), ElementsAre(0, DoubleNear(0.5, 1e-12)));
  EXPECT_THAT(function("tau").kinks(), ElementsAre(0));
  EXPECT_THAT(function("triangle(tau)").kinks(),
              ElementsAre(0, DoubleNear(0.25, 1e-12), DoubleNear(0.75, 1e-12)));
}

/// A body that has turned round is where it was.
TEST(CycleFunction, WholeTurnsAreNoJump) {
  const double turn = 2 * std::numbers::pi;
  EXPECT_THAT(function("2*pi*tau").kinks(turn), testing::IsEmpty());
  EXPECT_THAT(function("0.3 - 4*pi*tau + 0.1*sin(2*pi*tau)").kinks(turn), testing::IsEmpty());
  EXPECT_THAT(function("pi*tau").kinks(turn), ElementsAre(0));
  EXPECT_THAT(function("2*pi*tau^2").kinks(turn), ElementsAre(0));  // with another speed
  Cycle cycle;
  cycle.rotation = function("2*pi*tau");
  EXPECT_THAT(cycle.kinks(), testing::IsEmpty());
  cycle.displacement[0] = function("2*pi*tau");
  EXPECT_THAT(cycle.kinks(), ElementsAre(0));
}

// The velocity of a point of the surface is the derivative of where the motion carries it.
TEST(CycleCounterBody, MovesWithTheDerivativeOfItsPlace) {
  Cycle cycle;
  cycle.period = 2;
  cycle.displacement = {function("0.3 * sin(2*pi*tau)"), function("0.1 * cos(2*pi*tau)"),
                        function("tau")};
  cycle.rotation = function("0.4 * sin(2*pi*tau)");
  const CycleAxis<2> axis{spin_in_plane(1), Vector<2>(0.5, 1), true};
  CounterBody<2> body;
  body.shape = ball<2>(Vector<2>(0, 2), 1);
  const Vector<2> mark(0.2, 1.1);  // of the shape
  const auto place = [&](double tau) {
    const CounterBody<2> at = counter_body_at<2>(body, cycle, axis, tau);
    return Vector<2>(at.position + axis.centre + at.turning->rotation(7) * (mark - axis.centre));
  };
  const double tau = 0.15, step = 1e-6;
  const CounterBody<2> at = counter_body_at<2>(body, cycle, axis, tau);
  const Vector<2> velocity = at.motion.at<double>(Vector<2>(place(tau) - at.position));
  const Vector<2> expected = (place(tau + step) - place(tau - step)) / (2 * step * cycle.period);
  EXPECT_NEAR((velocity - expected).norm(), 0, 1e-8);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_NEAR(at.motion.across_at<double>(mark), 0.5, 1e-12);
}

/// An eccentric cylinder lifts by what its centre does.
TEST(CycleCounterBody, TouchesWhereItHasTurnedTo) {
  Cycle cycle;
  cycle.rotation = function("2*pi*tau");
  CounterBody<2> body;
  body.shape = ball<2>(Vector<2>(0.5, 0), 2);
  const CycleAxis<2> axis{spin_in_plane(1), Vector<2>(0, 0), true};
  for (const double tau : {0.0, 0.1, 0.25, 0.6, 0.75}) {
    const CounterBody<2> at = counter_body_at<2>(body, cycle, axis, tau);
    const double angle = 2 * M_PI * tau;
    const Vector<2> above(0.5 * std::cos(angle), 5);  // the centre
    EXPECT_NEAR(at.travel_to(above), 5 - 2 - 0.5 * std::sin(angle), 1e-12);
    const Vector<2> beside(0.3, 5);
    EXPECT_NEAR(at.unchecked_distance(at.seen(beside, at.travel_to(beside)), 0).gap, 0, 1e-12);
  }
}

std::vector<Key> keys_of(const std::string&) {
  std::vector<Key> keys = {run_keys().front()};
  keys.insert(keys.end(), cycle_keys().begin(), cycle_keys().end());
  for (const Key& key : worn_body_keys(2))
    if (key.name.starts_with("tables.")) keys.push_back(key);
  return keys;
}

Scene reread(const std::string& text) {
  return parse_scene(text, "result", {}, keys_of);
}

Scene scene_of(const std::string& text, const std::filesystem::path& folder = {}) {
  return parse_scene("problem = \"none\"\n" + text, (folder / "scene.toml").string(), {}, keys_of);
}

std::string refusal(const std::string& text) {
  try {
    const Scene scene = scene_of(text);
    if (read_cycle(scene)) read_cycle_quadrature(scene, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CycleScene, ReadsExpressionsAndTables) {
  const Scene scene = scene_of(
      "[cycle]\nperiod = 2.0\nphases = 4\nx = \"0.5 * gait(tau)\"\n"
      "[tables]\ngait = { x = [0.0, 0.5, 1.0], y = [0.0, 2.0, 0.0] }\n");
  const auto cycle = read_cycle(scene);
  ASSERT_TRUE(cycle);
  EXPECT_DOUBLE_EQ(cycle->displacement[0]->value(0.25), 0.5);
  EXPECT_DOUBLE_EQ(cycle->displacement[0]->slope(0.25), 2);
  EXPECT_EQ(read_cycle_quadrature(scene, {}).points().size(), 4u);
}

TEST(CycleScene, PhasesAreAutoOrNumbers) {
  const auto scene = [](const std::string& phases) {
    return scene_of("[cycle]\nperiod = 1.0\nphases = " + phases + "\n");
  };
  const Scene chooses = scene("\"auto\"");
  EXPECT_TRUE(chooses_phases(chooses));
  EXPECT_FALSE(chooses_phases(scene("8")));
  EXPECT_TRUE(chooses_phases(reread(chooses.resolved())));
  const auto count = [](const Scene& of, int times) {
    return read_cycle_quadrature(of, {}).refined(times).points().size();
  };
  EXPECT_EQ(count(with_phases(chooses, 8), 2), 16u);
  EXPECT_EQ(count(scene("[0.0, 0.5]"), 4), 8u);
  EXPECT_EQ(count(scene("[0.25]"), 1), 1u);
  EXPECT_THAT(refusal("[cycle]\nperiod = 1.0\nphases = \"auto\"\n"),
              HasSubstr("this problem does not choose them"));
  EXPECT_THAT(refusal("[cycle]\nperiod = 1.0\nphases = \"many\"\n"), HasSubstr("or \"auto\", got"));
}

TEST(CycleScene, AResultNeedsNoFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "gnomon_cycle_tables";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "gait.csv") << "tau, force\n0, 100\n0.5, 300\n1, 100\n";
  const std::string text = "[cycle]\nperiod = 1.0\nphases = [0.0, 0.5]\nforce = \"gait.csv\"\n";
  const Scene scene = scene_of(text, folder);
  EXPECT_DOUBLE_EQ(read_cycle(scene)->force->value(0.25), 200);
  const std::string alone = with_cycle_tables(scene).resolved();
  std::filesystem::remove_all(folder);
  EXPECT_THROW(read_cycle(scene), InputError);
  EXPECT_DOUBLE_EQ(read_cycle(reread(alone))->force->value(0.25), 200);
}

std::vector<Key> run_keys_too(const std::string&) {
  std::vector<Key> keys = run_keys();
  keys.insert(keys.end(), cycle_keys().begin(), cycle_keys().end());
  for (const Key& key : worn_body_keys(2))
    if (key.name.starts_with("tables.")) keys.push_back(key);
  return keys;
}

Scene timed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const std::string head = "problem = \"none\"\n[integrator]\nname = \"bdf\"\n";
  return parse_scene(head + text, "scene.toml", overrides, run_keys_too);
}

std::string timed_refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    timed(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CycleScene, CyclesTimesThePeriodAreTheEnd) {
  const std::string cycle = "[cycle]\nperiod = 0.5\nphases = 4\n";
  const Scene scene = timed("[time]\ncycles = 18000\n" + cycle);
  EXPECT_EQ(scene.real("time.end"), 9000);
  // The end is kept, so that a result can be resumed to another one.
  const Scene again = parse_scene(scene.resolved(), "result", {"time.cycles=20000"}, run_keys_too);
  EXPECT_EQ(again.real("time.end"), 10000);
  EXPECT_EQ(timed("[time]\ncycles = 18000\n" + cycle, {"time.end=10"}).real("time.end"), 10);
  EXPECT_THAT(timed_refusal("[time]\ncycles = 4\nend = 2.0\n" + cycle),
              HasSubstr("time.cycles`: expected either time.end or time.cycles, got both"));
  EXPECT_THAT(timed_refusal("[time]\ncycles = 4\n"), HasSubstr("expected also cycle.period"));
  EXPECT_THAT(timed_refusal(cycle), HasSubstr("key `time.end`: missing"));
  EXPECT_THAT(timed_refusal("[time]\ncycles = 1e29\n[cycle]\nperiod = 1e29\nphases = 1\n"),
              HasSubstr("as time.end expected a number"));
}

TEST(CycleScene, RefusesWhatItCannotUse) {
  const std::string begin = "[cycle]\nperiod = 1.0\n";
  EXPECT_THAT(refusal("[cycle]\nx = \"tau\"\n"), HasSubstr("cycle.x`: expected also cycle.period"));
  EXPECT_THAT(refusal(begin), HasSubstr("expected also cycle.phases"));
  EXPECT_THAT(refusal(begin + "phases = 2.5\n"), HasSubstr("got 2.5"));
  EXPECT_THAT(refusal(begin + "phases = 0\n"), HasSubstr("expected a number in [1, 4096], or"));
  EXPECT_THAT(refusal(begin + "phases = 0.5\n"), HasSubstr("got 0.5"));
  EXPECT_THAT(refusal(begin + "phases = [0.5, 0.2]\n"), HasSubstr("got 0.2 at place 2"));
  EXPECT_THAT(refusal(begin + "phases = []\n"), HasSubstr("got none"));
  EXPECT_THAT(refusal(begin + "phases = 4\nx = \"sin(t)\"\n"), HasSubstr("unknown name \"t\""));
  EXPECT_THAT(refusal(begin + "phases = 4\nx = \"log(tau - 0.5)\"\n"), HasSubstr("finite value"));
  EXPECT_THAT(refusal(begin + "phases = 4\nforce = \"none.csv\"\n"), HasSubstr("there is none"));
  EXPECT_EQ(refusal(begin + "phases = 4\nx = \"sin(2*pi*tau)\"\n"), "");
}

TEST(CycleScene, ARefusedFactorOfTheEndIsOneMistake) {
  const std::string begin = "[cycle]\nphases = 1\n";
  for (const char* wrong :
       {"period = -1.0\n[time]\ncycles = 3.0\n", "period = 1.0\n[time]\ncycles = 0.0\n",
        "period = 1.0\n[time]\ncycles = \"x\"\n"}) {
    Mistakes mistakes;
    parse_scene("problem = \"none\"\nintegrator.name = \"bdf\"\n" + begin + wrong, "text", {},
                run_keys_too, &mistakes);
    EXPECT_THAT(mistakes.lines(), ElementsAre(HasSubstr("expected a number in"))) << wrong;
  }
}

/// A file of seconds or degrees would be read at its first points only.
TEST(CycleScene, RefusesFilesThatAreNotOverTheCycle) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "gnomon_cycle_files";
  std::filesystem::create_directories(folder / "folder.csv");
  const auto refused = [&](const std::string& name, const std::string& points) {
    if (!points.empty()) std::ofstream(folder / name) << points;
    return refusal("[cycle]\nperiod = 1.0\nphases = 4\nforce = \"" +
                   (folder / name).generic_string() + "\"\n");
  };
  EXPECT_THAT(refused("seconds.csv", "0, 1\n1, 2\n5, 1\n"),
              AllOf(HasSubstr("cycle.force`: "),
                    HasSubstr("seconds.csv: expected ascending tau in [0, 1], got 5 in point 3")));
  EXPECT_EQ(refused("twice.csv", "0, 1\n0.5, 2\n0.5, 1\n"), "");
  EXPECT_THAT(refused("thrice.csv", "0, 1\n0.5, 2\n0.5, 1\n0.5, 3\n"), HasSubstr("abscissa 4"));
  EXPECT_THAT(refused("folder.csv", ""), HasSubstr("this is something else"));
}

TEST(Cycle, SaysWhichMotionsDoNotEndWhereTheyBegin) {
  const auto remarks = [](const std::string& motion) {
    const std::string text = "[cycle]\nperiod = 1.0\nphases = 4\n" + motion;
    return read_cycle(scene_of(text))->remarks();
  };
  EXPECT_THAT(remarks("x = \"sin(2*pi*tau)\"\nrotation = \"2*pi*tau\"\n"), IsEmpty());
  EXPECT_THAT(remarks("x = \"0.05*sin(2*pi*1000*tau)\"\n"), IsEmpty());
  EXPECT_THAT(remarks("x = \"1 + 0.1*tau\"\nrotation = \"tau\"\n"),
              ElementsAre(HasSubstr("cycle.x ends 0.1 mm from where it begins"),
                          HasSubstr("cycle.rotation ends 1 rad")));
}

}  // namespace
}  // namespace gnomon::cycle_test
