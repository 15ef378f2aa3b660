// The mortar sums of a facet of which partners cover a part: areas, forces, derivatives.
#include <gnomon/terms/mortar_facet.hpp>

#include "support/mortar_facets.hpp"

namespace gnomon::mortar_facet_test {
namespace {

using namespace testing;

MortarFacet<3> facet_of(const FacetPair<3>& pair) {
  return {pair, {pair.y}, {0}, Section::plane, any_distance};
}

/// The unit square, covered by what lies beyond 1 - a in x and 1 - b in y, at a distance of 0.01.
FacetPair<3> covered_beyond(double a, double b) {
  QuadNodes master = turned(unit_square());
  master.rowwise() += Row3(1 - a, 1 - b, 0.01);
  return flat_pair(unit_square(), master);
}

/// Forces and areas are those of what is covered, however little; no corner has a multiplier by an
/// area that is a small part of its neighbours', nor a gap from far away.
TEST(MortarFacet, CornersThatAreHardlyCoveredAreAddedToTheirNeighbours) {
  for (const double t : {1e-3, 0.05, 0.09, 0.3})
    for (const bool is_strip : {true, false}) {
      const MortarFacet<3> facet = facet_of(covered_beyond(t, is_strip ? 1 : t));
      ASSERT_EQ(facet.masters.size(), 1) << t;
      const auto& master = facet.masters.front();
      EXPECT_NEAR(facet.D.sum(), is_strip ? t : t * t, 1e-12);
      EXPECT_LE(largest(master.M.rowwise().sum() - facet.D), 1e-12);
      EXPECT_LE(largest(master.W.rowwise().sum() - facet.D), 1e-12);
      EXPECT_LE(largest(facet.gap - 0.01 * facet.D), 1e-12);
      EXPECT_EQ((facet.D.array() > 0).count(), t > 0.1    ? (is_strip ? 4 : 3)
                                               : is_strip ? 2
                                                          : 1)
          << t;
      if (t < 0.1) EXPECT_LE(largest(master.M), 2 * facet.D.maxCoeff());
    }
}

TEST(MortarFacet, AreasOfAPlaneFacetAreThoseThatAreCovered) {
  for (const double t : {1e-3, 0.05, 0.09, 0.2, 1.0}) {
    FacetPair<2> pair;
    pair.x << 0, 0, 1, 0;
    pair.X = pair.x;
    pair.n << 0, -1, 0, -1;
    pair.y << 2, -0.01, 1 - t, -0.01;
    const MortarFacet<2> facet(pair, {pair.y}, {0}, Section::plane, any_distance);
    ASSERT_EQ(facet.masters.size(), 1) << t;
    EXPECT_NEAR(facet.D.sum(), t, 1e-12);
    EXPECT_NEAR(facet.masters.front().M.sum(), t, 1e-12);
    EXPECT_NEAR(facet.masters.front().W.sum(), t, 1e-12);
    EXPECT_NEAR(facet.gap.sum(), 0.01 * t, 1e-12);
    EXPECT_EQ((facet.D.array() > 0).count(), t > 0.1 ? 2 : 1) << t;
  }
}

/// In the order of the rows of MortarFacetTangent::by_input.
template <int dim>
Eigen::VectorXd values_of(const MortarFacet<dim>& facet) {
  const auto& master = facet.masters.front();
  Eigen::VectorXd result(MortarFacetTangent<dim>::row_of_masters +
                         MortarFacetTangent<dim>::rows_of_master);
  result << facet.D, facet.gap, master.M.reshaped(), master.W.reshaped();
  return result;
}

/// Few or all corners are kept, with the same inputs as those of covered_part().
TEST(MortarFacet, DerivativesAgreeWithDifferences) {
  constexpr double h = 1e-6;
  RandomFacets random;
  std::array<int, 5> seen = {};  // by corners that are kept
  for (int k = 0; k < 600; ++k) {
    FacetPair<3> pair = random_pair(random, 0.1, 0.1, 1.6, k % 2 ? 1 : 0.7);
    const MortarFacetTangent<3> at(pair, {pair.y}, {0}, Section::plane, any_distance);
    if (at.facet.masters.empty() || at.facet.D.sum() < 1e-3) continue;
    const Eigen::VectorXd value = values_of(at.facet);
    const auto kept = (at.facet.D.array() > 0).count();
    Eigen::MatrixXd differences(value.size(), at.by_input.cols());
    bool changes = false;  // which corners are kept
    for (int i = 0; i < differences.cols(); ++i) {
      double& input = mortar_input(pair, i);
      const double given = input;
      std::array<Eigen::VectorXd, 2> side;
      for (const int s : {0, 1}) {
        input = given + (s ? h : -h);
        const MortarFacet<3> moved = facet_of(pair);
        changes |= (moved.D.array() > 0).count() != kept;
        side[s] = values_of(moved);
      }
      input = given;
      differences.col(i) = (side[1] - side[0]) / (2 * h);
    }
    if (changes) continue;
    ++seen[kept];
    EXPECT_LE(largest(at.by_input - differences), 1e-6 * std::max(1.0, largest(differences)))
        << "pair " << k << ", " << kept << " corners";
  }
  for (const int corners : {1, 2, 3, 4}) EXPECT_GE(seen[corners], 5) << corners;
}

}  // namespace
}  // namespace gnomon::mortar_facet_test
