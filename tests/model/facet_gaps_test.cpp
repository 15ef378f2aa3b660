// Gaps between facets that need not touch: less than zero where bodies lie in each other.
#include "model/facet_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::facet_gaps_test {
namespace {

/// A facet of the slave at y = 0, which looks down, and one of the master at y = -gap.
std::array<double, 2> gaps_at(double gap, const std::array<double, 2>& range) {
  const std::vector<Vector<2>> x = {{0, 0}, {1, 0}, {1.2, -gap}, {0.2, -gap}};
  const std::vector<Mesh<2>::Facet> slave = {{0, 1}}, master = {{2, 3}};
  const FacetGaps gaps = facet_gaps<2>(slave, master, x, Section::plane, range);
  return {gaps[0].front(), gaps[1].front()};
}

TEST(FacetGaps, AreThoseInTheRange) {
  for (const double gap : {0.05, -0.05})
    for (const double found : gaps_at(gap, {-0.1, 0.1})) EXPECT_NEAR(found, gap, 1e-12);
  for (const double found : gaps_at(-0.05, {-0.1, 0})) EXPECT_NEAR(found, -0.05, 1e-12);
  for (const double gap : {0.05, -0.2})
    for (const double found : gaps_at(gap, {-0.1, 0})) EXPECT_TRUE(std::isinf(found)) << gap;
}

TEST(FacetGaps, AreThoseInSpace) {
  const std::vector<Vector<3>> x = {{0, 0, 0},    {0, 1, 0},    {1, 1, 0},    {1, 0, 0},
                                    {0, 0, 0.05}, {1, 0, 0.05}, {1, 1, 0.05}, {0, 1, 0.05}};
  const std::vector<Mesh<3>::Facet> slave = {{0, 1, 2, 3}}, master = {{4, 5, 6, 7}};
  const FacetGaps gaps = facet_gaps<3>(slave, master, x, Section::plane, {-0.1, 0});
  EXPECT_NEAR(gaps[0].front(), -0.05, 1e-12);
  EXPECT_NEAR(gaps[1].front(), -0.05, 1e-12);
}

}  // namespace
}  // namespace gnomon::facet_gaps_test
