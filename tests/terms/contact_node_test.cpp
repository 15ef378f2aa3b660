#include <gnomon/terms/contact_node.hpp>

#include "support/derivatives.hpp"

namespace gnomon {
namespace {

using namespace testing;

/// Three nodes of a wavy line, or nine of a wavy sheet, whose inner node is looked at.
template <int dim>
Mesh<dim> wavy_surface() {
  Mesh<dim> mesh;
  const auto height = [](double x, double y) { return 0.2 * x * x - 0.1 * x * y + 0.05 * y; };
  if constexpr (dim == 2) {
    for (double x : {-1.0, 0.1, 0.9}) mesh.nodes.push_back({x, height(x, 0)});
    mesh.boundary["contact"] = {{0, 1}, {1, 2}};
  } else {
    for (double y : {-1.0, 0.1, 1.2})
      for (double x : {-0.9, 0.2, 1.0}) mesh.nodes.push_back({x, y, height(x, y)});
    // Outer normal downwards: clockwise seen from above.
    for (int j : {0, 1})
      for (int i : {0, 1})
        mesh.boundary["contact"].push_back(
            {3 * j + i, 3 * (j + 1) + i, 3 * (j + 1) + i + 1, 3 * j + i + 1});
  }
  return mesh;
}

template <int dim>
struct Fixture {
  static constexpr int centre = dim == 2 ? 1 : 4;
  Mesh<dim> mesh = wavy_surface<dim>();
  std::vector<ContactPatch<dim>> patches = contact_patches<dim>(mesh, mesh.boundary.at("contact"));
  const ContactPatch<dim>& patch = patches[centre];
  ContactParameters<dim> parameters;
  PatchNodal<dim> X;
  Vector<dim> u = noise<Vector<dim>>(0.1, 4);
  double lambda;

  Fixture(bool active, NormalRule rule) : lambda(active ? -30 : 20) {
    parameters.rho = 3;
    parameters.wear.rate_per_pressure = 0.01;
    parameters.normal_rule = rule;
    X.resize(static_cast<int>(patch.nodes.size()), dim);
    for (int p = 0; p < X.rows(); ++p)
      X.row(p) = mesh.nodes[patch.nodes[p]].transpose() + noise<Vector<dim>>(0.05, 10 + p).transpose();
  }
};

template <int dim>
void check_tangent(bool active, NormalRule rule) {
  const Fixture<dim> f(active, rule);
  const int nodes = static_cast<int>(f.X.rows()), total = dim * nodes + dim + 1;
  const PatchNodal<dim, Dual> X = independent(f.X, 0, total);
  const Vector<dim, Dual> u = independent(f.u, dim * nodes, total);
  const Dual lambda(f.lambda, total, total - 1);
  const ContactNode<dim, Dual> node(f.parameters, f.patch, X, u, lambda);
  ASSERT_EQ(node.active, active);

  const ContactNodeTangent<dim> tangent(f.parameters, f.patch, f.X, f.u, f.lambda);
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(dim, total), velocity = force;
  Eigen::MatrixXd constraint = Eigen::MatrixXd::Zero(1, total);
  for (int p = 0; p < nodes; ++p) {
    force.block<dim, dim>(0, dim * p) = tangent.force_by_X[p];
    velocity.block<dim, dim>(0, dim * p) = tangent.velocity_by_X[p];
  }
  for (int column : {0, dim * nodes}) {  // the node's own X, and u
    force.block<dim, dim>(0, column) += tangent.force_by_x;
    velocity.block<dim, dim>(0, column) += tangent.velocity_by_x;
    constraint.block<1, dim>(0, column) += tangent.constraint_by_x.transpose();
  }
  force.col(total - 1) = tangent.force_by_lambda;
  velocity.col(total - 1) = tangent.velocity_by_lambda;
  constraint(0, total - 1) = tangent.constraint_by_lambda;

  const auto row = [&](const Dual& value) {
    Eigen::Matrix<Dual, 1, 1> single;
    single(0, 0) = value;
    return derivative_matrix(single, total);
  };
  expect_same_matrix(constraint, row(node.constraint), 1e-13);
  if (active) {
    expect_same_matrix(force, derivative_matrix(node.force, total), 1e-12);
    expect_same_matrix(velocity, derivative_matrix(node.velocity, total), 1e-12);
  } else {  // an open node exerts nothing and wears nothing, in every direction
    EXPECT_EQ(force.norm(), 0);
    EXPECT_EQ(velocity.norm(), 0);
    EXPECT_EQ(node.force.norm(), Dual(0));
  }
}

TEST(ContactNode, TangentEqualsAutomaticDifferentiation) {
  for (bool active : {true, false})
    for (NormalRule rule : {NormalRule::averaged, NormalRule::normalised}) {
      check_tangent<2>(active, rule);
      check_tangent<3>(active, rule);
    }
}

template <int dim>
void check_central_differences() {
  Fixture<dim> f(true, NormalRule::averaged);
  const ContactNodeTangent<dim> tangent(f.parameters, f.patch, f.X, f.u, f.lambda);
  const double h = 1e-6;
  for (int p = 0; p < f.X.rows(); ++p) {
    Tensor<dim> force, velocity;
    for (int i = 0; i < dim; ++i) {
      const auto at = [&](double shift) {
        PatchNodal<dim> X = f.X;
        X(p, i) += shift;
        return ContactNode<dim>(f.parameters, f.patch, X, f.u, f.lambda);
      };
      force.col(i) = (at(h).force - at(-h).force) / (2 * h);
      velocity.col(i) = (at(h).velocity - at(-h).velocity) / (2 * h);
    }
    Tensor<dim> expected_force = tangent.force_by_X[p], expected_velocity = tangent.velocity_by_X[p];
    if (p == 0) expected_force += tangent.force_by_x, expected_velocity += tangent.velocity_by_x;
    if (force.norm() < 1e-9) continue;  // the far corner of a facet does not enter (3D)
    expect_same_matrix(expected_force, force, 1e-7);
    expect_same_matrix(expected_velocity, velocity, 1e-7);
  }
}

TEST(ContactNode, TangentEqualsCentralDifferences) {
  check_central_differences<2>();
  check_central_differences<3>();
}

// Complementarity, eq. (9) and (26): a closed node asks for g = 0 and transmits lambda + rho g; an open
// one asks for lambda = 0 and transmits nothing.
TEST(UnilateralContact, HasTheTwoBranchesOfEquation26) {
  const UnilateralContact<double> closed(-2.0, 0.1, 10.0);
  EXPECT_TRUE(closed.active);
  EXPECT_DOUBLE_EQ(closed.traction, -1.0);
  EXPECT_DOUBLE_EQ(closed.constraint, 0.1);
  const UnilateralContact<double> open(-2.0, 0.3, 10.0);
  EXPECT_FALSE(open.active);
  EXPECT_DOUBLE_EQ(open.traction, 0.0);
  EXPECT_DOUBLE_EQ(open.constraint, 0.2);
}

// Nodal quadrature shares out exactly the area of a flat surface, and the normal of a flat surface is
// the unit normal.
TEST(NodalSurface, SharesOutAFlatSurface) {
  Mesh<3> mesh = wavy_surface<3>();
  for (auto& X : mesh.nodes) X[2] = 0;
  double area = 0;
  for (const auto& patch : contact_patches<3>(mesh, mesh.boundary.at("contact"))) {
    PatchNodal<3> X(patch.nodes.size(), 3);
    for (int p = 0; p < X.rows(); ++p) X.row(p) = mesh.nodes[patch.nodes[p]].transpose();
    const NodalSurface<3> surface(patch, X, NormalRule::averaged);
    EXPECT_NEAR((surface.normal - Vector<3>(0, 0, -1)).norm(), 0, 1e-15);
    EXPECT_DOUBLE_EQ(surface.area, patch.initial_area);
    area += surface.area;
  }
  EXPECT_NEAR(area, 1.9 * 2.2, 1e-14);
}

// Eq. (35): the averaged normal of a kink of half-angle a between equal segments has length cos a; the
// normalised one has length one and the same direction.
TEST(NodalSurface, NormalRulesAtAKink) {
  Mesh<2> mesh;
  const double angle = 0.3;
  mesh.nodes = {{-std::cos(angle), std::sin(angle)}, {0, 0}, {std::cos(angle), std::sin(angle)}};
  mesh.boundary["contact"] = {{0, 1}, {1, 2}};
  const auto patch = contact_patches<2>(mesh, mesh.boundary.at("contact"))[1];
  PatchNodal<2> X(3, 2);
  for (int p = 0; p < 3; ++p) X.row(p) = mesh.nodes[patch.nodes[p]].transpose();
  EXPECT_NEAR((NodalSurface<2>(patch, X, NormalRule::averaged).normal -
               Vector<2>(0, -std::cos(angle))).norm(), 0, 1e-15);
  EXPECT_NEAR((NodalSurface<2>(patch, X, NormalRule::normalised).normal - Vector<2>(0, -1)).norm(),
              0, 1e-15);
}

// Eq. (35) weighs the facets with their initial lengths, 1 and 3, whatever they are now, 5 and 1. By hand:
// N = 1/4 (-0.6, -0.8) + 3/4 (0, -1); weights of the current lengths would give (-0.5, -0.8333). The area
// is the current one.
TEST(NodalSurface, WeighsNormalsWithInitialAndSumsCurrentAreas) {
  Mesh<2> mesh;
  mesh.nodes = {{-1, 0}, {0, 0}, {3, 0}};
  mesh.boundary["contact"] = {{0, 1}, {1, 2}};
  const auto patch = contact_patches<2>(mesh, mesh.boundary.at("contact"))[1];
  mesh.nodes = {{-4, 3}, {0, 0}, {1, 0}};
  PatchNodal<2> X(3, 2);
  for (int p = 0; p < 3; ++p) X.row(p) = mesh.nodes[patch.nodes[p]].transpose();
  const NodalSurface<2> averaged(patch, X, NormalRule::averaged);
  const NodalSurface<2> normalised(patch, X, NormalRule::normalised);
  EXPECT_NEAR((averaged.normal - Vector<2>(-0.15, -0.95)).norm(), 0, 1e-15);
  EXPECT_NEAR((normalised.normal - Vector<2>(-0.15, -0.95) / std::sqrt(0.925)).norm(), 0, 1e-15);
  EXPECT_DOUBLE_EQ(averaged.area, 3);
  EXPECT_DOUBLE_EQ(normalised.area, 3);
}

}  // namespace
}  // namespace gnomon
