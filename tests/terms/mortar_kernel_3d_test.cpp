// The mortar integrals of facets in space: derivatives, invariance, sums, limits.
#include <map>

#include "support/mortar_facets.hpp"
#include "terms/mortar_integrand.hpp"

namespace gnomon::mortar_kernel_3d_test {
namespace {

using namespace testing;

CoveredPart<3> covered(const FacetPair<3>& pair, double reach = any_distance) {
  return covered_part(pair, Section::plane, reach);
}
CoveredPartTangent<3> tangent(const FacetPair<3>& pair, double reach = any_distance) {
  return covered_part_tangent(pair, Section::plane, reach);
}

TEST(MortarKernel3d, DerivativesAgreeWithDifferences) {
  RandomFacets random;
  std::map<int, int> seen;  // corners of the overlap, pairs
  for (int k = 0; k < 400; ++k) {
    const double size = k % 4 == 0 ? 0.3 : k % 4 == 1 ? 2 : 1;
    const FacetPair<3> pair =
        random_pair(random, k % 3 == 0 ? 0.02 : 0.2, k % 5 == 0 ? 0 : 0.2, k % 7 ? 1.2 : 0.2, size);
    const CoveredPartTangent<3> at = tangent(pair);
    const CoveredPart<3> part = covered(pair);
    EXPECT_LE(largest(mortar_values(at.part) - mortar_values(part)), 1e-15);
    if (part.mass.isZero(0)) continue;
    ++seen[mortar::PairInPlane(pair, any_distance).overlap.corners()];
    EXPECT_LE(largest(at.by_input - mortar_differences(pair)), 1e-8) << "pair " << k;
  }
  for (int corners = 3; corners <= 8; ++corners)
    EXPECT_GE(seen[corners], 5) << corners << " corners";
}

/// At parallelograms the rule and the correction change: not so the derivative.
TEST(MortarKernel3d, DerivativesAtParallelograms) {
  RandomFacets random;
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    FacetPair<3> pair = random_pair(random, 0, 0, 1, 1);
    pair.X = pair.x;
    const CoveredPartTangent<3> at = tangent(pair);
    if (at.part.mass.sum() < 1e-3) continue;
    ++seen;
    EXPECT_LE(largest(at.by_input - mortar_differences(pair)), 1e-7) << "pair " << k;
  }
  EXPECT_GE(seen, 30);
}

TEST(MortarKernel3d, IsInvariantToRigidMotions) {
  RandomFacets random;
  int seen = 0;
  for (int k = 0; k < 100; ++k) {
    const FacetPair<3> pair = random_pair(random, 0.2, 0.2, 1, 1);
    FacetPair<3> moved = pair;
    const Eigen::Matrix3d Q = random.rotation(), Q_undeformed = random.rotation();
    const Row3 shift(random(), random(), random());
    for (QuadNodes* field : {&moved.x, &moved.n, &moved.y})
      *field = (*field * Q.transpose()).eval();
    for (QuadNodes* field : {&moved.x, &moved.y}) field->rowwise() += shift;
    moved.X = ((pair.X * Q_undeformed.transpose()).eval().rowwise() - shift).eval();
    const CoveredPartTangent<3> at = tangent(pair);
    seen += at.part.mass.sum() > 0;
    EXPECT_LE(largest(mortar_values(covered(moved)) - mortar_values(at.part)), 1e-13);
    // The derivatives along such motions vanish.
    for (int i = 0; i < 3; ++i) {
      FacetPair<3> shifted{}, rotated{}, undeformed{};
      for (QuadNodes* field : {&shifted.X, &shifted.x, &shifted.n, &shifted.y, &rotated.X,
                               &undeformed.x, &undeformed.n, &undeformed.y})
        field->setZero();
      shifted.x.col(i).setOnes();
      shifted.y.col(i).setOnes();
      const auto turn = [&](const QuadNodes& field) {
        QuadNodes result;
        for (int a = 0; a < 4; ++a)
          result.row(a) = Vector<3>::Unit(i).cross(field.row(a).transpose()).transpose();
        return result;
      };
      rotated.x = turn(pair.x), rotated.n = turn(pair.n), rotated.y = turn(pair.y);
      undeformed.X = turn(pair.X);
      for (FacetPair<3>* motion : {&shifted, &rotated, &undeformed}) {
        Eigen::VectorXd direction(48);
        for (int j = 0; j < 48; ++j) direction[j] = mortar_input(*motion, j);
        EXPECT_LE(largest(at.by_input * direction), 1e-12);
      }
    }
  }
  EXPECT_GE(seen, 50);
}

TEST(MortarKernel3d, MassAndCouplingTransferTheSame) {
  RandomFacets random;
  int seen = 0;
  for (int k = 0; k < 200; ++k) {
    const FacetPair<3> pair = random_pair(random, 0.25, 0.2, 1.3, k % 2 ? 1 : 0.1);
    const CoveredPart<3> part = covered(pair);
    seen += !part.mass.isZero(0);
    EXPECT_LE(largest((part.mass - part.coupling).rowwise().sum()), 1e-14);
    EXPECT_LE(largest(part.mass - part.mass.transpose()), 0);
    EXPECT_EQ(part.shared, part.coupling);
  }
  EXPECT_GE(seen, 100);
}

TEST(MortarKernel3d, GapOfParallelFacetsIsTheirDistance) {
  RandomFacets random;
  int seen = 0;
  for (int k = 0; k < 100; ++k) {
    FacetPair<3> pair = flat_pair(random.facet(1, 0.3, 0), turned(random.facet(1, 0.3, 0)));
    const double distance = random();
    pair.y.rowwise() += Row3(0.5 * random(), 0.5 * random(), distance);
    const CoveredPart<3> part = covered(pair);
    if (part.mass.isZero(0)) continue;
    ++seen;
    EXPECT_LE(largest(part.gap - distance * part.mass.rowwise().sum()), 1e-14);
    EXPECT_NEAR(part.gap.sum(), distance * mortar::PairInPlane(pair, any_distance).overlap.area(),
                1e-14);
  }
  EXPECT_GE(seen, 90);
}

TEST(MortarKernel3d, MatchingFacetsAreTheWholeFacet) {
  RandomFacets random;
  for (int k = 0; k < 20; ++k) {
    FacetPair<3> pair = random_pair(random, k % 2 ? 0.2 : 0, k % 4 ? 0.2 : 0, 0, 1);
    pair.y = turned(pair.x);
    const CoveredPartTangent<3> at = tangent(pair);
    EXPECT_TRUE(at.by_input.allFinite());
    for (int b = 0; b < 4; ++b)
      EXPECT_LE(largest(at.part.coupling.col((4 - b) % 4) - at.part.mass.col(b)), 1e-14);
    EXPECT_LE(largest(at.part.gap), 1e-14);
    EXPECT_GT(at.part.mass.sum(), 1);
    EXPECT_LE(largest(at.by_input.topRightCorner<16, 12>()), 1e-14);
    // Without a gap the normals do not matter.
    EXPECT_LE(largest(at.by_input.bottomRows<4>().middleCols<12>(24)), 1e-13);
  }
}

TEST(MortarKernel3d, SliversAreTheirWidth) {
  const QuadNodes square = unit_square();
  for (double width = 0.1; width > 2e-12; width /= 10) {
    FacetPair<3> pair = flat_pair(square, turned(square));
    pair.y.col(0).array() += 1 - width;
    const CoveredPartTangent<3> at = tangent(pair);
    EXPECT_NEAR(at.part.mass.sum(), width, 1e-15);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(48);
    for (int b = 0; b < 4; ++b) shift[36 + 3 * b] = 1;
    EXPECT_NEAR((at.by_input.topRows<16>() * shift).sum(), -1, 1e-9);
    EXPECT_TRUE(at.by_input.allFinite());
  }
}

TEST(MortarKernel3d, IsEmptyWithoutAPartner) {
  const QuadNodes square = unit_square();
  const auto is_empty = [&](const Row3& shift, bool facing, double reach) {
    FacetPair<3> pair = flat_pair(square, facing ? turned(square) : square);
    pair.y.rowwise() += shift;
    const CoveredPartTangent<3> at = tangent(pair, reach);
    EXPECT_EQ(mortar_values(at.part), mortar_values(covered(pair, reach)));
    EXPECT_EQ(mortar_values(at.part).isZero(0), at.by_input.isZero(0));
    return mortar_values(at.part).isZero(0);
  };
  EXPECT_FALSE(is_empty(Row3(0.5, 0.5, 0.1), true, 0.2));
  EXPECT_FALSE(is_empty(Row3(0.5, 0.5, -0.1), true, 0.2));
  EXPECT_TRUE(is_empty(Row3(0.5, 0.5, 0.1), false, 0.2));  // faces away
  EXPECT_TRUE(is_empty(Row3(0.5, 0.5, 0.3), true, 0.2));   // beyond reach
  EXPECT_TRUE(is_empty(Row3(0.5, 0.5, -0.3), true, 0.2));
  EXPECT_TRUE(is_empty(Row3(0.5, 0.5, 30), true, 0.2));
  EXPECT_TRUE(is_empty(Row3(1.1, 0.5, 0), true, 0.2));  // beside
  EXPECT_TRUE(is_empty(Row3(20, 0.5, 0), true, 0.2));
  EXPECT_TRUE(is_empty(Row3(1, 0, 0), true, 0.2));    // a common edge
  EXPECT_TRUE(is_empty(Row3(1, 1, 0), true, 0.2));    // a common corner
  EXPECT_TRUE(is_empty(Row3(1, 0.5, 0), true, 0.2));  // a part of an edge
}

TEST(MortarKernel3d, DegenerateFacetsAreEmpty) {
  const QuadNodes square = unit_square();
  FacetPair<3> pair = flat_pair(square, turned(square));
  pair.y.col(1).setZero();  // a line
  EXPECT_TRUE(mortar_values(tangent(pair).part).isZero(0));
  pair.y.setZero();  // a point
  EXPECT_TRUE(mortar_values(tangent(pair).part).isZero(0));
  pair.y = turned(square);
  pair.n.setZero();
  EXPECT_TRUE(mortar_values(tangent(pair).part).isZero(0));
  pair = flat_pair(square, turned(square));
  pair.x.setZero();
  EXPECT_TRUE(mortar_values(tangent(pair).part).isZero(0));
  pair = flat_pair(square, turned(square));
  pair.X.setZero();  // no area
  EXPECT_TRUE(mortar_values(tangent(pair).part).isZero(0));
  EXPECT_TRUE(tangent(pair).by_input.allFinite());
}

}  // namespace
}  // namespace gnomon::mortar_kernel_3d_test
