// The motion of a rigid body by a twist is its exponential.
#include <gtest/gtest.h>

#include <cmath>

#include "model/rigid_parts.hpp"

namespace gnomon::rigid_motion_test {
namespace {

template <typename Dimension>
class RigidMotion : public ::testing::Test {};

using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RigidMotion, Dimensions);

TYPED_TEST(RigidMotion, OfATwistIsManySmallOnesAfterEachOther) {
  constexpr int dim = TypeParam::value;
  const Vector<dim> centre = Vector<dim>::Constant(0.3);
  constexpr double size = 0.7;
  for (const double length : {1e-6, 1e-3, 0.5, 3.0}) {
    const Twist<dim> twist = length * Twist<dim>::LinSpaced(-0.4, 1);
    const auto whole = moved_by<dim>(twist, centre, size);
    // 2^20 steps of first order, whose error is that of the square of a step.
    auto part = whole;
    part.setIdentity();
    const Twist<dim> step = std::ldexp(1, -20) * twist;
    for (int i = 0; i < dim; ++i)
      part.linear().col(i) += (rigid_velocities<dim>(Vector<dim>::Unit(i), centre, size) -
                               rigid_velocities<dim>(Vector<dim>::Zero(), centre, size)) *
                              step;
    part.translation() = rigid_velocities<dim>(Vector<dim>::Zero(), centre, size) * step;
    for (int doubling = 0; doubling < 20; ++doubling) part = part * part;
    EXPECT_LT((whole.matrix() - part.matrix()).norm(), 1e-5 * length * length + 1e-7 * length);
    EXPECT_LT((whole.linear() * whole.linear().transpose() - Tensor<dim>::Identity()).norm(),
              1e-14);
  }
}

}  // namespace
}  // namespace gnomon::rigid_motion_test
