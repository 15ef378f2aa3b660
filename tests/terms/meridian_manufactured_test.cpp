// Manufactured solutions of the elements of bodies of revolution, as in manufactured_test.cpp: a
// displacement that is smooth also on the axis, the body force that holds it by automatic
// differentiation, and errors that fall as h^2 (displacement) and h (gradient).

#include <gnomon/laws/linear_elastic.hpp>
#include <gnomon/laws/mooney_rivlin.hpp>
#include <gnomon/laws/neo_hookean.hpp>
#include <gnomon/mesh/distortion.hpp>
#include <gnomon/terms/material.hpp>

#include "support/derivatives.hpp"
#include "support/static_solve.hpp"
#include "support/test_material.hpp"

namespace gnomon::meridian_manufactured_test {
namespace {

using namespace testing;

const ElasticModuli moduli = test_moduli(0.3);

using Jet = Eigen::AutoDiffScalar<Eigen::Vector2d>;

/// u_r = r/6 sin(r^2 + 2 z + 1/2), u_z = sin(2 r^2 - z + 1)/8: odd and even in r.
Vector<2> displacement(const Vector<2>& X) {
  const double r = X[0], z = X[1];
  return {r / 6 * std::sin(r * r + 2 * z + 0.5), std::sin(2 * r * r - z + 1) / 8};
}
template <class Scalar>
Tensor<3, Scalar> gradient(const Scalar& r, const Scalar& z) {
  using std::cos, std::sin;
  const Scalar phase = r * r + 2.0 * z + 0.5, slope = cos(Scalar(2.0 * r * r - z + 1.0)) / 8.0;
  Tensor<3, Scalar> H = Tensor<3, Scalar>::Zero();
  H(2, 2) = sin(phase) / 6.0;
  H(0, 0) = H(2, 2) + r * r * cos(phase) / 3.0;
  H(0, 1) = r * cos(phase) / 3.0;
  H(1, 0) = 4.0 * r * slope;
  H(1, 1) = -slope;
  return H;
}

/// - Div P in cylindrical coordinates.
template <template <int, class> class Law>
Vector<2> body_force(const Vector<2>& X) {
  Tensor<3, Jet> strain = gradient(Jet(X[0], 2, 0), Jet(X[1], 2, 1));
  if (Law<3, Jet>::kinematics == Kinematics::finite)
    for (int i = 0; i < 3; ++i) strain(i, i) += 1.0;
  const Tensor<3, Jet> P = Law<3, Jet>(moduli, strain).stress();
  Vector<2> force;
  for (int i = 0; i < 2; ++i) {
    const double hoop = i == 0 ? P(2, 2).value() : 0;
    force[i] =
        -P(i, 0).derivatives()[0] - P(i, 1).derivatives()[1] - (P(i, 0).value() - hoop) / X[0];
  }
  return force;
}

/// visit(X, N, dN/dX, 2 pi r dA) at three by three Gauss points.
template <class Visit>
void at_quadrature_points(const CellNodal<2>& X, const Visit& visit) {
  constexpr double place[] = {-0.7745966692414834, 0, 0.7745966692414834};
  constexpr double weight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (int p = 0; p < 9; ++p) {
    const Vector<2> xi(place[p % 3], place[p / 3]);
    const auto N = basis_values<2>(xi);
    const CellNodal<2> dN = basis_gradients<2>(xi);
    const Tensor<2> A = X.transpose() * dN;
    const Vector<2> at = X.transpose() * N;
    visit(at, N, CellNodal<2>(dN * A.inverse()),
          2 * M_PI * at[0] * weight[p % 3] * weight[p / 3] * A.determinant());
  }
}

struct Errors {
  double displacement = 0, gradient = 0;
};

/// On n x n elements of the cylinder r < 1, 0 < z < 1; exact displacement at the boundary but the
/// axis, where u_z is free.
template <template <int, class> class Law>
Errors errors(const std::string& law, ElementTechnology technology, int n, bool distorted) {
  Mesh<2> mesh =
      structured_quadrilaterals(n, n, [](double s, double t) { return Vector<2>(s, t); });
  if (distorted) distort(mesh, 0.15);
  const auto nodes = static_cast<Eigen::Index>(mesh.nodes.size());
  NodalFlags<2> held = NodalFlags<2>::Zero(nodes, 2);
  for (int node : axis_nodes(mesh)) held(node, 0) = 1;
  for (const char* part : {"bottom", "top", "right"})
    for (int node : mesh.boundary_nodes(part)) held.row(node).setOnes();
  NodalField<2> u(nodes, 2), load = NodalField<2>::Zero(nodes, 2);
  for (Eigen::Index k = 0; k < nodes; ++k) u.row(k) = displacement(mesh.nodes[k]).transpose();
  for (const auto& cell : mesh.cells)
    at_quadrature_points(mesh.positions(cell),
                         [&](const Vector<2>& X, const auto& N, const auto&, double w) {
                           const Vector<2> force = w * body_force<Law>(X);
                           for (int a = 0; a < 4; ++a)
                             load.row(cell[a]) += N[a] * force.transpose();
                         });
  solve_statically<2>(mesh, make_material(law, moduli),
                      {technology, Law<3, double>::kinematics, Section::meridian}, held, load, u);
  Errors sum;
  for (const auto& cell : mesh.cells) {
    CellNodal<2> nodal;
    for (int a = 0; a < 4; ++a) nodal.row(a) = u.row(cell[a]);
    at_quadrature_points(mesh.positions(cell), [&](const Vector<2>& X, const auto& N,
                                                   const CellNodal<2>& n_a, double w) {
      const Vector<2> at = nodal.transpose() * N;
      const Tensor<2> slope = nodal.transpose() * n_a;
      const Tensor<3> exact = gradient(X[0], X[1]);
      const double hoop = at[0] / X[0] - exact(2, 2);
      sum.displacement += w * (at - displacement(X)).squaredNorm();
      sum.gradient += w * ((slope - exact.topLeftCorner<2, 2>()).squaredNorm() + hoop * hoop);
    });
  }
  return {std::sqrt(sum.displacement), std::sqrt(sum.gradient)};
}

template <template <int, class> class Law>
void check_orders(const std::string& law) {
  for (const bool distorted : {false, true})
    for (const auto technology : {ElementTechnology::plain, ElementTechnology::f_bar,
                                  ElementTechnology::f_bar_variational}) {
      SCOPED_TRACE(technology_names[static_cast<std::size_t>(technology)]);
      SCOPED_TRACE(distorted ? "distorted" : "regular");
      const Errors coarse = errors<Law>(law, technology, 16, distorted),
                   fine = errors<Law>(law, technology, 32, distorted);
      EXPECT_GT(fine.displacement, 1e-7);
      EXPECT_NEAR(std::log2(coarse.displacement / fine.displacement), 2, 0.15);
      EXPECT_NEAR(std::log2(coarse.gradient / fine.gradient), 1, 0.15);
    }
}

TEST(MeridianManufactured, FiniteStrains) {
  check_orders<NeoHookeanPoint>("neo-hookean");
}
TEST(MeridianManufactured, SmallStrains) {
  check_orders<LinearElasticPoint>("neo-hookean");
}
TEST(MeridianManufactured, AGeneralLaw) {
  check_orders<MooneyRivlinPoint>("mooney-rivlin");
}

}  // namespace
}  // namespace gnomon::meridian_manufactured_test
