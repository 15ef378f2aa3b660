// The mortar integrals of facets in space, summed over facets that tile a surface: areas of nodes,
// covers without gaps, and smoothness where meshes match.
#include "support/mortar_facets.hpp"
#include "terms/mortar_overlap.hpp"

namespace gnomon::mortar_tilings_test {
namespace {

using namespace testing;

CoveredPart<3> covered(const FacetPair<3>& pair) {
  return covered_part(pair, Section::plane, any_distance);
}
CoveredPartTangent<3> tangent(const FacetPair<3>& pair) {
  return covered_part_tangent(pair, Section::plane, any_distance);
}

/// int N dA of the nodes of plane facets.
Eigen::VectorXd areas(const FacetTiling& tiling) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(tiling.nodes.size()));
  for (std::size_t k = 0; k < tiling.facets.size(); ++k) {
    const QuadNodes x = tiling.facet(k);
    for (double s : {-1.0, 1.0})
      for (double t : {-1.0, 1.0}) {
        const mortar::Point xi = mortar::Point(s, t) / std::sqrt(3.0);
        const mortar::ShapeGradient by = mortar::shape_gradient(xi);
        const Vector<3> g1 = x.transpose() * by.col(0), g2 = x.transpose() * by.col(1);
        for (int a = 0; a < 4; ++a)
          result[tiling.facets[k][a]] += mortar::shapes(xi)[a] * g1.cross(g2).norm();
      }
  }
  return result;
}

struct Errors {
  double slave = 0, master = 0;  ///< largest of int phi dS and int N dS of the nodes
  int pairs = 0;
};
/// Of two plane surfaces with a common outline, the slave stretched from its undeformed state.
Errors conservation(const FacetTiling& slave, const FacetTiling& master, RandomFacets& random) {
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
  stretch.topLeftCorner<2, 2>() << 1.1, 0.2, -0.1, 0.9;
  const double ratio = stretch.determinant();
  const FacetTiling over = master.turned_over();
  const Eigen::Matrix3d Q = random.rotation();
  Eigen::VectorXd by_slave = -ratio * areas(slave), by_master = -ratio * areas(master);
  Errors result;
  for (std::size_t k = 0; k < slave.facets.size(); ++k)
    for (std::size_t l = 0; l < over.facets.size(); ++l) {
      FacetPair<3> pair = flat_pair(slave.facet(k) * Q.transpose(), over.facet(l) * Q.transpose());
      pair.X = slave.facet(k) * stretch.transpose();
      pair.n.rowwise() = Q.col(2).transpose();
      const CoveredPart<3> part = covered(pair);
      result.pairs += !part.mass.isZero(0);
      for (int a = 0; a < 4; ++a) {
        by_slave[slave.facets[k][a]] += part.mass.row(a).sum();
        by_master[over.facets[l][a]] += part.coupling.col(a).sum();
      }
    }
  result.slave = largest(by_slave);
  result.master = largest(by_master);
  return result;
}

TEST(MortarTilings, PlaneTilingsKeepTheAreasOfNodes) {
  RandomFacets random;
  const FacetTiling coarse = facet_grid(random, 4, 0.3), fine = facet_grid(random, 7, 0.3);
  const FacetTiling coarse_cut = cut_triangles(facet_grid(random, 2, 0.3)),
                    fine_cut = cut_triangles(facet_grid(random, 3, 0.3)),
                    regular = facet_grid(random, 5, 0), one = facet_grid(random, 1, 0),
                    finest = facet_grid(random, 10, 0.2);
  const std::vector<std::pair<const FacetTiling*, const FacetTiling*>> pairs = {
      {&coarse, &fine},         {&fine, &coarse},     {&coarse_cut, &fine_cut},
      {&fine_cut, &coarse_cut}, {&coarse, &fine_cut}, {&fine_cut, &fine},
      {&regular, &coarse_cut},  {&regular, &regular}, {&coarse, &coarse},
      {&fine_cut, &fine_cut},   {&one, &finest},      {&finest, &one}};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Errors errors = conservation(*pairs[k].first, *pairs[k].second, random);
    EXPECT_GE(errors.pairs,
              std::max(pairs[k].first->facets.size(), pairs[k].second->facets.size()));
    EXPECT_LE(errors.slave, 2e-15) << "pair of surfaces " << k;
    EXPECT_LE(errors.master, 2e-15) << "pair of surfaces " << k;
  }
}

/// The sum over masters, and of derivatives by the slave and by all nodes of the masters.
struct Sum {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(CoveredPartTangent<3>::values);
  Eigen::MatrixXd by_slave = Eigen::MatrixXd::Zero(CoveredPartTangent<3>::values, 36), by_master;
  int pairs = 0;

  Sum(FacetPair<3> pair, const FacetTiling& masters) {
    by_master = Eigen::MatrixXd::Zero(CoveredPartTangent<3>::values,
                                      3 * static_cast<Eigen::Index>(masters.nodes.size()));
    for (std::size_t l = 0; l < masters.facets.size(); ++l) {
      pair.y = masters.facet(l);
      const CoveredPartTangent<3> at = tangent(pair);
      pairs += !at.part.mass.isZero(0);
      value += mortar_values(at.part);
      by_slave += at.by_input.leftCols<36>();
      for (int b = 0; b < 4; ++b)
        by_master.middleCols<3>(3 * masters.facets[l][b]) += at.by_input.middleCols<3>(36 + 3 * b);
    }
  }
};

/// Over warped masters that match the slave, have nodes on its edges, or lie anyhow. Whatever they
/// do, they cover all of it: derivatives of its mass by their nodes vanish.
TEST(MortarTilings, MastersCoverAllOfASlave) {
  RandomFacets random;
  int seen = 0;
  for (int k = 0; k < 60; ++k) {
    FacetPair<3> pair = flat_pair(unit_square(), QuadNodes::Zero());
    const int n = k % 3 == 0 ? 3 : k % 3 == 1 ? 6 : 4;  // of width 1, 0.5, 0.75
    FacetTiling masters =
        facet_grid(random, n, k % 3 == 2 ? 0.3 : 0, k % 2 ? 0.3 : 0, 3).turned_over();
    const double nearly = k < 12 ? 0 : std::pow(10, -15 + k / 5.0);
    for (Row3& node : masters.nodes) node += nearly * Row3(random(), random(), random());
    const Sum sum(pair, masters);
    seen += sum.pairs > 1;
    const Eigen::Matrix4d mass = sum.value.head(16).reshaped(4, 4);
    Eigen::Matrix4d whole;
    whole << 4, 2, 1, 2, 2, 4, 2, 1, 1, 2, 4, 2, 2, 1, 2, 4;
    // Nodes nearer to an edge than 1e-12 are taken to be on it.
    EXPECT_LE(largest(mass - whole / 36), nearly > 0 ? 1e-12 : 1e-15) << k;
    EXPECT_TRUE(sum.by_slave.allFinite() && sum.by_master.allFinite());
    EXPECT_LE(largest(sum.by_master.topRows(16)), 2e-8) << k << " " << nearly;
    EXPECT_LE(largest(sum.by_slave.block(0, 12, 16, 24)), 2e-8) << k << " " << nearly;
  }
  EXPECT_GE(seen, 40);
}

TEST(MortarTilings, MastersCoverAllOfAWarpedSlave) {
  RandomFacets random;
  for (int k = 0; k < 20; ++k) {
    FacetPair<3> pair = random_pair(random, 0.2, 0.2, 0, 1);
    const Vector<3> n = pair.n.colwise().sum().normalized(), axis = n.cross(Vector<3>::UnitZ());
    const Eigen::Matrix3d back =
        Eigen::AngleAxisd(std::acos(n[2]), axis.normalized()).toRotationMatrix();
    for (QuadNodes* field : {&pair.x, &pair.n}) *field = (*field * back.transpose()).eval();
    pair.x.rowwise() += Row3(0.5, 0.5, 0) - pair.x.colwise().mean();
    const Sum one(pair, facet_grid(random, 1, 0, 0, 6).turned_over()),
        many(pair, facet_grid(random, 9, 0.3, 0.3, 6).turned_over());
    EXPECT_GE(one.pairs, 1);
    EXPECT_GE(many.pairs, 9);
    // Of int phi_a phi_b dS the rule knows 8 digits here.
    EXPECT_LE(largest((one.value - many.value).head(16)), 1e-6);
    EXPECT_LE(largest(many.by_master.topRows(16)), 1e-5);
  }
}

/// Coupling and gap of a slave, summed over masters: by the nodes of these.
Eigen::MatrixXd assembled(FacetPair<3> pair, const FacetTiling& masters,
                          const Eigen::VectorXd* direction) {
  const auto nodes = static_cast<Eigen::Index>(masters.nodes.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(4, nodes + 1);
  for (std::size_t l = 0; l < masters.facets.size(); ++l) {
    pair.y = masters.facet(l);
    const CoveredPartTangent<3> at = tangent(pair);
    Eigen::VectorXd value = mortar_values(at.part);
    if (direction) {
      Eigen::VectorXd local(48);
      local.head(36) = direction->head(36);
      for (int b = 0; b < 4; ++b)
        local.segment(36 + 3 * b, 3) = direction->segment(36 + 3 * masters.facets[l][b], 3);
      value = at.by_input * local;
    }
    for (int b = 0; b < 4; ++b) result.col(masters.facets[l][b]) += value.segment(16 + 4 * b, 4);
    result.col(nodes) += value.tail(4);
  }
  return result;
}

/// Where meshes match, which facet of the master covers a point changes at once, but the master's
/// shapes and its surface are continuous: so are the derivatives of sums.
TEST(MortarTilings, SumsOverMatchingMastersAreSmooth) {
  RandomFacets random;
  for (int k = 0; k < 20; ++k) {
    const int n = k % 2 ? 3 : 6;  // facets of the slave's size, or half of it
    const double h = 1e-6;
    FacetPair<3> pair = flat_pair(facet_grid(random, 1, 0).facet(0), QuadNodes::Zero());
    FacetTiling masters = facet_grid(random, n, 0, 0, 3).turned_over();
    for (Row3& node : masters.nodes) node[2] += 0.1 * std::sin(3 * node[0]) * std::cos(2 * node[1]);
    for (int a = 0; a < 4; ++a)
      pair.x(a, 2) += 0.1 * std::sin(3 * pair.x(a, 0)) * std::cos(2 * pair.x(a, 1));
    Eigen::VectorXd direction(36 + 3 * static_cast<Eigen::Index>(masters.nodes.size()));
    for (double& value : direction) value = random();
    const auto moved = [&](double step) {
      FacetPair<3> slave = pair;
      FacetTiling others = masters;
      for (int i = 0; i < 36; ++i) mortar_input(slave, i) += step * direction[i];
      for (std::size_t i = 0; i < others.nodes.size(); ++i)
        others.nodes[i] +=
            step * direction.segment<3>(36 + 3 * static_cast<Eigen::Index>(i)).transpose();
      return assembled(slave, others, nullptr);
    };
    const Eigen::MatrixXd by = assembled(pair, masters, &direction);
    EXPECT_GT(largest(by.leftCols(by.cols() - 1)), 0.05);
    EXPECT_GT(largest(by.rightCols(1)), 0.01);
    EXPECT_LE(largest(by - (moved(h) - moved(-h)) / (2 * h)), 2e-5) << k;
  }
}

}  // namespace
}  // namespace gnomon::mortar_tilings_test
