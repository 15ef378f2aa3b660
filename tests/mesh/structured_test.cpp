#include <gnomon/base/error.hpp>
#include <gnomon/mesh/extrusion.hpp>

#include "support/hexahedra.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::structured_test {
namespace {

using namespace testing;

TEST(StructuredHexahedra, AreSoundAndFillTheImageOfTheCube) {
  // Straight edges on the cube's own, bent inside: the volume is that of the box.
  const auto place = [](double r, double s, double t) {
    const double bend = r * (1 - r) * s * (1 - s) * t * (1 - t);
    return Vector<3>(2 * r + bend, 3 * s - bend, 5 * t + 2 * bend);
  };
  const Mesh<3> mesh = structured_hexahedra(3, 4, 5, place);
  EXPECT_EQ(mesh.cells.size(), 60u);
  EXPECT_EQ(mesh.nodes.size(), 4u * 5 * 6);
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 30, 1e-12);
}

TEST(StructuredHexahedra, NameTheirSidesAndNumberAlongTheFirstCoordinate) {
  const Mesh<3> mesh = structured_hexahedra(
      2, 3, 4, [](double r, double s, double t) { return Vector<3>(r, s, t); });
  const auto expect_plane = [&mesh](const char* part, int axis, double value, std::size_t facets) {
    EXPECT_EQ(mesh.boundary.at(part).size(), facets) << part;
    for (int node : mesh.boundary_nodes(part)) EXPECT_EQ(mesh.nodes[node][axis], value) << part;
  };
  expect_plane("left", 0, 0, 12);
  expect_plane("right", 0, 1, 12);
  expect_plane("front", 1, 0, 8);
  expect_plane("back", 1, 1, 8);
  expect_plane("bottom", 2, 0, 6);
  expect_plane("top", 2, 1, 6);
  EXPECT_EQ(mesh.boundary.size(), 6u);
  const int node = 1 + 3 * (2 + 4 * 3);  // (i, j, k) = (1, 2, 3)
  EXPECT_EQ(mesh.nodes[node], Vector<3>(0.5, 2.0 / 3, 0.75));
}

Mesh<2> bent_section() {
  return structured_quadrilaterals(
      4, 3, [](double s, double t) { return Vector<2>(2 * s + t * t, 3 * t + s * s); });
}

TEST(Extrusion, IsSoundAndKeepsSectionAndStations) {
  const std::vector<double> lines = {-1, 0.5, 1, 4};
  const Extrusion extrusion = extrude(bent_section(), lines);
  expect_sound(extrusion.mesh);
  ASSERT_EQ(extrusion.section_node.size(), extrusion.mesh.nodes.size());
  for (std::size_t node = 0; node < extrusion.mesh.nodes.size(); ++node) {
    const Vector<3>& X = extrusion.mesh.nodes[node];
    EXPECT_EQ(X.tail<2>(), extrusion.section.nodes[extrusion.section_node[node]]);
    EXPECT_EQ(X[0], lines[node % 4]);
  }
  double area = 0;
  for (const auto& cell : extrusion.section.cells) {
    CellNodal<2> X;
    for (int a = 0; a < 4; ++a) X.row(a) = extrusion.section.nodes[cell[a]].transpose();
    area += cell_volume<2>(X);
  }
  EXPECT_NEAR(volume(extrusion.mesh), 5 * area, 1e-12 * area);
}

TEST(Extrusion, PartsOfTheSectionKeepTheirNames) {
  const Extrusion extrusion = extrude(bent_section(), {0, 1, 2});
  for (const char* part : {"left", "right", "bottom", "top"}) {
    std::set<int> carried;
    for (int node : extrusion.mesh.boundary_nodes(part))
      carried.insert(extrusion.section_node[node]);
    EXPECT_EQ(carried, node_set(extrusion.section.boundary_nodes(part))) << part;
  }
  EXPECT_EQ(extrusion.mesh.boundary.at("begin").size(), extrusion.section.cells.size());
  for (int node : extrusion.mesh.boundary_nodes("end")) EXPECT_EQ(extrusion.mesh.nodes[node][0], 2);
}

TEST(Extrusion, RefusesStationsThatDoNotAscend) {
  EXPECT_THROW(extrude(bent_section(), {0}), Error);
  EXPECT_THROW(extrude(bent_section(), {0, 1, 1}), Error);
}

TEST(ExteriorFacets, AreThoseOfTheNamedParts) {
  const Mesh<3> mesh = structured_hexahedra(
      2, 3, 4, [](double r, double s, double t) { return Vector<3>(r, s, t); });
  std::set<Mesh<3>::Facet> named;
  const auto from_least = [](Mesh<3>::Facet facet) {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
  };
  for (const auto& [name, part] : mesh.boundary)
    for (const auto& facet : part) named.insert(from_least(facet));
  const auto facets = exterior_facets(mesh);
  EXPECT_EQ(facets.size(), named.size());
  for (const auto& facet : facets) EXPECT_TRUE(named.contains(from_least(facet)));
}

}  // namespace
}  // namespace gnomon::structured_test
