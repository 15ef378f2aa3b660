// The conservative rule: the wear of the nodes is equal to the loss of volume, on any mesh.

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/terms/contact_node.hpp>

#include "support/derivatives.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::conservative_normal_test {
namespace {

using namespace testing;

/// A closed, distorted surface with outer normals: a polygon, or a cube with 3 x 3 facets per side.
template <int dim>
struct Closed {
  Mesh<dim> mesh;
  std::vector<typename Mesh<dim>::Facet> facets;

  explicit Closed(unsigned seed) {
    if constexpr (dim == 2) {
      constexpr int n = 9;
      for (int i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n;
        mesh.nodes.push_back(Vector<2>(std::cos(angle), std::sin(angle)));
        facets.push_back({i, (i + 1) % n});
      }
    } else {
      mesh = structured_hexahedra(3, 3, 3,
                                  [](double r, double s, double t) { return Vector<3>(r, s, t); });
      facets = exterior_facets(mesh);
    }
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      mesh.nodes[i] += noise<Vector<dim>>(0.1, seed + static_cast<unsigned>(i));
  }
};

/// The volume inside, without shape functions: the volume under a bilinear facet is the mean of the
/// volumes under its two divisions into triangles.
double volume(const std::vector<Vector<2>>& x, const std::vector<Mesh<2>::Facet>& facets) {
  double twice = 0;
  for (const auto& [a, b] : facets) twice += x[a][0] * x[b][1] - x[a][1] * x[b][0];
  return twice / 2;
}
double volume(const std::vector<Vector<3>>& x, const std::vector<Mesh<3>::Facet>& facets) {
  double sum = 0;
  const auto tetrahedron = [&](int a, int b, int c) { return x[a].dot(x[b].cross(x[c])) / 6; };
  for (const auto& [a, b, c, d] : facets)
    sum += (tetrahedron(a, b, c) + tetrahedron(a, c, d) + tetrahedron(a, b, d) +
            tetrahedron(b, c, d)) /
           2;
  return sum;
}

template <int dim>
PatchNodal<dim> positions(const Mesh<dim>& mesh, const ContactPatch<dim>& patch) {
  PatchNodal<dim> X(patch.nodes.size(), dim);
  for (std::size_t p = 0; p < patch.nodes.size(); ++p)
    X.row(static_cast<int>(p)) = mesh.nodes[patch.nodes[p]].transpose();
  return X;
}

/// The volume is linear in each coordinate of one node: a difference over any distance is exact.
template <int dim>
Vector<dim> volume_gradient(Closed<dim> body, int node) {
  Vector<dim> gradient;
  for (int i = 0; i < dim; ++i) {
    const auto at = [&](double shift) {
      auto moved = body.mesh.nodes;
      moved[node][i] += shift;
      return volume(moved, body.facets);
    };
    gradient[i] = at(0.5) - at(-0.5);
  }
  return gradient;
}

template <int dim>
void check_gradient() {
  const Closed<dim> body(3);
  for (const auto& patch : contact_patches<dim>(body.mesh, body.facets)) {
    const PatchNodal<dim> X = positions(body.mesh, patch);
    const Vector<dim> a = free_volume_gradient<dim, double>(patch, X);
    expect_same_matrix(a, volume_gradient(body, patch.node), 1e-13);
  }
}

TEST(ConservativeNormal, VolumeGradientIsExact) {
  check_gradient<2>();
  check_gradient<3>();
}

/// A part of the boundary is in contact and wears at random; some of its nodes are held or slide.
/// sum (dV/dX) . velocity, with dV/dX from the volume itself, is minus the flux.
template <int dim>
void check_balance(unsigned seed) {
  const Closed<dim> body(seed);
  const std::size_t part = body.facets.size() / 2;
  const std::vector<typename Mesh<dim>::Facet> surface(body.facets.begin(),
                                                       body.facets.begin() + part);
  ContactParameters<dim> parameters;
  parameters.wear = archard(0.1);
  parameters.counter_body.motion.velocity = Vector<dim>::Unit(0);
  double loss = 0, flux = 0, loss_of_eq_35 = 0;
  int count = 0;
  for (auto& patch : contact_patches<dim>(body.mesh, surface, body.facets)) {
    const int kind = ++count % 5;
    // Two of five move freely, one slides across a coordinate direction, one is held, and one
    // slides along an oblique plane.
    const Vector<dim> across = kind == 4 ? noise<Vector<dim>>(1, seed + 1000 + count).normalized()
                                         : Vector<dim>::Unit(count % dim);
    if (kind == 1 || kind == 4) patch.shape_free -= across * across.transpose();
    if (kind == 2) patch.shape_free.setZero();
    const PatchNodal<dim> X = positions(body.mesh, patch);
    ContactInput<dim> at{X, 0 * X, -3.0 - count};
    const auto wear = [&](NormalRule rule) {
      parameters.normal_rule = rule;
      return ContactNode<dim>(parameters, patch, at, Branch::closed);
    };
    const ContactNode<dim> node = wear(NormalRule::conservative);
    EXPECT_GT(std::abs(node.wear_rate), 0);
    const Vector<dim> held = node.velocity - patch.shape_free * node.velocity;
    EXPECT_LE(held.norm(), kind == 4 ? 1e-15 * node.velocity.norm() : 0);
    if (kind == 2) {
      EXPECT_EQ(node.velocity, Vector<dim>::Zero());
      continue;
    }
    const Vector<dim> gradient = volume_gradient(body, patch.node);
    loss -= gradient.dot(node.velocity);
    loss_of_eq_35 -= gradient.dot(wear(NormalRule::averaged).velocity);
    flux += node.area * node.wear_rate;
  }
  ASSERT_GT(count, 4);
  EXPECT_NEAR(loss / flux, 1, 1e-13);
  EXPECT_GT(std::abs(loss_of_eq_35 / flux - 1), 1e-3);
}

TEST(ConservativeNormal, VolumeLostIsWhatWears) {
  for (unsigned seed : {1, 50, 200}) {
    check_balance<2>(seed);
    check_balance<3>(seed);
  }
}

// On a flat surface it is the normal of the others, and along a side half a facet counts as half.
TEST(ConservativeNormal, IsTheUnitNormalOfAPlane) {
  Mesh<2> mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {3, 0}, {0, 2}};
  const std::vector<Mesh<2>::Facet> surface = {{0, 1}, {1, 2}};
  auto patches = contact_patches<2>(mesh, surface, {{0, 1}, {1, 2}, {3, 0}});
  patches[0].shape_free(0, 0) = 0;  // slides along the side
  for (int c : {0, 1}) {
    const NodalSurface<2> node(patches[c], positions(mesh, patches[c]), NormalRule::conservative);
    EXPECT_NEAR((node.normal - Vector<2>(0, -1)).norm(), 0, 1e-15);
  }
  EXPECT_EQ(patches[0].corners_beyond.size(), 1);
  EXPECT_EQ(patches[1].corners_beyond.size(), 0);
}

/// The derivatives if facets outside the contact surface contribute.
template <int dim>
void check_tangent_at_border() {
  const Closed<dim> body(7);
  const std::vector<typename Mesh<dim>::Facet> surface(
      body.facets.begin(), body.facets.begin() + body.facets.size() / 2);
  const auto patches = contact_patches<dim>(body.mesh, surface, body.facets);
  const auto patch = std::find_if(patches.begin(), patches.end(), [](const auto& candidate) {
    return !candidate.corners_beyond.empty();
  });
  ASSERT_NE(patch, patches.end());
  const PatchNodal<dim> X = positions(body.mesh, *patch);
  const int nodes = static_cast<int>(X.rows()), total = dim * nodes;
  ContactParameters<dim> parameters;
  parameters.wear = archard(0.1);
  parameters.normal_rule = NormalRule::conservative;
  parameters.counter_body.motion.velocity = Vector<dim>::Unit(0);
  const ContactNode<dim, Dual> node(
      parameters, *patch, {independent(X, 0, total), constant(PatchNodal<dim>(0 * X), total), -3.0},
      Branch::closed);
  const ContactNodeTangent<dim> tangent(parameters, *patch, {X, 0 * X, -3.0}, Branch::closed);
  Eigen::MatrixXd velocity(dim, total);
  for (int p = 0; p < nodes; ++p)
    velocity.middleCols(dim * p, dim) = tangent.velocity_by_X[p] + tangent.velocity_by_x[p];
  expect_same_matrix(velocity, derivative_matrix(node.velocity, total), 1e-12);
}

TEST(ConservativeNormal, TangentAtTheBorderOfTheContact) {
  check_tangent_at_border<2>();
  check_tangent_at_border<3>();
}

// The free direction is along the surface: there is no direction of wear, and the message says so.
TEST(ConservativeNormal, RefusesNodesThatCannotWear) {
  Mesh<2> mesh;
  mesh.nodes = {{-1, 0}, {0, 0}, {1, 0}};
  auto patch = contact_patches<2>(mesh, {{0, 1}, {1, 2}})[1];
  patch.shape_free(1, 1) = 0;
  ContactParameters<2> parameters;
  parameters.normal_rule = NormalRule::conservative;
  parameters.wear = archard(0.1);
  parameters.streaming = {1, 0};
  const PatchNodal<2> X = positions(mesh, patch);
  using Node = ContactNode<2>;
  EXPECT_THROW(Node(parameters, patch, {X, 0 * X, -3.0}, Branch::closed), RecoverableError);
  EXPECT_NO_THROW(Node(parameters, patch, {X, 0 * X, -3.0}, Branch::open));
  patch.shape_free.setZero();
  EXPECT_NO_THROW(Node(parameters, patch, {X, 0 * X, -3.0}, Branch::closed));
}

}  // namespace
}  // namespace gnomon::conservative_normal_test
