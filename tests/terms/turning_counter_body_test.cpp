// The sliding speed of nodes about which the counter-body turns.

#include <cmath>
#include <gnomon/terms/contact_node.hpp>
#include <numbers>

#include "support/derivatives.hpp"

namespace gnomon::turning_counter_body_test {
namespace {

using std::numbers::pi;

/// n segments from the axis of revolution to r = 1.
Mesh<2> disc(int n) {
  Mesh<2> mesh;
  for (int i = 0; i <= n; ++i) mesh.nodes.push_back({double(i) / n, 0});
  for (int i = 0; i < n; ++i) mesh.boundary["surface"].push_back({i, i + 1});
  return mesh;
}

/// n x n parallelograms about the origin, with the edges a and b.
Mesh<3> sheet(int n, const Vector<3>& a, const Vector<3>& b) {
  Mesh<3> mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.nodes.push_back((double(i) / n - 0.5) * a + (double(j) / n - 0.5) * b);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int first = j * (n + 1) + i;
      mesh.boundary["surface"].push_back({first, first + 1, first + n + 2, first + n + 1});
    }
  return mesh;
}

template <int dim>
std::vector<ContactPatch<dim>> patches_of(const Mesh<dim>& mesh, Section section = Section::plane) {
  return contact_patches<dim>(mesh, mesh.boundary.at("surface"), {}, section);
}

template <int dim>
double speed(const ContactPatch<dim>& patch, const RigidMotion<dim>& motion) {
  const Vector<dim>& x = patch.initial_position;
  return Sliding<dim>(-motion.at(x), patch.initial_normal, motion.across_at(x),
                      velocity_variance<dim>(patch, motion.spin, motion.across_by_x))
      .speed;
}

/// The load under which all of the surface wears by 1, when the rate is p v.
template <int dim>
double load_of_even_wear(const std::vector<ContactPatch<dim>>& patches,
                         const RigidMotion<dim>& motion) {
  double sum = 0;
  for (const auto& patch : patches) sum += patch.initial_area / speed(patch, motion);
  return sum;
}

RigidMotion<2> about_the_axis(double omega) {
  RigidMotion<2> motion;
  motion.across_by_x = {omega, 0};
  return motion;
}

// With the shape function 1 - s of a segment of length L, s the distance by L: the integral of
// s^2 (1 - s) by that of (1 - s) is 1/6, that of s^3 (1 - s) by that of s (1 - s) is 3/10. In two
// directions of a sheet, each has 1/6.
TEST(TurningCounterBody, SpreadOfTheSharesByHand) {
  const auto plane = patches_of<2>(disc(4)), turned = patches_of<2>(disc(4), Section::meridian);
  const Tensor<2> along = Vector<2>::UnitX() * Vector<2>::UnitX().transpose() / 16;
  EXPECT_NEAR((plane[0].initial_spread - along / 6).norm(), 0, 1e-16);
  EXPECT_NEAR((plane[2].initial_spread - along / 6).norm(), 0, 1e-16);
  EXPECT_NEAR((turned[0].initial_spread - 0.3 * along).norm(), 0, 1e-16);
  const Vector<3> a(1, 0.2, 0.3), b(-0.1, 0.8, 0);
  for (const auto& patch : patches_of<3>(sheet(2, 2 * a, 2 * b)))
    if (patch.corners.size() == 4) {
      EXPECT_NEAR((patch.initial_spread - (a * a.transpose() + b * b.transpose()) / 6).norm(), 0,
                  1e-15);
    }
}

// Spins that move the surface along its normal only, and translations, have one speed.
TEST(TurningCounterBody, OnlySlidingThatDiffersCounts) {
  const auto patches = patches_of<3>(sheet(2, {1, 0, 0}, {0, 1, 0}));
  for (const auto& patch : patches) {
    RigidMotion<3> motion = rigid_motion<3>({3, 4, 0}, spin_about({1, 1, 0}, 5), {0, 0, 0});
    EXPECT_NEAR(velocity_variance<3>(patch, motion.spin, motion.across_by_x), 0, 1e-14);
    EXPECT_NEAR(speed(patch, motion), 5, 1e-12);
    motion.spin = spin_about({0, 0, 1}, 5);
    EXPECT_GT(velocity_variance<3>(patch, motion.spin, motion.across_by_x), 0.1);
  }
}

// F = (1/omega) times the integral of 1/r over the surface: 2 pi on a disc of radius 1, and
// 4 asinh(1) on a square of side 1, whether a node lies in its middle or not (even and odd n). With
// |v| at the node alone a node in the middle would carry any load. The error is of first order,
// because the speed agrees with the harmonic mean over the share on the axis only.
TEST(TurningCounterBody, AnEvenlyWornDiscCarriesItsLoad) {
  for (int n : {5, 20, 80})
    EXPECT_NEAR(load_of_even_wear<2>(patches_of<2>(disc(n), Section::meridian), about_the_axis(3)) /
                    (2 * pi / 3),
                1, 0.07 / n);
}

TEST(TurningCounterBody, AnEvenlyWornSquareCarriesItsLoad) {
  RigidMotion<3> motion;
  motion.spin = spin_about({0, 0, 1}, 3);
  const double expected = 4 * std::asinh(1.0) / 3;
  for (int n : {4, 5, 16, 17, 64, 65})
    EXPECT_NEAR(
        load_of_even_wear<3>(patches_of<3>(sheet(n, {1, 0, 0}, {0, 1, 0})), motion) / expected, 1,
        0.8 / n)
        << n;
}

}  // namespace
}  // namespace gnomon::turning_counter_body_test
