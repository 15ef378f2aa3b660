// Whole runs on counter-bodies that can be described in two ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/profile.hpp>

#include "support/pressed_block.hpp"
#include "support/problem_run.hpp"

namespace gnomon::counter_shapes_test {
namespace {

using namespace testing;

SplineCurve circle(int points, double radius) {
  std::vector<Vector<2>> on_circle;
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * M_PI * (k + 0.5) / points;
    on_circle.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return {on_circle, true};
}

struct Outcome {
  std::vector<double> pressure, depth;
};

/// The block, held at the top, pressed by the counter-body from below, and worn.
Outcome run_on(const CounterShape<3>& shape) {
  PressedBlock block;
  block.across = block.high = 4;
  auto body = pressed_block(block);
  body.loads.clear();
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node)
    if (body.mesh.nodes[node][2] > block.size - 1e-9)
      body.supports.held(static_cast<Eigen::Index>(node), 2) = 1;
  body.interface.force = block.force;
  body.interface.partner.guide();
  body.interface.partner.shape = shape;
  const WearModel<3> model(body);
  const ModelRun run = run_model(model, "esdirk-3", 100, 1e-4, 300);
  const ContactSurface surface = model.contact(run.last()).value();
  return {surface.pressure, surface.wear_depth};
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most / largest(b);
}

// A ball by the meridian through points of its circle: the closer they are, the more it is a ball.
TEST(CounterShapes, ABallOfAProfileIsABall) {
  const Vector<3> centre(0, 0, -10), up(0, 0, 1);
  const Outcome ball_itself = run_on(ball<3>(centre, 10));
  ASSERT_GT(largest(ball_itself.depth), 1e-3);
  const auto error = [&](int points) {
    const Outcome by_profile = run_on(revolved(profile(circle(points, 10)), centre, up));
    return std::max(difference(by_profile.pressure, ball_itself.pressure),
                    difference(by_profile.depth, ball_itself.depth));
  };
  const double coarse = error(64), fine = error(256);
  EXPECT_GT(coarse, 1e-9);  // it is another shape
  EXPECT_LT(fine, 1e-4);
  EXPECT_LT(fine, coarse / 8);  // at least of order 1.5: curvature and place converge together
}

// A plane by a straight profile, moved along an oblique axis: the same to rounding.
TEST(CounterShapes, APlaneOfAProfileIsAPlane) {
  const Outcome flat = run_on(plane<3>({0, 0, 0}, {0, 0, 1}));
  Tensor<3> frame;
  frame << Vector<3>(0.6, 0.8, 0), Vector<3>(0, 0, 1), Vector<3>(-0.8, 0.6, 0);
  const SplineCurve line({{3, 0}, {1, 0}, {-2, 0}}, false);
  const Outcome by_profile = run_on(extruded(profile(line), {0.3, 0.2, 0}, frame));
  EXPECT_LT(difference(by_profile.pressure, flat.pressure), 1e-9);
  EXPECT_LT(difference(by_profile.depth, flat.depth), 1e-9);
}

}  // namespace
}  // namespace gnomon::counter_shapes_test
