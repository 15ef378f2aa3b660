// Conditions that every mesh of hexahedra must fulfil.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/terms/solid.hpp>
#include <map>
#include <set>

namespace gnomon::testing {

inline CellNodal<3> positions(const Mesh<3>& mesh, const Mesh<3>::Cell& cell) {
  CellNodal<3> X;
  for (int a = 0; a < 8; ++a) X.row(a) = mesh.nodes[cell[a]].transpose();
  return X;
}

inline double volume(const Mesh<3>& mesh) {
  double sum = 0;
  for (const auto& cell : mesh.cells) sum += cell_volume<3>(positions(mesh, cell));
  return sum;
}

inline double least_scaled_jacobian(const Mesh<3>& mesh) {
  double least = 1;
  for (const auto& cell : mesh.cells)
    least = std::min(least, scaled_jacobian<3>(positions(mesh, cell)));
  return least;
}

/// Area vector of a bilinear facet.
inline Vector<3> facet_area(const Mesh<3>& mesh, const Mesh<3>::Facet& f) {
  return (mesh.nodes[f[2]] - mesh.nodes[f[0]]).cross(mesh.nodes[f[3]] - mesh.nodes[f[1]]) / 2;
}

/// Integral of x . n / 3 over a bilinear facet; over a closed surface, the volume that it encloses.
inline double cone_volume(const Mesh<3>& mesh, const Mesh<3>::Facet& facet) {
  Eigen::Matrix<double, 4, 3> X;
  for (int a = 0; a < 4; ++a) X.row(a) = mesh.nodes[facet[a]].transpose();
  double sum = 0;
  for (const auto& corner : {0, 1, 2, 3}) {
    const Vector<2> xi = reference_corner<2>(corner) / std::sqrt(3.0);
    Eigen::Vector4d N;
    for (int a = 0; a < 4; ++a)
      N[a] = (1 + reference_corner<2>(a)[0] * xi[0]) * (1 + reference_corner<2>(a)[1] * xi[1]) / 4;
    const Eigen::Matrix<double, 3, 2> tangents = X.transpose() * basis_gradients<2>(xi);
    const Vector<3> x = X.transpose() * N;
    sum += x.dot(tangents.col(0).cross(tangents.col(1))) / 3;
  }
  return sum;
}

inline std::set<int> node_set(const auto& nodes) {
  return {nodes.begin(), nodes.end()};
}

/// Nodes of the facet (dimension 2) or edge (dimension 1) of every cell, with the number of cells
/// it belongs to: corners of the reference cell that agree in the other coordinates.
inline std::map<std::set<int>, int> faces(const Mesh<3>& mesh, int dimension) {
  std::map<std::set<int>, int> result;
  for (const auto& cell : mesh.cells) {
    std::set<std::set<int>> own;
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis) {
        std::set<int> face;
        for (int other = 0; other < 8; ++other) {
          const Vector<3> difference = reference_corner<3>(corner) - reference_corner<3>(other);
          const bool same = difference[axis] == 0;
          const bool rest_same = difference.squaredNorm() == difference[axis] * difference[axis];
          if (dimension == 2 ? same : rest_same) face.insert(cell[other]);
        }
        own.insert(face);
      }
    for (const auto& face : own) ++result[face];
  }
  return result;
}

/// Expects right-handed cells, every inner facet between two of them, every outer facet in one
/// boundary part with outer normal, and no hole (Euler characteristic of a ball).
inline void expect_sound(const Mesh<3>& mesh) {
  EXPECT_GT(least_scaled_jacobian(mesh), 0);
  std::map<std::set<int>, int> facets = faces(mesh, 2);
  std::set<int> used;
  for (const auto& cell : mesh.cells) {
    EXPECT_EQ(node_set(cell).size(), 8u);
    used.insert(cell.begin(), cell.end());
  }
  EXPECT_EQ(used.size(), mesh.nodes.size());
  const long characteristic =
      static_cast<long>(mesh.nodes.size()) - static_cast<long>(faces(mesh, 1).size()) +
      static_cast<long>(facets.size()) - static_cast<long>(mesh.cells.size());
  EXPECT_EQ(characteristic, 1);

  Vector<3> closing = Vector<3>::Zero();
  double enclosed = 0;
  std::set<std::set<int>> named;
  for (const auto& [name, part] : mesh.boundary)
    for (const auto& facet : part) {
      EXPECT_TRUE(named.insert(node_set(facet)).second) << "twice, second in " << name;
      closing += facet_area(mesh, facet);
      enclosed += cone_volume(mesh, facet);
    }
  std::set<std::set<int>> outer;
  for (const auto& [facet, cells] : facets) {
    EXPECT_LE(cells, 2);
    if (cells == 1) outer.insert(facet);
  }
  EXPECT_EQ(named, outer);
  const double total = volume(mesh);
  EXPECT_LT(closing.norm(), 1e-12 * std::pow(total, 2.0 / 3));
  EXPECT_NEAR(enclosed, total, 1e-12 * total);
}

}  // namespace gnomon::testing
