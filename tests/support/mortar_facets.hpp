// What tests of mortar integrals share: random pairs of facets, meshes that tile a square, the
// entries of values and inputs in their order, and differences.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/terms/mortar_kernel.hpp>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace gnomon::testing {

using QuadNodes = FacetNodal<3>;
using Row3 = Eigen::RowVector3d;

constexpr double any_distance = 100;  ///< farther than all facets here

template <class Matrix>
double largest(const Eigen::MatrixBase<Matrix>& A) {
  return A.cwiseAbs().maxCoeff();
}

/// In the order of the rows of by_input.
template <int dim>
Eigen::VectorXd mortar_values(const CoveredPart<dim>& part) {
  Eigen::VectorXd result(CoveredPartTangent<dim>::values);
  result << part.mass.reshaped(), part.coupling.reshaped(), part.shared.reshaped(), part.gap;
  return result;
}
/// In the order of its columns.
template <int dim>
double& mortar_input(FacetPair<dim>& pair, int k) {
  constexpr int each = dim * Mesh<dim>::facet_nodes;
  const std::array<FacetNodal<dim>*, 4> fields = {&pair.X, &pair.x, &pair.n, &pair.y};
  return fields[k / each]->data()[k % each];
}

/// Of covered_part by all inputs, central.
template <int dim>
Eigen::MatrixXd mortar_differences(FacetPair<dim> pair, Section section = Section::plane,
                                   double reach = any_distance) {
  constexpr double h = 1e-6;
  constexpr int inputs = CoveredPartTangent<dim>::inputs;
  Eigen::MatrixXd result(CoveredPartTangent<dim>::values, inputs);
  for (int k = 0; k < inputs; ++k) {
    double& value = mortar_input(pair, k);
    const double at = value;
    value = at + h;
    const Eigen::VectorXd above = mortar_values(covered_part(pair, section, reach));
    value = at - h;
    const Eigen::VectorXd below = mortar_values(covered_part(pair, section, reach));
    result.col(k) = (above - below) / (2 * h);
    value = at;
  }
  return result;
}

class RandomFacets {
public:
  double operator()(double from = -1, double to = 1) {
    return std::uniform_real_distribution<double>(from, to)(engine_);
  }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond((*this)(), (*this)(), (*this)(), (*this)())
        .normalized()
        .toRotationMatrix();
  }
  /// A square of half the side `size`, distorted in its plane and out of it.
  QuadNodes facet(double size, double distortion, double warp) {
    QuadNodes result;
    result << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
    for (int a = 0; a < 4; ++a)
      result.row(a) += Row3(distortion * (*this)(), distortion * (*this)(), warp * (*this)());
    return size * result;
  }

private:
  std::mt19937 engine_{7};
};

inline QuadNodes unit_square() {
  QuadNodes result;
  result << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  return result;
}
/// The same facet with its normal on the other side.
inline QuadNodes turned(const QuadNodes& facet) {
  QuadNodes result;
  for (int a = 0; a < 4; ++a) result.row(a) = facet.row((4 - a) % 4);
  return result;
}
/// A slave whose normals are along z.
inline FacetPair<3> flat_pair(const QuadNodes& slave, const QuadNodes& master) {
  FacetPair<3> pair{slave, slave, QuadNodes::Zero(), master};
  pair.n.col(2).setOnes();
  return pair;
}
inline FacetPair<3> random_pair(RandomFacets& random, double distortion, double warp, double shift,
                                double size) {
  FacetPair<3> pair = flat_pair(random.facet(1, distortion, warp), QuadNodes::Zero());
  for (int k = 0; k < 12; ++k) pair.X.data()[k] += 0.1 * random();
  for (int a = 0; a < 4; ++a)
    pair.n.row(a) = Row3(warp * random(), warp * random(), 1).normalized();
  const Eigen::AngleAxisd turn(std::numbers::pi * random(), Vector<3>::UnitZ());
  pair.y = turned(random.facet(size, distortion, warp) * turn.toRotationMatrix().transpose());
  pair.y.rowwise() += Row3(shift * random(), shift * random(), 0.3 * random());
  const Eigen::Matrix3d Q = random.rotation();
  for (QuadNodes* field : {&pair.X, &pair.x, &pair.n, &pair.y})
    *field = (*field * Q.transpose()).eval();
  return pair;
}

/// Facets and their nodes.
struct FacetTiling {
  std::vector<Row3> nodes;
  std::vector<std::array<int, 4>> facets;

  QuadNodes facet(std::size_t k) const {
    QuadNodes result;
    for (int a = 0; a < 4; ++a) result.row(a) = nodes[facets[k][a]];
    return result;
  }
  /// The same, with normals along -z.
  FacetTiling turned_over() const {
    FacetTiling result = *this;
    for (auto& f : result.facets) std::swap(f[1], f[3]);
    return result;
  }
};

/// A square with the unit square's middle, in n times n quadrilaterals; inner nodes move by a part
/// of the width.
inline FacetTiling facet_grid(RandomFacets& random, int n, double distortion, double warp = 0,
                              double side = 1) {
  FacetTiling result;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      Row3 p = Row3(i, j, 0) / n;
      if (i > 0 && i < n) p[0] += distortion / n * random();
      if (j > 0 && j < n) p[1] += distortion / n * random();
      p[2] = warp / n * random();
      result.nodes.push_back(side * (p - Row3(0.5, 0.5, 0)) + Row3(0.5, 0.5, 0));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = j * (n + 1) + i;
      result.facets.push_back({k, k + 1, k + n + 2, k + n + 1});
    }
  return result;
}

/// Each quadrilateral cut into two triangles, each of these into three quadrilaterals.
inline FacetTiling cut_triangles(const FacetTiling& quadrilaterals) {
  FacetTiling result{quadrilaterals.nodes, {}};
  std::map<std::pair<int, int>, int> middles;
  const auto push = [&](const Row3& p) {
    result.nodes.push_back(p);
    return static_cast<int>(result.nodes.size()) - 1;
  };
  const auto middle = [&](int a, int b) {
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), 0);
    if (is_new) found->second = push((result.nodes[a] + result.nodes[b]) / 2);
    return found->second;
  };
  for (const auto& f : quadrilaterals.facets)
    for (const std::array<int, 3>& t : {std::array{f[0], f[1], f[2]}, {f[0], f[2], f[3]}}) {
      const int centre = push((result.nodes[t[0]] + result.nodes[t[1]] + result.nodes[t[2]]) / 3);
      for (int a = 0; a < 3; ++a)
        result.facets.push_back(
            {t[a], middle(t[a], t[(a + 1) % 3]), centre, middle(t[a], t[(a + 2) % 3])});
    }
  return result;
}

}  // namespace gnomon::testing
