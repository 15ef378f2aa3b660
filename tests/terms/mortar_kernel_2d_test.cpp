// The mortar integrals of facets in the plane and on a meridian: derivatives, sums, limits.
#include "support/mortar_facets.hpp"

namespace gnomon::mortar_kernel_2d_test {
namespace {

using namespace testing;

using EndNodes = FacetNodal<2>;
using Row2 = Eigen::RowVector2d;
constexpr std::array sections = {Section::plane, Section::meridian};

CoveredPart<2> covered(const FacetPair<2>& pair, Section section, double reach = any_distance) {
  return covered_part(pair, section, reach);
}
CoveredPartTangent<2> tangent(const FacetPair<2>& pair, Section section,
                              double reach = any_distance) {
  return covered_part_tangent(pair, section, reach);
}
EndNodes ends(const Row2& first, const Row2& last) {
  EndNodes result;
  result << first, last;
  return result;
}
/// A slave along x with normals along -y, undeformed at larger radii, and a master below it.
FacetPair<2> flat_pair(const Row2& slave, const EndNodes& master) {
  const EndNodes x = ends(Row2(slave[0], 0), Row2(slave[1], 0));
  return {x, x, ends(Row2(0, -1), Row2(0, -1)), master};
}
/// Of length about 1 and `size`; undeformed at a radius of about 2. `tilt`: of the normals.
FacetPair<2> random_pair(RandomFacets& random, double tilt, double shift, double size) {
  FacetPair<2> pair = flat_pair(Row2(-0.5, 0.5), EndNodes::Zero());
  const double middle = shift * random();
  pair.y << middle + size / 2, -0.1, middle - size / 2, -0.1;
  for (EndNodes* field : {&pair.X, &pair.x, &pair.y})
    for (int k = 0; k < 4; ++k) field->data()[k] += 0.15 * size * random();
  for (int a = 0; a < 2; ++a) pair.n.row(a) = Row2(tilt * random(), -1).normalized();
  const Eigen::Matrix2d Q = Eigen::Rotation2Dd(std::numbers::pi * random()).toRotationMatrix();
  for (EndNodes* field : {&pair.x, &pair.n, &pair.y}) *field = (*field * Q.transpose()).eval();
  pair.X.col(0).array() += 2;
  return pair;
}
/// Flat; the master partly beside it, its ends at these heights.
FacetPair<2> shifted_pair(RandomFacets& random, double first, double last) {
  const double width = random(0.3, 2), place = random(-0.5, 0.5);
  return flat_pair(Row2(-0.5, 0.5),
                   ends(Row2(place + width / 2, first), Row2(place - width / 2, last)));
}
/// Where its slave begins and ends to be covered.
Row2 covered_range(const FacetPair<2>& pair) {
  const auto xi = [&](int b) { return std::clamp(pair.y(b, 0) + 0.5, 0.0, 1.0); };
  return {xi(1), xi(0)};
}
/// Whether the normal at an end of the slave misses the master, beyond the end that is next to it.
bool misses(const FacetPair<2>& pair, int a) {
  const Row2 away = pair.y.row(1 - a) - pair.x.row(a), out = pair.x.row(a) - pair.x.row(1 - a),
             n = pair.n.row(a);
  const auto cross = [](const Row2& p, const Row2& q) { return p[0] * q[1] - p[1] * q[0]; };
  return cross(away, n) * cross(out, n) < 0;
}

TEST(MortarKernel2d, DerivativesAgreeWithDifferences) {
  for (const Section section : sections) {
    RandomFacets random;
    std::array<int, 4> seen = {};  // pairs covered wholly, not at the first end, the last, either
    for (int k = 0; k < 800; ++k) {
      const FacetPair<2> pair =
          random_pair(random, k % 3 ? 0.3 : 0, k % 4 ? 0.9 : 0.3, std::array{0.4, 1.0, 2.0}[k % 3]);
      const CoveredPartTangent<2> at = tangent(pair, section);
      EXPECT_LE(largest(mortar_values(at.part) - mortar_values(covered(pair, section))), 1e-14);
      if (at.part.mass.sum() < 1e-3) continue;
      const int missed = misses(pair, 0) + 2 * misses(pair, 1);
      ++seen[missed];
      // The mass moves with the ends of the part: not so where all of the slave is covered.
      const double by_current = largest(at.by_input.block<4, 12>(0, 4));
      EXPECT_TRUE(missed ? by_current > 0.01 : by_current == 0) << "pair " << k;
      EXPECT_GT(largest(at.by_input), 0.1);
      const Eigen::MatrixXd differences = mortar_differences(pair, section);
      EXPECT_LE(largest(at.by_input - differences), 2e-8 * std::max(1.0, largest(differences)))
          << "pair " << k;
    }
    for (const int count : seen) EXPECT_GE(count, 70);
    EXPECT_GE(seen[0] + seen[1] + seen[2] + seen[3], 400);
  }
}

/// To nodes of the slave; to those of the master on flat interfaces: with normals in one direction,
/// whatever that of the master.
TEST(MortarKernel2d, MassCouplingAndSharedTransferTheSame) {
  for (const Section section : sections) {
    RandomFacets random;
    int seen = 0, flat = 0, differ = 0;
    for (int k = 0; k < 800; ++k) {
      FacetPair<2> pair = random_pair(random, 0.3, 1, k % 2 ? 1 : 0.3);
      const bool is_flat = k % 4 < 2;
      if (is_flat) pair.n.row(1) = pair.n.row(0);
      const CoveredPart<2> part = covered(pair, section);
      if (part.mass.sum() < 0.01) continue;
      ++(is_flat ? flat : seen);
      differ += largest(part.shared - part.coupling) > 1e-2 * part.mass.sum();
      EXPECT_LE(largest((part.mass - part.coupling).rowwise().sum()), 2e-14);
      EXPECT_LE(largest((part.mass - part.shared).rowwise().sum()), 2e-14);
      EXPECT_LE(largest(part.mass - part.mass.transpose()), 1e-14);
      pair.n *= 2;  // only their direction matters
      EXPECT_LE(largest(mortar_values(covered(pair, section)) - mortar_values(part)), 2e-14);
      EXPECT_TRUE(!is_flat || largest((part.coupling - part.shared).colwise().sum()) < 2e-14);
    }
    EXPECT_GE(seen, 200);
    EXPECT_GE(flat, 200);
    EXPECT_GE(differ, 300);  // else `shared` were nothing of its own
  }
}

Vector<2> phi(double xi) {
  return {1 - xi, xi};
}
Tensor<2> phi_phi(double xi) {
  return phi(xi) * phi(xi).transpose();
}
/// int f dS of the part [from, to] of the slave; Simpson's rule is exact for cubics.
template <class F>
auto integral(const FacetPair<2>& pair, Section section, const Row2& range, const F& f) {
  const auto at = [&](double xi) {
    const double radius = phi(xi).dot(pair.X.col(0));
    return ((section == Section::plane ? 1 : 2 * std::numbers::pi * radius) * f(xi)).eval();
  };
  const double part = (range[1] - range[0]) * (pair.X.row(1) - pair.X.row(0)).norm() / 6;
  return (part * (at(range[0]) + 4 * at(range.mean()) + at(range[1]))).eval();
}

TEST(MortarKernel2d, IntegralsAreExactAlsoOverTheCircumference) {
  RandomFacets random;
  int partly = 0, cones = 0;
  for (int k = 0; k < 200; ++k) {
    FacetPair<2> pair = shifted_pair(random, 0.2 * random(), 0.2 * random());
    // Cones, disks and cylinders; some touch the axis.
    const double radius = k % 4 ? random(0.1, 3) : 0, other = random(0.1, 3);
    pair.X = ends(Row2(radius, 0), Row2(k % 4 == 1 ? radius : other, k % 4 == 2 ? 0 : random()));
    const Row2 range = covered_range(pair);
    const double from = range[0], to = range[1], y0 = pair.y(0, 0), y1 = pair.y(1, 0);
    const bool whole = from == 0 && to == 1;
    partly += !whole;
    const auto N = [&](double xi) { return phi((xi - 0.5 - y0) / (y1 - y0)); };
    const auto coupling = [&](double xi) -> Tensor<2> { return phi(xi) * N(xi).transpose(); };
    const auto shared = [&](double xi) -> Tensor<2> {
      const double s = (xi - from) / (to - from);
      return (1 - s) * coupling(from) + s * coupling(to);
    };
    const auto gap = [&](double xi) -> Vector<2> { return -N(xi).dot(pair.y.col(1)) * phi(xi); };
    for (const Section section : sections) {
      const CoveredPart<2> part = covered(pair, section);
      EXPECT_LE(largest(part.mass - integral(pair, section, range, phi_phi)), 1e-13);
      EXPECT_LE(largest(part.coupling - integral(pair, section, range, coupling)), 1e-13);
      EXPECT_LE(largest(part.shared - integral(pair, section, range, shared)), 1e-13);
      EXPECT_LE(largest(part.gap - integral(pair, section, range, gap)), 1e-13);
      if (section == Section::plane || !whole) continue;
      const double length = (pair.X.row(1) - pair.X.row(0)).norm();
      EXPECT_NEAR(part.mass.sum(), std::numbers::pi * (pair.X(0, 0) + pair.X(1, 0)) * length,
                  1e-13);
      ++cones;
    }
  }
  EXPECT_GE(partly, 100);
  EXPECT_GE(cones, 20);
}

TEST(MortarKernel2d, GapOfParallelFacetsIsTheirDistance) {
  RandomFacets random;
  for (const Section section : sections)
    for (int k = 0; k < 100; ++k) {
      const double distance = random();
      FacetPair<2> pair = shifted_pair(random, -distance, -distance);
      pair.X.col(0).array() += 3;
      const CoveredPart<2> part = covered(pair, section);
      EXPECT_LE(largest(part.gap - distance * part.mass.rowwise().sum()), 2e-14);
      const Vector<2> area = integral(pair, section, covered_range(pair), phi);
      EXPECT_GT(area.sum(), 0.1);
      EXPECT_LE(largest(part.gap - distance * area), 5e-14);
    }
}

/// Whatever the masters do, they cover all of it: derivatives of its mass by their nodes vanish.
TEST(MortarKernel2d, MastersCoverAllOfASlave) {
  for (const Section section : sections) {
    RandomFacets random;
    for (int k = 0; k < 60; ++k) {
      FacetPair<2> pair = random_pair(random, 0.3, 0, 0.7);
      const Row2 along = (pair.x.row(1) - pair.x.row(0)).normalized(), across(along[1], -along[0]);
      std::vector<Row2> nodes;  // against the slave's direction
      const int masters = 4 + k % 9;
      for (int i = 0; i <= masters; ++i)
        nodes.push_back(pair.x.colwise().mean() +
                        (3 - 6.0 / masters * (i + 0.2 * random())) * along +
                        0.3 / masters * random() * across);
      CoveredPart<2> sum;
      // Of the mass; a column for each coordinate.
      Eigen::MatrixXd by_nodes = Eigen::MatrixXd::Zero(4, 2 * masters + 2);
      int parts = 0;
      double most = 0;
      for (int i = 0; i < masters; ++i) {
        pair.y = ends(nodes[i], nodes[i + 1]);
        const CoveredPartTangent<2> at = tangent(pair, section);
        parts += !at.part.mass.isZero(0);
        sum.mass += at.part.mass, sum.coupling += at.part.coupling, sum.shared += at.part.shared;
        by_nodes.middleCols<4>(2 * i) += at.by_input.topRightCorner<4, 4>();
        most = std::max(most, largest(at.by_input.topRightCorner<4, 4>()));
      }
      const Tensor<2> whole = integral(pair, section, Row2(0, 1), phi_phi);
      EXPECT_LE(largest(sum.mass - whole), 5e-14) << k;
      for (const Tensor<2>& other : {sum.coupling, sum.shared})
        EXPECT_LE(largest((other - whole).rowwise().sum()), 5e-14) << k;
      EXPECT_LE(largest(by_nodes), 1e-12) << k;
      EXPECT_TRUE(parts == 1 || most > 1e-3) << k;
      EXPECT_GE(parts, masters > 9 ? 2 : 1);
    }
  }
}

/// Where both meshes have the same nodes on a flat interface, at a distance or in contact.
TEST(MortarKernel2d, SharedOfEqualMeshesIsDiagonal) {
  RandomFacets random;
  for (const Section section : sections)
    for (const double distance : {0.0, 0.3, -0.1}) {
      constexpr int facets = 7;
      std::vector<double> at(facets + 1);
      for (int i = 0; i <= facets; ++i) at[i] = 1 + i + 0.3 * random();
      Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(facets + 1, facets + 1), shared = mass,
                      coupling = mass;
      for (int i = 0; i < facets; ++i)
        for (int j = 0; j < facets; ++j) {
          const CoveredPart<2> part =
              covered(flat_pair(Row2(at[i], at[i + 1]),
                                ends(Row2(at[j + 1], -distance), Row2(at[j], -distance))),
                      section);
          EXPECT_EQ(part.mass.isZero(0), i != j);
          mass.block<2, 2>(i, i) += part.mass;
          coupling.block<2, 2>(i, j) += part.coupling.rowwise().reverse();
          shared.block<2, 2>(i, j) += part.shared.rowwise().reverse();
        }
      EXPECT_LE(largest(shared - Eigen::MatrixXd(mass.rowwise().sum().asDiagonal())), 1e-13);
      EXPECT_LE(largest(coupling - mass), 1e-13);
      EXPECT_GT(shared.diagonal().minCoeff(), 0.1);
      EXPECT_GT(mass.diagonal(1).minCoeff(), 0.05);
    }
}

TEST(MortarKernel2d, IsEmptyWithoutAPartner) {
  const EndNodes beneath = ends(Row2(1, 0), Row2(0, 0));
  const auto is_empty = [&](const EndNodes& master, const Row2& shift,
                            const Row2& n = Row2(0, -1)) {
    FacetPair<2> pair = flat_pair(Row2(0, 1), master);
    pair.y.rowwise() += shift;
    pair.n.rowwise() = n;
    for (const Section section : sections) {
      const CoveredPartTangent<2> at = tangent(pair, section, 0.2);
      const CoveredPart<2> part = covered(pair, section, 0.2);
      EXPECT_LE(largest(mortar_values(at.part) - mortar_values(part)), 1e-15);
      EXPECT_EQ(at.part.mass.isZero(0), at.by_input.isZero(0));
    }
    return mortar_values(covered(pair, Section::plane, 0.2)).isZero(0);
  };
  EXPECT_FALSE(is_empty(beneath, Row2(0.5, -0.199)));
  EXPECT_FALSE(is_empty(beneath, Row2(-0.5, 0.199)));
  EXPECT_TRUE(is_empty(beneath.colwise().reverse(), Row2(0.5, -0.1)));  // faces away
  const EndNodes steep =
      ends(Row2(0.5, -0.03), Row2(0.51, -0.04));  // as seen along slanted normals
  EXPECT_TRUE(is_empty(steep, Row2(0, 0), Row2(3, -1)));
  EXPECT_TRUE(is_empty(beneath, Row2(0.5, -0.201)));  // beyond reach
  EXPECT_TRUE(is_empty(beneath, Row2(-0.5, 0.201)));
  EXPECT_TRUE(is_empty(beneath, Row2(1.001, -0.1)));  // beside
  EXPECT_TRUE(is_empty(beneath, Row2(-1.001, -0.1)));
  EXPECT_TRUE(is_empty(beneath, Row2(1, 0)));  // a common end
  EXPECT_TRUE(is_empty(beneath, Row2(-1, 0)));
  EXPECT_TRUE(is_empty(ends(Row2(0.5, 0), Row2(0.5, -0.1)), Row2(0, 0)));  // at a right angle
  EXPECT_TRUE(is_empty(EndNodes::Zero(), Row2(0.5, 0)));                   // a point
}

}  // namespace
}  // namespace gnomon::mortar_kernel_2d_test
