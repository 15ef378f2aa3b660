// Contacts with closed forms by Hertz, in the plane and of revolution, on meshes of falling size.
//
// Facets of length h end the contact somewhere within a facet, where Hertz's pressure rises as the
// square root of the distance from the edge: there the nodal pressure is off by p0 (2 h/a)^(1/2),
// on a share h/a of the contact, so that its root mean square is off by some h/a. So is the force
// that the edge carries, h/a (2 h/a)^(1/2), and with it the half width. The tolerances are these,
// and therefore fall with the mesh.

#include <cmath>
#include <numbers>

#include "part/part_scene.hpp"

namespace gnomon::hertz_plane_test {
namespace {

using namespace testing;
using std::numbers::pi;

enum class Contact { line, point };

struct HertzCase {
  std::string scene;
  Contact contact;
  double load;    ///< line: per length; point: force
  double radius;  ///< that of both bodies together
  double facet;   ///< on the mesh as it is shipped
  double theory;  ///< share of Hertz's numbers that his theory neglects here, of the order a/R
};

constexpr double modulus = 210e3 / (1 - 0.3 * 0.3);

double half_width(const HertzCase& hertz) {
  return hertz.contact == Contact::line ? std::sqrt(4 * hertz.load * hertz.radius / (pi * modulus))
                                        : std::cbrt(0.75 * hertz.load * hertz.radius / modulus);
}

double largest_pressure(const HertzCase& hertz) {
  const double a = half_width(hertz);
  return hertz.contact == Contact::line ? 2 * hertz.load / (pi * a)
                                        : 1.5 * hertz.load / (pi * a * a);
}

/// Sums over the surface, by the trapezoidal rule along it.
struct SurfaceSums {
  std::vector<double> s, weight, pressure;  // one for each node, in order

  SurfaceSums(const ContactSurface& surface, Contact contact) : pressure(surface.pressure) {
    const std::size_t count = surface.worn.size();
    weight.resize(count);
    s.push_back(0);
    for (std::size_t c = 1; c < count; ++c) {
      const double length = std::hypot(surface.worn[c][0] - surface.worn[c - 1][0],
                                       surface.worn[c][1] - surface.worn[c - 1][1]);
      s.push_back(s.back() + length);
      for (std::size_t k : {c - 1, c})
        weight[k] += length / 2 * (contact == Contact::point ? surface.worn[k][0] : 1);
    }
    double middle = 0;
    if (contact == Contact::line)
      middle = moment([](double x) { return x; }) / moment([](double) { return 1; });
    if (contact == Contact::point && surface.worn.front()[0] > surface.worn.back()[0])
      middle = s.back();
    for (double& x : s) x -= middle;
  }
  template <class Function>
  double moment(Function f) const {
    double sum = 0;
    for (std::size_t c = 0; c < s.size(); ++c) sum += weight[c] * pressure[c] * f(s[c]);
    return sum;
  }
};

struct HertzErrors {
  double half_width, pressure, largest;  // relative
};

/// The half width is that of the second moment of the pressures: a^2 = 4 <x^2>, 5/2 <r^2>.
HertzErrors errors_of(const HertzCase& hertz, double factor) {
  const auto model =
      model_of("worn_body/" + hertz.scene + ".toml", {"mesh.factor=" + std::to_string(factor)});
  Counters counters;
  const SurfaceSums sums(model->contact(model->start(counters)).value(), hertz.contact);
  const double a = half_width(hertz), p0 = largest_pressure(hertz);
  const double mean_square =
      sums.moment([](double x) { return x * x; }) / sums.moment([](double) { return 1; });
  double error = 0, area = 0;
  for (std::size_t c = 0; c < sums.s.size(); ++c) {
    if (std::abs(sums.s[c]) > 1.2 * a) continue;
    const double expected = p0 * std::sqrt(std::max(0.0, 1 - std::pow(sums.s[c] / a, 2)));
    error += sums.weight[c] * std::pow(sums.pressure[c] - expected, 2);
    area += sums.weight[c];
  }
  return {std::sqrt((hertz.contact == Contact::line ? 4 : 2.5) * mean_square) / a - 1,
          std::sqrt(error / area) / p0, std::ranges::max(sums.pressure) / p0 - 1};
}

class PlaneHertz : public ::testing::TestWithParam<HertzCase> {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
};

TEST_P(PlaneHertz, PressureAndWidthAreThoseOfTheClosedForm) {
  const double a = half_width(GetParam());
  std::vector<HertzErrors> errors;
  for (double factor : {2.0, 1.0, 0.5}) {
    const HertzErrors error = errors_of(GetParam(), factor);
    const double facet = factor * GetParam().facet / a, theory = GetParam().theory;
    EXPECT_LT(error.pressure, 0.5 * facet + theory) << "mesh.factor " << factor;
    EXPECT_LT(std::abs(error.half_width), 0.3 * facet * std::sqrt(2 * facet) + theory)
        << "mesh.factor " << factor;
    EXPECT_LT(std::abs(error.largest), 0.3 * facet * std::sqrt(2 * facet) + theory)
        << "mesh.factor " << factor;
    errors.push_back(error);
  }
  EXPECT_LT(errors[2].pressure, errors[0].pressure);
  EXPECT_LT(std::abs(errors[2].half_width), std::abs(errors[0].half_width));
}

INSTANTIATE_TEST_SUITE_P(
    Shipped, PlaneHertz,
    ::testing::Values(HertzCase{"hertz_cylinder", Contact::line, 113.26, 100, 0.02, 0.0025},
                      HertzCase{"hertz_ball_axisymmetric", Contact::point, 48.077, 100, 0.02,
                                0.0025},
                      // 45 degrees: the contact is a circle of R cos 45, along which F is P sin 45
                      HertzCase{"ball_in_seat_axisymmetric", Contact::line,
                                12811 / (2 * pi * 10 * 0.5), 10, 0.015, 0.003},
                      HertzCase{"ring_in_groove_axisymmetric", Contact::line,
                                25623 / (2 * pi * 100), 100, 0.015, 0.003}),
    [](const auto& info) { return info.param.scene; });

}  // namespace
}  // namespace gnomon::hertz_plane_test
