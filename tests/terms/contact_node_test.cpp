#include <array>
#include <cmath>
#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/profile.hpp>
#include <gnomon/terms/contact_node.hpp>

#include "support/derivatives.hpp"

namespace gnomon::contact_node_test {
namespace {

using namespace testing;

/// Three nodes of a wavy line, or nine of a wavy sheet, whose inner node is tested.
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

/// The counter-bodies: a frictionless plane that slides past (sec. 4.1), the same with friction
/// (4.2), a ball past which the body streams (4.3), a ball that turns without friction, a cylinder
/// that turns, with friction (2D: a disk), a conical seat (2D: a groove), the groove of a ring
/// (2D: a socket), a rail of which the shape turns, a ball that slides out of the plane, faster to
/// one side (in space: as the turning ball), and a rail that moves in two directions and turns.
enum class Meets {
  plane,
  rough_plane,
  rough_ball,
  turning_ball,
  rough_turning_cylinder,
  seat,
  rough_groove,
  rough_turning_rail,
  rough_across,
  rough_pivot
};
constexpr Meets all_meets[] = {Meets::plane,
                               Meets::rough_plane,
                               Meets::rough_ball,
                               Meets::turning_ball,
                               Meets::rough_turning_cylinder,
                               Meets::seat,
                               Meets::rough_groove,
                               Meets::rough_turning_rail,
                               Meets::rough_across,
                               Meets::rough_pivot};
constexpr NormalRule all_rules[] = {NormalRule::averaged, NormalRule::normalised,
                                    NormalRule::conservative};

enum class Law { archard, dissipation, power, running_in, threshold };
constexpr Law all_laws[] = {Law::archard, Law::dissipation, Law::power, Law::running_in,
                            Law::threshold};

/// k p^1.5 v
WearRate power_rate(const WearInput& at, std::span<const char>) {
  const double root = 1e-3 * std::sqrt(at.pressure);
  return {.value = root * at.pressure * at.speed,
          .by_pressure = 1.5 * root * at.speed,
          .by_speed = root * at.pressure};
}

/// (k p v^1.5 + K q^1.1) exp(-h / h0)
WearRate running_in_rate(const WearInput& at, std::span<const char>) {
  const double fade = std::exp(-at.depth / 0.3), root = 0.02 * std::sqrt(at.speed);
  const double by_power = 0.01 * std::pow(at.friction_power, 0.1);
  const double value = fade * (root * at.pressure * at.speed + by_power * at.friction_power);
  return {.value = value,
          .by_pressure = fade * root * at.speed,
          .by_speed = fade * 1.5 * root * at.pressure,
          .by_depth = -value / 0.3,
          .by_friction_power = fade * 1.1 * by_power};
}

constexpr double threshold_pressure = 7, threshold_depth = 0.01;

/// k v max(p - p0, 0), and twice that from some depth on: two kinks.
bool taken(std::span<const char> branches, std::size_t kink, double value) {
  return branches.empty() ? value <= 0 : branches[kink] != 0;
}
WearRate threshold_rate(const WearInput& at, std::span<const char> branches) {
  if (!taken(branches, 0, threshold_pressure - at.pressure)) return {};
  const double k = taken(branches, 1, threshold_depth - at.depth) ? 0.04 : 0.02;
  const double over = at.pressure - threshold_pressure;
  return {.value = k * at.speed * over, .by_pressure = k * at.speed, .by_speed = k * over};
}
void threshold_switching(const WearInput& at, std::span<const char>, std::span<double> values) {
  values[0] = threshold_pressure - at.pressure;
  values[1] = threshold_depth - at.depth;
}

/// Eq. (13).
WearRate dissipation_rate(const WearInput& at, std::span<const char>) {
  return {.value = 0.02 * at.friction_power, .by_friction_power = 0.02};
}

WearLaw law_of(Law law) {
  switch (law) {
    case Law::archard:
      return archard(0.01);
    case Law::dissipation:
      return WearLaw({.rate = dissipation_rate});
    case Law::power:
      return WearLaw({.rate = power_rate});
    case Law::running_in:
      return WearLaw({.rate = running_in_rate});
    case Law::threshold:
      break;
  }
  return WearLaw({.rate = threshold_rate, .kinks = 2, .switching = threshold_switching});
}

CounterShape<2> wavy_rail() {
  return profile(
      SplineCurve({{-3, -0.2}, {-1.2, 0.1}, {0.1, -0.1}, {1.3, 0.2}, {3, -0.3}}, false).reversed());
}

/// Near the origin, and bent there.
template <int dim>
CounterShape<dim> bent_shape(Meets meets) {
  const Vector<dim> up = Vector<dim>(Vector<dim>::LinSpaced(0.2, 1)).normalized();
  const Vector<dim> below = -2 * Vector<dim>::Unit(dim - 1) + 0.9 * Vector<dim>::Unit(0);
  if (meets == Meets::seat) return complement(cone<dim>(below, up, 1.1));
  if constexpr (dim == 2) {
    if (meets == Meets::rough_groove) return complement(ball<2>({0.2, 3.8}, 4));
    return wavy_rail();
  } else {
    if (meets == Meets::rough_groove) return complement(torus({0.2, -5, 2.8}, {0, 0.1, 1}, 5, 3));
    Tensor<3> frame;
    frame << Vector<3>(0.8, 0.6, 0), Vector<3>(0, 0, 1), Vector<3>(0.6, -0.8, 0);
    return extruded(wavy_rail(), {0.1, 0.2, 0.05}, frame);
  }
}

template <int dim>
ContactParameters<dim> parameters_of(Meets meets, NormalRule rule, Law law) {
  ContactParameters<dim> parameters;
  CounterBody<dim>& body = parameters.counter_body;
  parameters.rho = 3;
  parameters.wear = law_of(law);
  parameters.normal_rule = rule;
  body.motion.velocity = 2 * Vector<dim>::Unit(0);
  body.guide();
  if (meets == Meets::plane) return parameters;
  parameters.friction = meets == Meets::turning_ball || meets == Meets::seat ? 0 : 0.5;
  body.approach = Vector<dim>(Vector<dim>::LinSpaced(0.2, 1)).normalized();
  body.guide();
  if (meets == Meets::rough_plane) return parameters;
  const Vector<dim> centre = -4.1 * Vector<dim>::Unit(dim - 1) + 0.3 * Vector<dim>::Unit(0);
  body.shape = ball<dim>(centre, 4);
  body.position = 0.02 * Vector<dim>::Ones();
  if (meets == Meets::rough_ball) {
    body.motion.velocity.setZero();
    parameters.streaming = Vector<dim>::LinSpaced(2, 0.3);
    return parameters;
  }
  // About an axis near the centre, so that the surface moves by about 2.
  const Tensor<dim> spin = noise<Tensor<dim>>(0.6, 5) + 0.5 * Tensor<dim>::Identity();
  body.motion.spin = spin - spin.transpose();
  body.motion.spin(0, dim - 1) = 0.5, body.motion.spin(dim - 1, 0) = -0.5;
  if constexpr (dim == 3)
    if (meets == Meets::rough_turning_cylinder)
      body.shape = cylinder(centre, Vector<3>(0.2, 1, 0.1), 4);
  if (meets == Meets::seat || meets == Meets::rough_groove || meets == Meets::rough_turning_rail ||
      meets == Meets::rough_pivot)
    body.shape = bent_shape<dim>(meets);
  if (meets == Meets::rough_pivot) {
    body.guides.push_back({.along = Vector<dim>(Vector<dim>::LinSpaced(1, -0.5)).normalized()});
    body.guides.push_back({.turn = body.motion.spin / body.motion.spin.norm(), .centre = centre});
  }
  if (meets == Meets::rough_turning_rail) body.turning = Turning<dim>{body.motion.spin, centre};
  if (dim == 2 && meets == Meets::rough_across) {
    body.motion.across = 1.5;
    body.motion.across_by_x = 0.7 * Vector<dim>::LinSpaced(-1, 0.5);
  }
  return parameters;
}

template <int dim>
struct Fixture {
  static constexpr int centre = dim == 2 ? 1 : 4;
  Mesh<dim> mesh = wavy_surface<dim>();
  std::vector<ContactPatch<dim>> patches = contact_patches<dim>(mesh, mesh.boundary.at("contact"));
  ContactPatch<dim>& patch = patches[centre];
  int nodes = static_cast<int>(patch.nodes.size());
  ContactParameters<dim> parameters;
  ContactInput<dim> at;

  Eigen::Index guides() const {
    return static_cast<Eigen::Index>(parameters.counter_body.guides.size());
  }

  Fixture(bool active, NormalRule rule, Meets meets, Law law = Law::archard)
      : parameters(parameters_of<dim>(meets, rule, law)),
        at{PatchNodal<dim>(nodes, dim),
           PatchNodal<dim>(nodes, dim),
           active ? -30.0 : 20.0,
           PartnerMotion<>(0.07 * Eigen::VectorXd::LinSpaced(guides(), -2, 1)),
           {.time = 0.04}} {
    for (int p = 0; p < nodes; ++p) {
      at.X.row(p) =
          mesh.nodes[patch.nodes[p]].transpose() + noise<Vector<dim>>(0.05, 10 + p).transpose();
      at.u.row(p) = noise<Vector<dim>>(0.1, 40 + p).transpose();
    }
  }

  /// The tangent as matrices whose columns are X, u of the patch, lambda, q.
  struct Matrices {
    Eigen::MatrixXd force, velocity, constraint, partner;
  };
  Matrices tangent(const NodeBranch& branch = {}) const {
    const ContactNodeTangent<dim> t(parameters, patch, at, branch);
    const int lambda = 2 * dim * nodes, size = lambda + 1 + static_cast<int>(guides());
    Matrices m{Eigen::MatrixXd::Zero(dim, size),
               Eigen::MatrixXd::Zero(dim, size),
               Eigen::MatrixXd::Zero(1, size),
               {}};
    for (int p = 0; p < nodes; ++p) {
      const int X = dim * p, u = dim * (nodes + p);
      m.force.middleCols(X, dim) = t.force_by_X[p] + t.force_by_x[p];
      m.force.middleCols(u, dim) = t.force_by_x[p];
      m.velocity.middleCols(X, dim) = t.velocity_by_X[p] + t.velocity_by_x[p];
      m.velocity.middleCols(u, dim) = t.velocity_by_x[p];
    }
    for (int own : {0, dim * nodes})
      m.constraint.middleCols(own, dim) = t.constraint_by_x.transpose();
    m.force.col(lambda) = t.force_by_lambda;
    m.velocity.col(lambda) = t.velocity_by_lambda;
    m.constraint(0, lambda) = t.constraint_by_lambda;
    m.force.rightCols(guides()) = t.force_by_q;
    m.velocity.rightCols(guides()) = t.velocity_by_q;
    m.constraint.rightCols(guides()) = t.constraint_by_q;
    m.partner = -t.weights.transpose() * m.force;
    for (Eigen::Index k = 0; k < guides(); ++k) {
      if (t.partner_by[k].size() == 0) continue;
      for (int own : {0, dim * nodes})
        m.partner.row(k).segment(own, dim) += t.partner_by[k].head(dim);
      m.partner.row(k).tail(guides()) += t.partner_by[k].tail(guides());
    }
    return m;
  }
};

/// Automatic differentiation; a node that does not wear must have no derivative of its wear.
template <int dim>
void check_tangent(const Fixture<dim>& f, const NodeBranch& branch, bool active, bool wears) {
  const int lambda = 2 * dim * f.nodes, total = lambda + 1 + static_cast<int>(f.guides());
  const ContactNode<dim, Dual> node(
      f.parameters, f.patch,
      {independent(f.at.X, 0, total), independent(f.at.u, dim * f.nodes, total),
       Dual(f.at.lambda, total, lambda), independent(f.at.q, lambda + 1, total), f.at.moment},
      branch);
  ASSERT_EQ(node.active, active);
  const auto m = f.tangent(branch);
  const auto row = [&](const Dual& value) {
    Eigen::Matrix<Dual, 1, 1> single;
    single(0, 0) = value;
    return derivative_matrix(single, total);
  };
  expect_same_matrix(m.constraint, row(node.constraint), 1e-13);
  if (active) {
    expect_same_matrix(m.force, derivative_matrix(node.force, total), 1e-12);
    expect_same_matrix(m.partner, derivative_matrix(node.partner, total), 1e-12);
  } else {  // an open node exerts no force
    EXPECT_EQ(m.force.norm(), 0);
    EXPECT_EQ(node.force.squaredNorm(), Dual(0));  // the norm has no derivative there
  }
  if (wears) {
    expect_same_matrix(m.velocity, derivative_matrix(node.velocity, total), 1e-12);
  } else {
    EXPECT_EQ(m.velocity.norm(), 0);
    EXPECT_EQ(node.velocity.squaredNorm(), Dual(0));
  }
}

template <int dim>
void check_central_differences(Fixture<dim>& f, const NodeBranch& branch) {
  const auto m = f.tangent(branch);
  const double h = 1e-6;
  Eigen::MatrixXd force = 0 * m.force, velocity = 0 * m.velocity, partner = 0 * m.partner;
  const auto shifted = [&](int column, double shift) {
    ContactInput<dim> at = f.at;
    const int size = dim * f.nodes, k = column % size;
    (column < size        ? at.X(k / dim, k % dim)
     : column < 2 * size  ? at.u(k / dim, k % dim)
     : column == 2 * size ? at.lambda
                          : at.q[column - 2 * size - 1]) += shift;
    return ContactNode<dim>(f.parameters, f.patch, at, branch);
  };
  for (int column = 0; column < force.cols(); ++column) {
    const auto above = shifted(column, h), below = shifted(column, -h);
    force.col(column) = (above.force - below.force) / (2 * h);
    velocity.col(column) = (above.velocity - below.velocity) / (2 * h);
    partner.col(column) = (above.partner - below.partner) / (2 * h);
  }
  expect_same_matrix(m.force, force, 1e-7);
  expect_same_matrix(m.velocity, velocity, 1e-7);
  expect_same_matrix(m.partner, partner, 1e-7);
}

/// Along a plane (2D: line) that is oblique to all coordinate directions.
template <int dim>
Tensor<dim> oblique() {
  Vector<dim> across;
  for (int i = 0; i < dim; ++i) across[i] = 1.0 / (i + 1);
  across.normalize();
  return Tensor<dim>::Identity() - across * across.transpose();
}

/// Every rule, counter-body and law, for shapes that move freely and along a plane.
template <int dim>
void for_every_case(const std::function<void(Meets, NormalRule, Law, bool)>& check) {
  for (NormalRule rule : all_rules)
    for (Meets meets : all_meets)
      for (Law law : all_laws)
        for (bool held : {false, true}) {
          SCOPED_TRACE(::testing::Message()
                       << dim << "D, rule " << int(rule) << ", meets " << int(meets) << ", law "
                       << int(law) << ", held " << held);
          check(meets, rule, law, held);
        }
}

bool has_friction(Meets meets) {
  return meets != Meets::plane && meets != Meets::turning_ball && meets != Meets::seat;
}

template <int dim>
void check_every_tangent() {
  for_every_case<dim>([](Meets meets, NormalRule rule, Law law, bool held) {
    const bool rates = law != Law::dissipation || has_friction(meets);
    Fixture<dim> closed(true, rule, meets, law), open(false, rule, meets, law);
    if (held) closed.patch.shape_free = open.patch.shape_free = oblique<dim>();
    check_tangent<dim>(closed, {}, true, rates);
    check_tangent<dim>(closed, Branch::open, false, false);
    check_tangent<dim>(open, {}, false, false);
    check_tangent<dim>(open, Branch::closed, true, rates);  // tensile traction
    if (law != Law::threshold) return;
    for (const std::array<char, 2> wear : {std::array<char, 2>{1, 0}, {1, 1}})
      check_tangent<dim>(open, {Branch::closed, wear}, true, true);
    const std::array<char, 2> below = {0, 1};
    check_tangent<dim>(closed, {Branch::by_sign, below}, true, false);
  });
}

TEST(ContactNode, TangentEqualsAutomaticDifferentiation) {
  check_every_tangent<2>();
  check_every_tangent<3>();
}

template <int dim>
void check_every_difference() {
  for_every_case<dim>([](Meets meets, NormalRule rule, Law law, bool held) {
    if (law == Law::dissipation && !has_friction(meets)) return;
    Fixture<dim> closed(true, rule, meets, law), pulling(false, rule, meets, law);
    if (held) closed.patch.shape_free = pulling.patch.shape_free = oblique<dim>();
    check_central_differences<dim>(closed, {});
    const std::array<char, 2> wear = {1, 1};
    check_central_differences<dim>(pulling, {Branch::closed, wear});
  });
}

TEST(ContactNode, TangentEqualsCentralDifferences) {
  check_every_difference<2>();
  check_every_difference<3>();
}

// With a law that has kinks: lambda + rho g first, then the kinks of the law at p, which an open
// node does not have.
TEST(ContactNode, SwitchesWithContactAndWithTheWearLaw) {
  Fixture<3> f(true, NormalRule::averaged, Meets::rough_ball, Law::threshold);
  ASSERT_EQ(switching_functions(f.parameters), 3);
  const ContactNode<3> node(f.parameters, f.patch, f.at);
  const double depth =
      (f.patch.initial_position - f.at.X.row(0).transpose()).dot(f.patch.initial_normal);
  EXPECT_GT(std::abs(depth), 1e-3);
  std::array<double, 3> values{};
  contact_switching<3>(f.parameters, f.patch, f.at, {}, values);
  EXPECT_DOUBLE_EQ(values[0], f.at.lambda + f.parameters.rho * node.gap);
  EXPECT_DOUBLE_EQ(values[1], threshold_pressure + node.traction);
  EXPECT_NEAR(values[2], threshold_depth - depth, 1e-15);
  contact_switching<3>(f.parameters, f.patch, f.at, Branch::open, values);
  EXPECT_DOUBLE_EQ(values[1], threshold_pressure);
  f.at.lambda = 20;  // by its sign open
  contact_switching<3>(f.parameters, f.patch, f.at, {}, values);
  EXPECT_GT(values[0], 0);
  EXPECT_DOUBLE_EQ(values[1], threshold_pressure);
  contact_switching<3>(f.parameters, f.patch, f.at, Branch::closed, values);  // tensile traction
  EXPECT_NEAR(values[1], threshold_pressure + values[0], 1e-12);
}

// Sec. 3.1 by hand: under a pressure p the friction on the body opposes its sliding, so that the
// residual (minus the force on the body) has p friction along it; and the dissipation p friction v
// wears.
TEST(ContactNode, FrictionOpposesSlidingAndItsDissipationWears) {
  Fixture<3> f(true, NormalRule::averaged, Meets::rough_plane);
  f.parameters.counter_body.motion.velocity = Vector<3>(7, 0, 0);  // the body slides backwards by 7
  const ContactNode<3> node(f.parameters, f.patch, f.at);
  const double p = -node.traction;
  ASSERT_GT(p, 0);
  EXPECT_NEAR((node.force / node.area - p * Vector<3>(-0.5, 0, -1)).norm(), 0, 1e-13 * p);
  EXPECT_NEAR(node.wear_rate, 0.01 * p * 7, 1e-14 * p);
  f.parameters.wear = law_of(Law::dissipation);
  EXPECT_NEAR(ContactNode<3>(f.parameters, f.patch, f.at).wear_rate, node.wear_rate, 1e-14 * p);
}

// Sliding out of the plane by hand: the speed is the length of both parts, and the friction in the
// plane has its share of them. Without a part in the plane there is none.
TEST(ContactNode, SlidesOutOfThePlane) {
  Fixture<2> f(true, NormalRule::averaged, Meets::rough_plane);
  RigidMotion<2>& motion = f.parameters.counter_body.motion;
  motion.velocity = Vector<2>(3, 0);
  motion.across = -4;
  const ContactNode<2> node(f.parameters, f.patch, f.at);
  const double p = -node.traction;
  ASSERT_GT(p, 0);
  EXPECT_NEAR((node.force / node.area - p * Vector<2>(-0.3, -1)).norm(), 0, 1e-13 * p);
  EXPECT_NEAR(node.wear_rate, 0.01 * p * 5, 1e-14 * p);
  // About r = 0: omega r, at the node as the counter-body sees it, and its variance over the two
  // segments at the node, each of which is weighted by its length and has 1/6 of its square.
  motion = {};
  motion.across_by_x = Vector<2>(2, 0);
  const ContactNode<2> turning(f.parameters, f.patch, f.at);
  const Vector<2> x = (f.at.X + f.at.u).row(0).transpose();
  const double r = f.parameters.counter_body.seen(x, f.at.q[0])[0];
  double variance = 0, length = 0;
  for (int other : {0, 2}) {
    const Vector<2> e = f.mesh.nodes[other] - f.mesh.nodes[1];
    variance += e.norm() * std::pow(2 * e[0], 2) / 6;
    length += e.norm();
  }
  EXPECT_NEAR(turning.wear_rate, 0.01 * p * std::sqrt(4 * r * r + variance / length / 3),
              1e-14 * p);
  EXPECT_NEAR((turning.force / turning.area - p * Vector<2>(0, -1)).norm(), 0, 1e-13 * p);
}

// On the axis of a seat an open node needs no normal; a closed one has none, and says so.
TEST(ContactNode, RefusesAClosedNodeWithoutANormal) {
  Fixture<3> f(false, NormalRule::averaged, Meets::plane);
  f.parameters.counter_body.shape = complement(cone<3>({0, 0, -5}, {0, 0, 1}, 1.0));
  f.at.q[0] = 0;
  f.at.u.row(0) = Vector<3>(0, 0, 0.1).transpose() - f.at.X.row(0);
  const ContactNode<3> open(f.parameters, f.patch, f.at);
  EXPECT_FALSE(open.active);
  EXPECT_NEAR(open.gap, 5.1 * std::sin(1.0), 1e-14);
  EXPECT_NO_THROW(ContactNodeTangent<3>(f.parameters, f.patch, f.at));
  f.at.lambda = -30;
  EXPECT_THROW(ContactNode<3>(f.parameters, f.patch, f.at), RecoverableError);
  EXPECT_THROW(ContactNodeTangent<3>(f.parameters, f.patch, f.at), RecoverableError);
}

// Eq. (7): under a homogeneous deformation F every facet carries V over into F V, and eq. (6) takes
// its part in the tangent plane of the counter-body.
TEST(ContactNode, StreamingIsCarriedByTheDeformation) {
  Fixture<3> f(true, NormalRule::averaged, Meets::rough_ball);
  for (int p = 0; p < f.nodes; ++p) f.at.X(p, 2) = 0.1;  // flat: V lies in every facet
  f.parameters.streaming = Vector<3>(2, 1, 0);
  Tensor<3> F = Tensor<3>::Identity() + 0.3 * noise<Tensor<3>>(1, 3);
  f.at.u = f.at.X * (F - Tensor<3>::Identity()).transpose();
  const Vector<3> FV =
      streaming_velocity<3, double>(f.patch, f.at.X, f.at.X + f.at.u, f.parameters.streaming);
  EXPECT_NEAR((FV - F * Vector<3>(2, 1, 0)).norm(), 0, 1e-13);
  const Sliding<3> sliding(FV, Vector<3>(0, 0, 1));
  EXPECT_NEAR(sliding.speed, FV.head<2>().norm(), 1e-13);
  EXPECT_NEAR(sliding.direction[2], 0, 1e-15);
}

// Complementarity, eq. (9) and (26): a closed node requires g = 0 and transmits lambda + rho g; an
// open node requires lambda = 0 and transmits nothing.
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

// Nodal areas of a flat surface add up exactly to its area, and its nodal normal is the unit
// normal.
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

// Eq. (35): the averaged normal of a kink of half-angle a between equal segments has length cos a;
// the normalised one has length one and the same direction.
TEST(NodalSurface, NormalRulesAtAKink) {
  Mesh<2> mesh;
  const double angle = 0.3;
  mesh.nodes = {{-std::cos(angle), std::sin(angle)}, {0, 0}, {std::cos(angle), std::sin(angle)}};
  mesh.boundary["contact"] = {{0, 1}, {1, 2}};
  const auto patch = contact_patches<2>(mesh, mesh.boundary.at("contact"))[1];
  PatchNodal<2> X(3, 2);
  for (int p = 0; p < 3; ++p) X.row(p) = mesh.nodes[patch.nodes[p]].transpose();
  EXPECT_NEAR(
      (NodalSurface<2>(patch, X, NormalRule::averaged).normal - Vector<2>(0, -std::cos(angle)))
          .norm(),
      0, 1e-15);
  EXPECT_NEAR((NodalSurface<2>(patch, X, NormalRule::normalised).normal - Vector<2>(0, -1)).norm(),
              0, 1e-15);
}

// Eq. (35) weighs the facets with their initial lengths, 1 and 3, not with the present ones, 5
// and 1. By hand: N = 1/4 (-0.6, -0.8) + 3/4 (0, -1); weights of the current lengths would give
// (-0.5, -0.8333). The area is the current one.
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
}  // namespace gnomon::contact_node_test
