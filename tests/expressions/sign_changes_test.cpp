// Times at which functions of time change sign.

#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/expressions/sign_changes.hpp>

namespace gnomon::sign_changes_test {
namespace {

std::vector<double> of(const std::function<double(double)>& f, double end = 1000) {
  return sign_changes([&](double t, std::span<double> values) { values[0] = f(t); }, 1, {0}, end);
}

TEST(SignChanges, AreFoundToTheLastDigit) {
  const std::vector<double> times = of([](double t) { return t - 437.123; });
  ASSERT_EQ(times.size(), 1u);
  EXPECT_DOUBLE_EQ(times[0], 437.123);
  EXPECT_TRUE(of([](double t) { return t + 1; }).empty());
  EXPECT_TRUE(of([](double) { return 1; }).empty());
}

TEST(SignChanges, OfShortWindowsAreFound) {
  // Between two samples, which are half a second apart.
  const std::vector<double> smooth = of([](double t) { return (t - 120.3) * (t - 120.3) - 1e-4; });
  ASSERT_EQ(smooth.size(), 2u);
  EXPECT_NEAR(smooth[0], 120.29, 1e-9);
  EXPECT_NEAR(smooth[1], 120.31, 1e-9);
  const std::vector<double> kinked = of([](double t) { return std::abs(t - 7.77) - 1e-3; });
  ASSERT_EQ(kinked.size(), 2u);
  EXPECT_NEAR(kinked[1] - kinked[0], 2e-3, 1e-9);
}

TEST(SignChanges, OfSeveralFunctionsAreSortedAndOnce) {
  const auto functions = [](double t, std::span<double> values) {
    values[0] = t - 3, values[1] = t - 1, values[2] = 3 - t, values[3] = t - 2;
  };
  EXPECT_EQ(sign_changes(functions, 4, {0, 1, 2}, 10), (std::vector<double>{1, 3}));
}

}  // namespace
}  // namespace gnomon::sign_changes_test
