// Surfaces of bodies of revolution: areas, volume gradients, contact nodes, loads.

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/terms/contact_node.hpp>

#include "support/derivatives.hpp"

namespace gnomon::meridian_surface_test {
namespace {

using namespace testing;

/// A closed, irregular polygon, two sides of which may lie on the axis.
struct Polygon {
  Mesh<2> mesh;
  std::vector<Mesh<2>::Facet> facets;

  explicit Polygon(bool on_axis) {
    mesh.nodes = {{0.4, -1},  {1.1, -0.8}, {2, -0.1},   {1.7, 0.9},
                  {0.8, 1.2}, {0.3, 0.7},  {0.35, -0.2}};
    if (on_axis)
      for (int node : {5, 6, 0}) mesh.nodes[static_cast<std::size_t>(node)][0] = 0;
    const int n = static_cast<int>(mesh.nodes.size());
    for (int i = 0; i < n; ++i) facets.push_back({i, (i + 1) % n});
  }
  /// The sides off the axis.
  std::vector<Mesh<2>::Facet> outside() const { return {facets.begin(), facets.begin() + 5}; }
};

/// Sum of frusta of cones, signed.
double volume(const std::vector<Vector<2>>& x, const std::vector<Mesh<2>::Facet>& facets) {
  double sum = 0;
  for (const auto& [a, b] : facets) {
    const double r = x[a][0], s = x[b][0];
    sum += M_PI / 3 * (r * r + r * s + s * s) * (x[b][1] - x[a][1]);
  }
  return sum;
}

Vector<2> volume_gradient(const Polygon& body, int node) {
  Vector<2> gradient;
  for (int i = 0; i < 2; ++i) {
    const auto at = [&](double shift) {
      auto moved = body.mesh.nodes;
      moved[static_cast<std::size_t>(node)][i] += shift;
      return volume(moved, body.facets);
    };
    gradient[i] = (at(1e-3) - at(-1e-3)) / 2e-3;  // quadratic: exact
  }
  return gradient;
}

PatchNodal<2> positions(const Mesh<2>& mesh, const ContactPatch<2>& patch) {
  PatchNodal<2> X(patch.nodes.size(), 2);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p)
    X.row(static_cast<int>(p)) = mesh.nodes[static_cast<std::size_t>(patch.nodes[p])].transpose();
  return X;
}

TEST(MeridianSurface, AreasAreThoseOfFrusta) {
  for (const bool on_axis : {false, true}) {
    const Polygon body(on_axis);
    double area = 0, expected = 0;
    for (const auto& patch : contact_patches<2>(body.mesh, body.outside(), {}, Section::meridian)) {
      EXPECT_GT(patch.initial_area, 0);
      EXPECT_NEAR(patch.initial_normal.norm(), 1, 1e-15);
      area += patch.initial_area;
    }
    for (const auto& [a, b] : body.outside()) {
      const Vector<2>&p = body.mesh.nodes[a], &q = body.mesh.nodes[b];
      expected += M_PI * (p[0] + q[0]) * (q - p).norm();
    }
    EXPECT_NEAR(area, expected, 1e-13 * expected);
  }
}

// On the axis the component r has no derivative to speak of: it is held.
TEST(MeridianSurface, VolumeGradientIsExact) {
  for (const bool on_axis : {false, true}) {
    const Polygon body(on_axis);
    for (auto& patch :
         contact_patches<2>(body.mesh, body.outside(), body.facets, Section::meridian)) {
      const PatchNodal<2> X = positions(body.mesh, patch);
      const Vector<2> a = free_volume_gradient<2, double>(patch, X);
      expect_same_matrix(a, volume_gradient(body, patch.node), 1e-10);
    }
  }
}

/// Along a line, another one at every node.
Tensor<2> along(int node) {
  const Vector<2> direction(std::cos(node), std::sin(node));
  return direction * direction.transpose();
}

ContactParameters<2> parameters_of(NormalRule rule) {
  ContactParameters<2> parameters;
  parameters.wear = archard(0.1);
  parameters.normal_rule = rule;
  parameters.counter_body.motion.across_by_x = Vector<2>(0.7, 0);
  parameters.counter_body.motion.across = 0.1;
  return parameters;
}

// sum a . velocity = - sum A Wdot, whatever is held.
TEST(MeridianSurface, VolumeLostIsWhatWears) {
  for (const bool on_axis : {false, true}) {
    const Polygon body(on_axis);
    double loss = 0, flux = 0, averaged = 0;
    int count = 0;
    for (auto& patch :
         contact_patches<2>(body.mesh, body.outside(), body.facets, Section::meridian)) {
      const bool axis = body.mesh.nodes[static_cast<std::size_t>(patch.node)][0] == 0;
      patch.shape_free(0, 0) = !axis;
      const PatchNodal<2> X = positions(body.mesh, patch);
      const ContactInput<2> at{X, 0 * X, -3.0 - ++count};
      const auto wear = [&](NormalRule rule) {
        return ContactNode<2>(parameters_of(rule), patch, at, Branch::closed);
      };
      const ContactNode<2> node = wear(NormalRule::conservative);
      EXPECT_EQ(node.velocity[0] == 0, axis);
      const Vector<2> gradient = volume_gradient(body, patch.node);
      loss -= gradient.dot(node.velocity);
      averaged -= gradient.dot(wear(NormalRule::averaged).velocity);
      flux += node.area * node.wear_rate;
    }
    EXPECT_NEAR(loss / flux, 1, 1e-9);
    EXPECT_GT(std::abs(averaged / flux - 1), 1e-3);
  }
}

TEST(MeridianSurface, ContactTangentsEqualAutomaticDifferentiation) {
  const Polygon body(true);
  for (const NormalRule rule :
       {NormalRule::averaged, NormalRule::normalised, NormalRule::conservative})
    for (auto& patch :
         contact_patches<2>(body.mesh, body.outside(), body.facets, Section::meridian)) {
      SCOPED_TRACE(::testing::Message() << "rule " << int(rule) << ", node " << patch.node);
      if (patch.node % 2 != 0) patch.shape_free = along(patch.node);
      const PatchNodal<2> X = positions(body.mesh, patch);
      const int nodes = static_cast<int>(X.rows()), total = 2 * nodes;
      ContactParameters<2> parameters = parameters_of(rule);
      parameters.friction = 0.3;
      const ContactNode<2, Dual> node(
          parameters, patch,
          {independent(X, 0, total), constant(PatchNodal<2>(0.1 * X), total), -3.0},
          Branch::closed);
      const ContactNodeTangent<2> tangent(parameters, patch, {X, 0.1 * X, -3.0}, Branch::closed);
      Eigen::MatrixXd velocity(2, total), force(2, total);
      for (int p = 0; p < nodes; ++p) {
        velocity.middleCols(2 * p, 2) = tangent.velocity_by_X[p] + tangent.velocity_by_x[p];
        force.middleCols(2 * p, 2) = tangent.force_by_X[p] + tangent.force_by_x[p];
      }
      expect_same_matrix(velocity, derivative_matrix(node.velocity, total), 1e-12);
      expect_same_matrix(force, derivative_matrix(node.force, total), 1e-12);
    }
}

TEST(MeridianSurface, AFacetOnTheAxisIsRefused) {
  const Polygon body(true);
  EXPECT_THROW(contact_patches<2>(body.mesh, body.facets, {}, Section::meridian), Error);
}

TEST(MeridianSurface, TheAxisIsFound) {
  Polygon body(true);
  EXPECT_EQ(axis_nodes(body.mesh), (std::vector<int>{0, 5, 6}));
  EXPECT_TRUE(axis_nodes(Polygon(false).mesh).empty());
  body.mesh.nodes[5][0] = -1e-15;
  EXPECT_EQ(axis_nodes(body.mesh).size(), 3u);
  body.mesh.nodes[5][0] = -0.1;
  EXPECT_THROW(axis_nodes(body.mesh), InputError);
}

}  // namespace
}  // namespace gnomon::meridian_surface_test
