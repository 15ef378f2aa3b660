// Facets are chords of the circles that they stand for.
#include "mesh/round_facets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/hexahedra.hpp"
#include "support/imported.hpp"

namespace gnomon::round_facets_test {
namespace {

using namespace testing;

double radius_of(const ImportedMesh& mesh, const RoundFacet& facet) {
  const auto& X = mesh.nodes[static_cast<std::size_t>(facet.nodes[0])];
  return std::hypot(X[0], X[1]);
}

/// Expects facets of half the angle `half` on radii 1 and 2 alone, the outer ones of which lie
/// inside: `part` of the sagitta in the mean.
void expect_chords(const ImportedMesh& mesh, std::size_t count, double half, double part,
                   double tolerance) {
  const std::vector<RoundFacet> facets = round_facets(mesh);
  EXPECT_EQ(facets.size(), count);
  for (const RoundFacet& facet : facets) {
    const double R = radius_of(mesh, facet), side = R > 1.5 ? 1 : -1;
    EXPECT_NEAR(facet.outside, side * part * R * (1 - std::cos(half)), R * tolerance);
  }
}

TEST(RoundFacets, OfARingAreTwoThirdsOfTheSagittaOff) {
  const ImportedMesh ring = imported<2>(structured_quadrilaterals(4, 3, [](double s, double t) {
    const double angle = M_PI_2 * (1 - s), radius = 1 + t;
    return Vector<2>(radius * std::cos(angle), radius * std::sin(angle));
  }));
  expect_chords(ring, 8, M_PI / 16, 2.0 / 3, 1e-12);
  for (const RoundFacet& facet : round_facets(ring))
    EXPECT_NEAR(facet.area, 2 * radius_of(ring, facet) * std::sin(M_PI / 16), 1e-12);
}

TEST(RoundFacets, OfAPipeAreThoseOfARing) {
  const ImportedMesh pipe =
      imported<3>(structured_hexahedra(4, 2, 2, [](double r, double s, double t) {
        const double angle = M_PI_2 * (1 - r), radius = 1 + t;
        return Vector<3>(radius * std::cos(angle), radius * std::sin(angle), -s);
      }));
  expect_chords(pipe, 16, M_PI / 16, 2.0 / 3, 1e-6);
}

TEST(RoundFacets, OfAFlatBodyAreNone) {
  const ImportedMesh block = imported<2>(
      structured_quadrilaterals(3, 3, [](double s, double t) { return Vector<2>(s + t / 3, t); }));
  EXPECT_TRUE(round_facets(block).empty());
}

}  // namespace
}  // namespace gnomon::round_facets_test
