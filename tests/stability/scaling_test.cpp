// Eq. (17): the critical step is proportional to facet length / Young's modulus.

#include <fmt/format.h>

#include <cmath>
#include <gnomon/stability/stability.hpp>

#include "support/pin.hpp"

namespace gnomon::scaling_test {
namespace {

using namespace testing;

/// c in |lambda|_max = c k v E* / h, with h the facet length, on a worn pin.
double constant(const std::string& element, int n, double young) {
  constexpr double nu = 0.3, k_v = 1e-4, width = 10;
  const PinRun pin = run_pin(
      "backward-euler", 50, 0, 200,
      {elements(n), "body.element=" + element, "body.young_modulus=" + std::to_string(young)});
  const ReducedJacobian G(pin.model->system(), pin.last());
  const std::complex<double> eigenvalue = leading_modes(G, 4).front().eigenvalue;
  EXPECT_LT(eigenvalue.real(), 0);
  const double facet = width / n, reduced_modulus = young / (1 - nu * nu);
  return std::abs(eigenvalue) * facet / (k_v * reduced_modulus);
}

struct Expected {
  const char* element;
  double constant;  // docs/notes/stability.md
};

class Scaling : public ::testing::TestWithParam<Expected> {};

TEST_P(Scaling, IsThatOfFacetLengthOverModulus) {
  const auto& [element, expected] = GetParam();
  const double half_stiff = constant(element, 20, 320), stiff = constant(element, 20, 640);
  const double coarse = constant(element, 10, 640), fine = constant(element, 40, 640);
  RecordProperty("at_10_20_40_elements", fmt::format("{:.4f} {:.4f} {:.4f}", coarse, stiff, fine));
  EXPECT_NEAR(half_stiff / stiff, 1, 0.05);
  EXPECT_NEAR(coarse / stiff, 1, 0.1);
  EXPECT_NEAR(fine / stiff, 1, 0.1);
  EXPECT_NEAR(stiff, expected, 0.05 * expected);
}

INSTANTIATE_TEST_SUITE_P(Elements, Scaling,
                         ::testing::Values(Expected{"plain", 0.83}, Expected{"f-bar", 0.60},
                                           Expected{"f-bar-variational", 0.60}),
                         [](const auto& info) {
                           std::string name = info.param.element;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace gnomon::scaling_test
