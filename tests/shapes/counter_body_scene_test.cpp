#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "shapes/counter_body_text.hpp"

namespace gnomon::counter_body_scene_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr auto meridian = Section::meridian;

// One name means one thing: the same kind, unit, length and range in all shapes that have it.
TEST(CounterBodyKeys, AreTheSameInAllShapes) {
  std::map<std::string, Key> seen;
  int shared = 0;
  for (const auto& kind : Registry<CounterShapeKind>::all()) {
    std::vector<Key> keys = kind.keys;
    keys.insert(keys.end(), kind.keys_in_space.begin(), kind.keys_in_space.end());
    for (const Key& key : keys) {
      EXPECT_EQ(key.name.rfind("counter_body.", 0), 0u) << key.name;
      const auto [there, added] = seen.emplace(key.name, key);
      shared += !added;
      EXPECT_EQ(there->second.kind, key.kind) << key.name;
      EXPECT_EQ(there->second.unit, key.unit) << key.name;
      EXPECT_EQ(there->second.length, key.length) << key.name;
      EXPECT_EQ(there->second.range.min, key.range.min) << key.name;
      EXPECT_EQ(there->second.range.max, key.range.max) << key.name;
    }
  }
  EXPECT_GT(shared, 5);
}

// One table for both, where only the mesh says which.
TEST(CounterBodyKeys, ServeThePlaneAndSpace) {
  const std::string ring = "[counter_body]\nshape = \"cylinder\"\nradius = 2.0\n";
  const Scene plane =
      scene_of(ring + "center = [0.0, 3.0]\nmotion = { velocity = [0.0, 0.0, 1.0] }\n");
  EXPECT_DOUBLE_EQ(read_counter_body<2>(plane).shape.at({0, 0}).gap, 1);
  const Scene space = scene_of(ring + "center = [0.0, 0.0, 3.0]\naxis = [0.0, 1.0, 0.0]\n");
  EXPECT_DOUBLE_EQ(read_counter_body<3>(space).shape.at({0, 7, 0}).gap, 1);
  const auto refused = [](const auto& read) {
    try {
      read();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused([&] { read_counter_body<3>(plane); }),
              HasSubstr("counter_body.shape`: expected also counter_body.axis"));
  EXPECT_THAT(refused([&] { read_counter_body<2>(space); }),
              HasSubstr("counter_body.axis`: belongs to another shape (cone)"));
  const Scene across =
      scene_of("[counter_body]\nshape = \"plane\"\nmotion = { velocity = [1.0, 0.0] }\n");
  EXPECT_THAT(refused([&] { read_counter_body<3>(across); }),
              HasSubstr("motion.velocity`: expected 3 numbers in space, got 2"));
}

// By hand, in every section that a shape has.
TEST(CounterBodyScene, ShapesInThePlane) {
  const auto gap = [](const std::string& text, Vector<2> x, Section section = Section::plane) {
    return body_of<2>(text, section).shape.at(x).gap;
  };
  EXPECT_DOUBLE_EQ(gap("shape = \"plane\"\ncenter = [0.0, 1.0]\nnormal = [0.0, -2.0]", {3, -1}), 2);
  EXPECT_DOUBLE_EQ(gap("shape = \"cylinder\"\nradius = 20.0\ncenter = [0.0, 20.0]", {0, -1}), 1);
  const std::string cup = "shape = \"ball\"\nradius = 3.0\ncenter = [0.0, 1.0]\nside = \"outside\"";
  EXPECT_DOUBLE_EQ(gap(cup, {0, -1}), 1);
  EXPECT_DOUBLE_EQ(gap(cup, {0, -1}, meridian), 1);
  const std::string rod = "shape = \"cylinder\"\nradius = 2.0\ncenter = [0.0, 5.0]";
  EXPECT_DOUBLE_EQ(gap(rod, {3, 70}, meridian), 1);
  EXPECT_DOUBLE_EQ(gap(rod + "\nside = \"outside\"", {0.5, 70}, meridian), 1.5);
  const std::string ring =
      "shape = \"torus\"\ncenter = [0.0, 1.0]\nmajor_radius = 5.0\nradius = 2.0";
  EXPECT_DOUBLE_EQ(gap(ring, {5, -2}, meridian), 1);
  EXPECT_DOUBLE_EQ(gap(ring + "\nside = \"outside\"", {5, 0.5}, meridian), 1.5);
  const std::string seat =
      "shape = \"cone\"\ncenter = [0.0, -1.0]\naxis = [0.0, 2.0]\nhalf_angle = "
      "60.0\nside = \"outside\"";
  for (const Section section : {Section::plane, meridian}) {
    EXPECT_NEAR(gap(seat, {1, 2}, section), 3 * std::sqrt(0.75) - 0.5, 1e-15);
    EXPECT_NEAR(gap(seat, {0, 2}, section), 3 * std::sqrt(0.75), 1e-15);
  }
  // On the axis a seat has one closest point in the half-plane, a groove in the plane has two.
  EXPECT_TRUE(body_of<2>(seat, meridian).shape.at({0, 2}).unique);
  EXPECT_FALSE(body_of<2>(seat).shape.at({0, 2}).unique);
  const std::string rail = "shape = \"profile\"\npoints = [0.0, 0.0, 1.0, 0.0, 2.0, 0.0]";
  EXPECT_DOUBLE_EQ(gap(rail, {0.4, 3}), -3);  // the body is on the left
  EXPECT_DOUBLE_EQ(gap(rail + "\nside = \"right\"", {7, 3}), 3);
  // A circle by four of its points, run clockwise.
  const std::string cam =
      "shape = \"profile\"\npoints = [1.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, 1.0]\nside = ";
  EXPECT_DOUBLE_EQ(gap(cam + "\"inside\"", {0, 3}), 2);
  EXPECT_DOUBLE_EQ(gap(cam + "\"outside\"", {0, 3}), -2);
}

TEST(CounterBodyScene, ShapesInSpace) {
  const auto gap = [](const std::string& text, Vector<3> x) {
    return body_of<3>(text).shape.at(x).gap;
  };
  EXPECT_DOUBLE_EQ(gap("shape = \"plane\"", {4, 5, 2}), 2);  // by defaults z = 0
  EXPECT_DOUBLE_EQ(gap("shape = \"torus\"\ncenter = [0.0, 0.0, 1.0]\naxis = [0.0, 0.0, 1.0]\n"
                       "major_radius = 5.0\nradius = 2.0",
                       {3, 4, -2}),
                   1);
  const std::string bumps =
      "shape = \"profile\"\npoints = [0.0, 0.0, 1.0, 0.5, 2.0, 0.0]\n"
      "axis = [0.0, 1.0, 0.0]\nside = \"right\"\n";
  EXPECT_DOUBLE_EQ(gap(bumps + "sweep = \"extruded\"", {1, 77, 3}), 2.5);  // in x and z
  const std::string roller =
      "shape = \"profile\"\npoints = [2.0, 5.0, 1.5, 1.0, 2.0, -3.0]\n"
      "axis = [0.0, 1.0, 0.0]\ncenter = [0.0, 3.0, 0.0]\n"
      "sweep = \"revolved\"\nside = \"right\"";
  EXPECT_DOUBLE_EQ(gap(roller, {0, 4, 3}), 1.5);
  EXPECT_THAT(refusal<3>(bumps + "sweep = \"extruded\"\nup = [0.0, -2.0, 0.0]"),
              HasSubstr("not along counter_body.axis"));
}

TEST(CounterBodyScene, SaysWhatIsMissingOrMisplaced) {
  EXPECT_THAT(refusal<2>("shape = \"sphere\""), HasSubstr("shape"));
  EXPECT_THAT(
      refusal<2>("shape = \"ball\"\nradius = 1.0"),
      HasSubstr("scene.toml:5: key `counter_body.shape`: expected also counter_body.center"));
  EXPECT_THAT(
      refusal<2>("shape = \"plane\"\nradius = 1.0"),
      HasSubstr("belongs to another shape (ball); the shape plane has counter_body.center"));
  EXPECT_THAT(refusal<2>("shape = \"ball\"\nradius = 0.0\ncenter = [0.0, 0.0]"),
              HasSubstr("radius"));
  EXPECT_THAT(refusal<3>("shape = \"cylinder\"\nradius = 1.0\ncenter = [0.0, 0.0, 0.0]\n"
                         "axis = [0.0, 0.0, 0.0]"),
              HasSubstr("length zero"));
  const std::string ring = "shape = \"torus\"\nmajor_radius = 1.0\n";
  EXPECT_THAT(refusal<2>(ring + "radius = 1.0\ncenter = [0.0, 0.0]", meridian),
              HasSubstr("cross itself"));
  EXPECT_THAT(refusal<2>(ring + "radius = 0.5\ncenter = [0.0, 0.0]"), HasSubstr("torus"));
  EXPECT_THAT(refusal<2>("shape = \"ball\"\nradius = 1.0\ncenter = [0.1, 0.0]", meridian),
              HasSubstr("point of the axis of symmetry"));
  EXPECT_THAT(refusal<2>("shape = \"plane\"\nnormal = [0.1, 1.0]", meridian), HasSubstr("cone"));
  const std::string cone = "shape = \"cone\"\ncenter = [0.0, 0.0]\naxis = [0.1, 1.0]\n";
  EXPECT_THAT(refusal<2>(cone + "half_angle = 90.0"), HasSubstr("half_angle"));
  EXPECT_THAT(refusal<2>(cone + "half_angle = 45.0", meridian), HasSubstr("axis of symmetry"));
  const std::string curve = "shape = \"profile\"\n";
  EXPECT_THAT(refusal<2>(curve), HasSubstr("expected also counter_body.points"));
  EXPECT_THAT(refusal<2>(curve + "points = [0.0, 0.0, 1.0]"), HasSubstr("got 3 numbers"));
  EXPECT_THAT(refusal<2>(curve + "points = [0.0, 0.0]"),
              HasSubstr("key `counter_body.points`: expected 2 to 10000 different points"));
  EXPECT_THAT(refusal<2>(curve + "points = \"missing.csv\""),
              HasSubstr("missing.csv: expected a file"));
  EXPECT_THAT(refusal<2>("shape = \"ball\"\nradius = 1.0\ncenter = [0.0, 0.0]\nside = \"left\""),
              HasSubstr("expected \"inside\" or \"outside\", got \"left\""));
  EXPECT_THAT(refusal<2>("shape = \"plane\"\nmotion = { velocity = [1.0] }"),
              HasSubstr("expected 2 numbers in the plane, got 1"));
}

// A ring of radius 20 mm that turns: its surface moves with 500 mm/s.
TEST(CounterBodyScene, MotionByPosition) {
  const std::string ring = "shape = \"cylinder\"\nradius = 20.0\ncenter = [0.0, 20.0]\n";
  const auto turning = body_of<2>(ring + "motion = { rotation = 25.0 }");
  EXPECT_NEAR((turning.motion.at<double>({0, 0}) - Vector<2>(500, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((turning.motion.at<double>({20, 20}) - Vector<2>(0, 500)).norm(), 0, 1e-12);
  EXPECT_FALSE(turning.turning);
  EXPECT_DOUBLE_EQ(turning.motion.nominal_speed(Vector<2>::Zero()), 500);
  // It rolls: at rest where it touches.
  const auto rolling = body_of<2>(ring + "motion = { rotation = 25.0, velocity = [-500.0, 0.0] }");
  EXPECT_NEAR(rolling.motion.at<double>({0, 0}).norm(), 0, 1e-12);
  const auto sliding = body_of<2>(ring + "motion = { velocity = [0.0, 0.0, 3.0] }");
  EXPECT_DOUBLE_EQ(sliding.motion.across_at<double>({7, 8}), 3);
  // Axisymmetric: omega r around.
  const std::string ball = "shape = \"ball\"\nradius = 2.0\ncenter = [0.0, 2.0]\n";
  const auto spins =
      body_of<2>(ball + "motion = { rotation = 4.0, velocity = [0.0, 1.0] }", meridian);
  EXPECT_DOUBLE_EQ(spins.motion.across_at<double>({0.5, 0.1}), 2);
  EXPECT_EQ(spins.motion.at<double>({0.5, 0.1}), Vector<2>(0, 1));
  EXPECT_DOUBLE_EQ(spins.motion.nominal_speed(Vector<2>::Zero()), 1);
  // In space about the axis of the shape, or another.
  const std::string pipe =
      "shape = \"cylinder\"\nradius = 2.0\ncenter = [0.0, 9.0, 2.0]\naxis = [0.0, 3.0, 0.0]\n";
  const auto space = body_of<3>(pipe + "motion = { rotation = 10.0 }");
  EXPECT_NEAR((space.motion.at<double>({0, 1, 0}) - Vector<3>(-20, 0, 0)).norm(), 0, 1e-13);
  EXPECT_FALSE(space.turning);
  const auto tilted = body_of<3>(
      pipe + "motion = { rotation = 10.0, axis = [1.0, 0.0, 0.0], center = [5.0, 0.0, 0.0] }");
  EXPECT_NEAR((tilted.motion.at<double>({1, 1, 0}) - Vector<3>(0, 0, 10)).norm(), 0, 1e-13);
  EXPECT_TRUE(tilted.turning);
  EXPECT_THAT(refusal<3>(pipe + "motion = { rotation = 10.0, axis = [1.0, 0.0, 0.0], velocity = "
                                "[1.0, 0.0, 0.0] }"),
              HasSubstr("turns on the spot"));
  EXPECT_THAT(refusal<3>("shape = \"ball\"\nradius = 2.0\ncenter = [0.0, 0.0, 2.0]\n"
                         "motion = { rotation = 10.0 }"),
              HasSubstr("expected also counter_body.motion.axis"));
  EXPECT_THAT(refusal<2>("shape = \"plane\"\nmotion = { rotation = 10.0 }"),
              HasSubstr("expected also counter_body.motion.center"));
  EXPECT_THAT(refusal<2>(ball + "motion = { velocity = [1.0, 0.0] }", meridian),
              HasSubstr("widen"));
}

TEST(CounterBodyScene, PressAndApproach) {
  const std::string ring = "shape = \"cylinder\"\nradius = 20.0\ncenter = [0.0, 20.0]\n";
  const auto pressed = body_of<2>(ring + "press = { direction = [0, -3], force = 10.8333 }");
  EXPECT_EQ(pressed.approach, Vector<2>(0, -1));
  EXPECT_EQ(pressed.guides[0].force, 10.8333);
  const auto moved = body_of<2>(
      ring + "press = { direction = [3, -4], times = [0.0, 2.0], approach = [0.0, 0.1] }");
  EXPECT_FALSE(moved.guides[0].force);
  EXPECT_NEAR((moved.approach - Vector<2>(0.6, -0.8)).norm(), 0, 1e-15);
  EXPECT_DOUBLE_EQ(moved.guides[0].travel->factor(1), 0.05);
  const auto single = body_of<2>(ring + "press = { direction = [0, -1], approach = 0.02 }");
  EXPECT_EQ(single.guides[0].travel->factor(7), 0.02);
  const auto held = body_of<2>(ring + "press = { direction = [0, -1], approach = [0.02] }");
  EXPECT_DOUBLE_EQ(held.guides[0].travel->factor(7), 0.02);
  EXPECT_TRUE(body_of<2>(ring).guides.empty());
  const auto refused = [&](const std::string& press, Section section = Section::plane) {
    return refusal<2>(
        "shape = \"ball\"\nradius = 20.0\ncenter = [0.0, 20.0]\npress = { " + press + " }",
        section);
  };
  EXPECT_THAT(refused("force = 1.0"), HasSubstr("expected also counter_body.press.direction"));
  EXPECT_THAT(refused("direction = [0.0, 0.0], force = 1.0"), HasSubstr("length zero"));
  EXPECT_THAT(refused("direction = [0, 1], force = 1.0, approach = [1.0]"), HasSubstr("got both"));
  EXPECT_THAT(refused("direction = [0, 1], approach = [1.0, 2.0]"),
              HasSubstr("expected one number"));
  EXPECT_THAT(refused("direction = [0, 1], times = [1.0]"), HasSubstr("expected also"));
  EXPECT_THAT(refused("direction = [0, 1], approach = [1.0, 2.0, 3.0], times = [1.0, 1.0, 1.0]"),
              HasSubstr("ascending times, one twice for a jump, got 1 at place 3"));
  EXPECT_THAT(refused("direction = [0.1, 1], force = 1.0", Section::meridian),
              HasSubstr("axis of symmetry"));
}

}  // namespace
}  // namespace gnomon::counter_body_scene_test
