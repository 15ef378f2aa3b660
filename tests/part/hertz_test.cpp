// Contact analyses in space against Hertz: point, ellipse and ring, on meshes from Gmsh.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "part/part_scene.hpp"
#include "support/hertz_ellipse.hpp"

namespace gnomon::hertz_test {
namespace {

using namespace testing;

constexpr double young = 210e3, poisson = 0.3;

class Hertz : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }

  static ContactSurface contact(const std::filesystem::path& scene, double factor) {
    const auto model =
        make_model(load_scene(scene, {fmt::format("mesh.factor={}", factor)}, key_table));
    Counters counters;
    return model->contact(model->start(counters)).value();
  }
};

using Pressure = std::function<double(const std::array<double, 3>&)>;

/// Difference of the pressures, by the pressures: of their widths and of their heights alike. Most
/// of it is at the edge, where they fall like a root, and where a node is in contact or not: it is
/// of the order of the elements' size, and the bounds below halve with it.
double difference(const ContactSurface& surface, const Pressure& expected) {
  double sum = 0, whole = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double p = expected(surface.initial[c]);
    sum += std::abs(surface.pressure[c] - p);
    whole += p;
  }
  return sum / whole;
}

double peak(const ContactSurface& surface) {
  return std::ranges::max(surface.pressure);
}

// Both bodies are elastic in the scene, so its modulus is half of theirs.
TEST_F(Hertz, BallOnFlat) {
  const HertzEllipse hertz(10.39, 0.01, 0.01, young / 2 / (1 - poisson * poisson));
  const SceneFolder folder;
  folder.write("ball_cap.geo", "elements = 6; patch_x = 0.2; width = 2; height = 2;\n" +
                                   text_of(shipped("ball_cap.geo")));
  const auto scene = folder.write("pin_on_disc.toml", text_of(shipped("pin_on_disc.toml")));
  for (const double factor : {1.0, 0.5}) {
    const auto surface = contact(scene, factor);
    const auto expected = [&](const auto& X) { return hertz.pressure(X[0], X[1]); };
    EXPECT_LT(difference(surface, expected), 0.06 * factor);
    EXPECT_NEAR(peak(surface) / hertz.peak_pressure, 1, 0.02 * factor);
  }
}

TEST_F(Hertz, BallInAGroove) {
  const double ball = 1.0 / 5, groove = 1.0 / 6, ring = 1.0 / 21;
  const HertzEllipse hertz(100, (ball - groove) / 2, (ball - ring) / 2,
                           young / (1 - poisson * poisson));
  for (const double factor : {2.0, 1.0}) {
    const auto surface = contact(shipped("ball_in_groove.toml"), factor);
    const auto expected = [&](const auto& X) { return hertz.pressure(X[1], X[0]); };
    EXPECT_LT(difference(surface, expected), 0.04 * factor);
    EXPECT_NEAR(peak(surface) / hertz.peak_pressure, 1, 0.01);
  }
}

// A line contact bent to a ring, whose radius is 40 times its half width. By 0.02 of this the
// contact is nearer to the tip than where the ball first touches.
TEST_F(Hertz, BallInASeat) {
  const double R = 5, angle = std::numbers::pi / 4, ring = R * std::cos(angle);
  const double modulus = young / (1 - poisson * poisson);
  const double line = 4 * 1000 / (2 * std::numbers::pi * ring * std::sin(angle));  // N/mm
  const double half_width = std::sqrt(4 * line * R / (std::numbers::pi * modulus));
  const double highest = 2 * line / (std::numbers::pi * half_width);
  for (const double factor : {2.0, 1.0}) {
    const auto surface = contact(shipped("ball_in_seat.toml"), factor);
    const auto expected = [&](const auto& X) {
      const double along = std::hypot(X[0], X[1], X[2]) - R / std::tan(angle);
      return highest * std::sqrt(std::max(0.0, 1 - std::pow(along / half_width, 2)));
    };
    EXPECT_LT(difference(surface, expected), 0.04 * factor);
    EXPECT_NEAR(peak(surface) / highest, 1, 0.03 * factor);
  }
}

}  // namespace
}  // namespace gnomon::hertz_test
