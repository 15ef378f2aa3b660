#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/grid_lines.hpp>

namespace gnomon::grid_lines_test {
namespace {

std::vector<double> sizes(const std::vector<double>& lines) {
  std::vector<double> result;
  for (std::size_t k = 1; k < lines.size(); ++k) result.push_back(lines[k] - lines[k - 1]);
  return result;
}

TEST(GradedGridLines, AreUniformThenGrowByOneRatio) {
  const std::vector<double> lines = graded_grid_lines(0.1, 0.5, 4, 12);
  ASSERT_EQ(lines.size(), 13u);
  EXPECT_EQ(lines.front(), 0);
  EXPECT_EQ(lines[5], 0.5);
  EXPECT_EQ(lines.back(), 4);
  const std::vector<double> h = sizes(lines);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(h[k], 0.1, 1e-15);
  const double ratio = h[5] / 0.1;
  EXPECT_GT(ratio, 1);
  for (int k = 6; k < 12; ++k) EXPECT_NEAR(h[k] / h[k - 1], ratio, 1e-12);
}

// 1 = 0.1 (q + q^2 + q^3) has no simple root, but 14 = 1 (2 + 4 + 8) has.
TEST(GradedGridLines, SolveForTheRatio) {
  const std::vector<double> expected = {0, 1, 2, 4, 8, 16};
  const std::vector<double> lines = graded_grid_lines(1, 2, 16, 5);
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(lines[k], expected[k], 1e-12);
}

TEST(GradedGridLines, ShrinkWhereTheFineSizeIsTooLargeAndFitItToTheFineLength) {
  const std::vector<double> h = sizes(graded_grid_lines(0.3, 1, 1.5, 7));  // 3 elements of 1/3
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(h[k], 1.0 / 3, 1e-15);
  for (int k = 3; k < 7; ++k) EXPECT_LT(h[k], h[k - 1]);
}

TEST(GradedGridLines, ByGrowthTakeTheFewestElements) {
  const std::vector<double> h = sizes(graded_grid_lines_by_growth(0.1, 0.5, 4, 1.3));
  EXPECT_LE(h.back() / h[h.size() - 2], 1.3);
  const std::vector<double> fewer =
      sizes(graded_grid_lines(0.1, 0.5, 4, static_cast<int>(h.size()) - 1));
  EXPECT_GT(fewer.back() / fewer[fewer.size() - 2], 1.3);
  EXPECT_EQ(graded_grid_lines_by_growth(1, 2, 16, 2).size(), 6u);
}

TEST(GradedGridLines, MayBeUniformThroughout) {
  EXPECT_EQ(graded_grid_lines(0.5, 2, 2, 4), (std::vector<double>{0, 0.5, 1, 1.5, 2}));
}

TEST(GradedGridLines, RefuseWhatCannotBe) {
  EXPECT_THROW(graded_grid_lines(0.1, 2, 1, 10), InputError);
  EXPECT_THROW(graded_grid_lines(0.1, 0.5, 1, 5), InputError);
  EXPECT_THROW(graded_grid_lines(0.5, 2, 2, 5), InputError);
  EXPECT_THROW(graded_grid_lines(0, 0, 1, 5), InputError);
  EXPECT_THROW(graded_grid_lines_by_growth(0.1, 0.5, 1, 1), InputError);
}

// Without a bound, the first two would be counted in an int that is too small, and the third for
// days.
TEST(GradedGridLines, RefuseWhatNoMeshCanHold) {
  EXPECT_THROW(graded_grid_lines(1e-9, 4.294967297, 5, 10), InputError);  // 2^32 + 1 elements
  EXPECT_THROW(graded_grid_lines_by_growth(1e-300, 0.5, 1, 2), InputError);
  EXPECT_THROW(graded_grid_lines_by_growth(1e-9, 0, 1, 1 + 1e-12), InputError);
  EXPECT_THROW(graded_grid_lines(1e-320, 0, 1, 5), InputError);
}

TEST(TwoSidedGridLines, ShareTheOrigin) {
  EXPECT_EQ(two_sided_grid_lines({0, 1, 3}, {0, 2}), (std::vector<double>{-3, -1, 0, 2}));
}

}  // namespace
}  // namespace gnomon::grid_lines_test
