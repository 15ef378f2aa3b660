// Elements of bodies of revolution: derivatives, energy, homogeneous states, and limits.

#include <gnomon/laws/blatz_ko.hpp>
#include <gnomon/laws/mooney_rivlin.hpp>
#include <gnomon/laws/neo_hookean.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/meridian_kernels.hpp>

#include "support/derivatives.hpp"
#include "support/test_material.hpp"

namespace gnomon::meridian_kernel_test {
namespace {

using namespace testing;

constexpr std::array technologies = {ElementTechnology::plain, ElementTechnology::f_bar,
                                     ElementTechnology::f_bar_variational};

/// Distorted, of size 2; at an inner radius.
CellNodal<2> cell_at(double inner) {
  CellNodal<2> X;
  for (int a = 0; a < 4; ++a) X.row(a) = reference_corner<2>(a).transpose();
  X += noise<CellNodal<2>>(0.2, 1);
  X.col(0).array() += 1 + inner;
  if (inner == 0)
    for (int a : {0, 3}) X(a, 0) = 0;
  return X;
}

CellNodal<2> displacement_at(double inner) {
  CellNodal<2> u = noise<CellNodal<2>>(0.15, 2);
  if (inner == 0)
    for (int a : {0, 3}) u(a, 0) = 0;
  return u;
}

/// Of one size: the zeros of F, constants without derivatives, could not be subtracted otherwise.
using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, 16, 1>>;

template <ElementTechnology technology, template <int, class> class Law>
void check_automatic() {
  const ElasticModuli moduli = test_moduli();
  for (const double inner : {0.0, 0.5, 3.0}) {
    const CellNodal<2> X = cell_at(inner), u = displacement_at(inner);
    CellNodal<2, Number> R;
    ASSERT_TRUE((meridian_residual<technology, Law, Number>(moduli, independent<Number>(X, 0, 16),
                                                            independent<Number>(u, 8, 16), R)));
    CellNodal<2> value, alone;
    CellMatrix<2> K_u, K_d, K_alone, untouched = CellMatrix<2>::Constant(3);
    ASSERT_TRUE((meridian_tangent<technology, Law, true>(moduli, X, u, value, K_u, K_d)));
    ASSERT_TRUE(
        (meridian_tangent<technology, Law, false>(moduli, X, u, alone, K_alone, untouched)));
    const Eigen::MatrixXd K = derivative_matrix(R, 16);
    expect_same_matrix(value, R.unaryExpr([](const Number& entry) { return entry.value(); }),
                       1e-13);
    expect_same_matrix(K_u, K.rightCols(8), 1e-12);
    expect_same_matrix(K_d, K.leftCols(8), 1e-12);
    EXPECT_EQ(alone, value);
    EXPECT_EQ(K_alone, K_u);
    EXPECT_EQ(untouched, CellMatrix<2>::Constant(3));
  }
}

template <template <int, class> class Law>
void check_automatic_of_law() {
  check_automatic<ElementTechnology::plain, Law>();
  check_automatic<ElementTechnology::f_bar, Law>();
  check_automatic<ElementTechnology::f_bar_variational, Law>();
}

TEST(Meridian, TangentsEqualAutomaticDifferentiation) {
  check_automatic_of_law<NeoHookeanPoint>();
  check_automatic_of_law<BlatzKoPoint>();
  check_automatic_of_law<MooneyRivlinPoint>();
  check_automatic_of_law<LinearElasticPoint>();
}

// The kernels that bodies use, of every registered law.
TEST(Meridian, TangentsEqualCentralDifferences) {
  for (const std::string& law : MaterialLaws::names())
    for (const auto technology : technologies)
      for (const auto kinematics : {Kinematics::finite, Kinematics::small}) {
        SCOPED_TRACE(law + " " + technology_names[static_cast<std::size_t>(technology)]);
        const Material material = make_material(law, test_moduli());
        const auto& kernel = material.kernel<2>({technology, kinematics, Section::meridian});
        CellNodal<2> X = cell_at(0), u = displacement_at(0), R;
        CellMatrix<2> K_u, K_d;
        ASSERT_TRUE(kernel.tangent_ud(material.moduli, X, u, R, K_u, K_d));
        expect_same_matrix(K_u, residual_differences<2>(kernel, material.moduli, X, u, u), 1e-7);
        expect_same_matrix(K_d, residual_differences<2>(kernel, material.moduli, X, u, X), 1e-7);
      }
}

/// Energy of the body of revolution, with the strain of the technology.
template <ElementTechnology technology, template <int, class> class Law>
double energy(const CellNodal<2>& X, const CellNodal<2>& u) {
  const MeridianCell<> cell(X, u);
  const MeridianMean<> mean(cell, Law<3, double>::kinematics);
  double sum = 0;
  for (const auto& point : cell.points())
    sum += point.volume * LawInCell<technology, Law, 3>(test_moduli(), mean, point).law.energy();
  return sum;
}

template <ElementTechnology technology, template <int, class> class Law>
void check_energy() {
  const CellNodal<2> X = cell_at(0.5);
  CellNodal<2> u = displacement_at(0.5), R, differences;
  ASSERT_TRUE((meridian_residual<technology, Law, double>(test_moduli(), X, u, R)));
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 2; ++i) {
      const double start = u(a, i), h = 1e-6;
      u(a, i) = start + h;
      const double above = energy<technology, Law>(X, u);
      u(a, i) = start - h;
      differences(a, i) = (above - energy<technology, Law>(X, u)) / (2 * h);
      u(a, i) = start;
    }
  expect_same_matrix(R, differences, 1e-8);
}

TEST(Meridian, PlainAndVariationalForcesAreThoseOfTheEnergy) {
  check_energy<ElementTechnology::plain, NeoHookeanPoint>();
  check_energy<ElementTechnology::plain, LinearElasticPoint>();
  check_energy<ElementTechnology::f_bar_variational, NeoHookeanPoint>();
  check_energy<ElementTechnology::f_bar_variational, MooneyRivlinPoint>();
  check_energy<ElementTechnology::f_bar_variational, LinearElasticPoint>();
}

// With small strains the pressure of a cell is uniform, and its work on g0_a - g_a is zero because
// g0_a is the mean: then both F-bar elements are one, and symmetric.
TEST(Meridian, WithSmallStrainsBothFBarElementsAreOne) {
  const CellNodal<2> X = cell_at(0), u = displacement_at(0);
  CellNodal<2> R, R_variational;
  CellMatrix<2> K, K_d, K_variational, K_d_variational;
  ASSERT_TRUE((meridian_tangent<ElementTechnology::f_bar, LinearElasticPoint, true>(
      test_moduli(), X, u, R, K, K_d)));
  ASSERT_TRUE((meridian_tangent<ElementTechnology::f_bar_variational, LinearElasticPoint, true>(
      test_moduli(), X, u, R_variational, K_variational, K_d_variational)));
  expect_same_matrix(R, R_variational, 1e-13);
  expect_same_matrix(K, K_variational, 1e-13);
  expect_same_matrix(K_d, K_d_variational, 1e-13);
  expect_same_matrix(K, K.transpose(), 1e-13);
}

// Far from the axis, per circumference, the plain element is that of plane strain.
TEST(Meridian, FarFromTheAxisIsPlaneStrain) {
  const double far = 1e6;
  const Material material = make_material("neo-hookean", test_moduli());
  for (const auto kinematics : {Kinematics::finite, Kinematics::small}) {
    const Element plane{ElementTechnology::plain, kinematics},
        revolved{ElementTechnology::plain, kinematics, Section::meridian};
    const CellNodal<2> X = cell_at(far), u = displacement_at(far);
    CellNodal<2> R, R_plane;
    CellMatrix<2> K, K_plane, K_d;
    ASSERT_TRUE(material.kernel<2>(plane).tangent_u(material.moduli, X, u, R_plane, K_plane, K_d));
    ASSERT_TRUE(material.kernel<2>(revolved).tangent_u(material.moduli, X, u, R, K, K_d));
    expect_same_matrix(R / (2 * M_PI * far), R_plane, 5e-6);
    expect_same_matrix(K / (2 * M_PI * far), K_plane, 5e-6);
    EXPECT_NEAR(equivalent_stress<2>(revolved, material, X, u),
                equivalent_stress<2>(plane, material, X, u), 1e-5);
  }
}

// u_r = a r, u_z = c z: stretches are known, also those to the circumference.
TEST(Meridian, StressOfAHomogeneousState) {
  const double a = 0.1, c = -0.2;
  const Material material = make_material("neo-hookean", test_moduli());
  for (const auto technology : technologies) {
    const CellNodal<2> X = cell_at(0);
    CellNodal<2> u = X;
    u.col(0) *= a, u.col(1) *= c;
    const double mu = material.moduli.mu, r = 1 + a, z = 1 + c;
    const auto stress = [&](Kinematics kinematics) {
      return equivalent_stress<2>({technology, kinematics, Section::meridian}, material, X, u);
    };
    EXPECT_NEAR(stress(Kinematics::small), 2 * mu * (a - c), 1e-12);
    EXPECT_NEAR(stress(Kinematics::finite), mu * (r * r - z * z) / (r * r * z), 1e-12);
  }
}

TEST(Meridian, VolumeIsThatOfTheRevolution) {
  CellNodal<2> X;  // a triangle with a node on one side: Pappus and Guldin
  X << 1, 0, 3, 0, 2, 2, 1.5, 1;
  EXPECT_NEAR(cell_volume<2>(X, Section::meridian), 2 * M_PI * 2 * 2, 1e-13);
  EXPECT_NEAR(cell_volume<2>(X), 2, 1e-14);
}

TEST(Meridian, InvertedCellsHaveNoResidual) {
  const Material material = make_material("neo-hookean", test_moduli());
  const auto& finite =
      material.kernel<2>({ElementTechnology::f_bar, Kinematics::finite, Section::meridian});
  const CellNodal<2> X = cell_at(0.5);
  CellNodal<2> u = CellNodal<2>::Zero(), R;
  u.col(0) = -2 * X.col(0);  // turned inside out: J > 0 again, if the hoop were not looked at
  EXPECT_FALSE(finite.residual(material.moduli, X, u, R));
  u.col(0) = -0.9 * X.col(0);
  EXPECT_TRUE(finite.residual(material.moduli, X, u, R));
  CellNodal<2> left = X;
  left.col(0).array() -= 5;  // beyond the axis
  EXPECT_FALSE(finite.residual(material.moduli, left, CellNodal<2>::Zero(), R));
}

}  // namespace
}  // namespace gnomon::meridian_kernel_test
