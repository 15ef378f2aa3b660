// Facets near a line, against a look at all of them.

#include "mesh/facet_bins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/structured_hexahedra.hpp"

namespace gnomon::facet_bins_test {
namespace {

using namespace testing;

TEST(FacetBins, NoFacetNearALineIsMissed) {
  const Mesh<3> mesh = structured_hexahedra(9, 5, 2, [](double r, double s, double t) {
    return Vector<3>(4 * r * r, s, std::cos(3 * r) - s * s - 0.5 * t);
  });
  const auto facets = exterior_facets(mesh);
  const FacetBins<3> bins(facets, mesh.nodes);
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto somewhere = [&] {
    return Vector<3>(uniform(generator), uniform(generator), uniform(generator));
  };
  std::size_t found = 0;
  for (int line = 0; line < 300; ++line) {
    const Vector<3> from = 4 * somewhere(),
                    along = line % 3 ? somewhere().normalized() : Vector<3>::Unit(line % 2);
    const double radius = line % 5 ? 0.5 * std::abs(uniform(generator)) : 0;
    const double reach = line % 2 ? std::numeric_limits<double>::infinity() : 2;
    const std::vector<int> near = bins.near_line(from, along, reach, radius);
    EXPECT_TRUE(std::ranges::is_sorted(near));
    found += near.size();
    for (int f = 0; f < static_cast<int>(facets.size()); ++f)
      for (const int node : facets[f]) {
        const Vector<3> to = mesh.nodes[node] - from;
        const double s = std::clamp(to.dot(along), -reach, reach);
        if ((to - s * along).norm() <= radius) {
          EXPECT_TRUE(std::ranges::binary_search(near, f)) << line << ' ' << f;
        }
      }
  }
  EXPECT_LT(found, 300 * facets.size() / 3);
}

}  // namespace
}  // namespace gnomon::facet_bins_test
