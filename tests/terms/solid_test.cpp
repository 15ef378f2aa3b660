#include <gnomon/terms/solid.hpp>

#include "support/derivatives.hpp"

namespace gnomon {
namespace {

using namespace testing;

const NeoHookean material = NeoHookean::from_young_poisson(7, 0.4);

template <int dim>
CellNodal<dim> reference_cell() {
  CellNodal<dim> X;
  for (int a = 0; a < (1 << dim); ++a) X.row(a) = reference_corner<dim>(a).transpose();
  return X;
}

template <int dim_, ElementKind kind_>
struct Case {
  static constexpr int dim = dim_;
  static constexpr ElementKind kind = kind_;
};

template <class C>
struct SolidTangent : ::testing::Test {
  static constexpr int dim = C::dim;
  static constexpr int local = dim * (1 << dim);
  CellNodal<dim> X = reference_cell<dim>() + noise<CellNodal<dim>>(0.2, 1);
  CellNodal<dim> u = noise<CellNodal<dim>>(0.3, 2);
  CellNodal<dim> R;
  CellMatrix<dim> K_u, K_d;
};
using Cases =
    ::testing::Types<Case<2, ElementKind::plain>, Case<2, ElementKind::f_bar>,
                     Case<2, ElementKind::f_bar_variational>, Case<2, ElementKind::small_plain>,
                     Case<2, ElementKind::small_f_bar>,
                     Case<2, ElementKind::small_f_bar_variational>, Case<3, ElementKind::plain>,
                     Case<3, ElementKind::f_bar>, Case<3, ElementKind::f_bar_variational>,
                     Case<3, ElementKind::small_plain>, Case<3, ElementKind::small_f_bar>,
                     Case<3, ElementKind::small_f_bar_variational>,
                     Case<2, ElementKind::plain_blatz_ko>, Case<3, ElementKind::plain_blatz_ko>>;
TYPED_TEST_SUITE(SolidTangent, Cases);

TYPED_TEST(SolidTangent, EqualsAutomaticDifferentiation) {
  constexpr int dim = TypeParam::dim, local = TestFixture::local;
  ASSERT_TRUE((solid_tangent<TypeParam::kind, true, dim>(material, this->X, this->u, this->R,
                                                         this->K_u, this->K_d)));
  CellNodal<dim, Dual> R;
  ASSERT_TRUE((solid_residual<TypeParam::kind, dim, Dual>(material, constant(this->X, local),
                                                          independent(this->u, 0, local), R)));
  expect_same_matrix(this->K_u, derivative_matrix(R, local), 1e-12);
  // d moves X and, at fixed u, x with it.
  ASSERT_TRUE((solid_residual<TypeParam::kind, dim, Dual>(material, independent(this->X, 0, local),
                                                          constant(this->u, local), R)));
  expect_same_matrix(this->K_d, derivative_matrix(R, local), 1e-12);
}

TYPED_TEST(SolidTangent, EqualsCentralDifferences) {
  constexpr int dim = TypeParam::dim, local = TestFixture::local;
  ASSERT_TRUE((solid_tangent<TypeParam::kind, true, dim>(material, this->X, this->u, this->R,
                                                         this->K_u, this->K_d)));
  const double h = 1e-6;
  Eigen::MatrixXd by_u(local, local), by_d(local, local);
  for (int k = 0; k < local; ++k) {
    const auto difference = [&](CellNodal<dim>& moved) {
      CellNodal<dim> plus, minus;
      double& value = moved(k / dim, k % dim);
      const double start = value;
      value = start + h;
      EXPECT_TRUE((solid_residual<TypeParam::kind, dim>(material, this->X, this->u, plus)));
      value = start - h;
      EXPECT_TRUE((solid_residual<TypeParam::kind, dim>(material, this->X, this->u, minus)));
      value = start;
      return Eigen::VectorXd((plus - minus).transpose().reshaped() / (2 * h));
    };
    by_u.col(k) = difference(this->u);
    by_d.col(k) = difference(this->X);
  }
  expect_same_matrix(this->K_u, by_u, 1e-7);
  expect_same_matrix(this->K_d, by_d, 1e-7);
}

TYPED_TEST(SolidTangent, ResidualAgreesWithTheOneOfTheTangent) {
  constexpr int dim = TypeParam::dim;
  CellNodal<dim> R;
  ASSERT_TRUE((solid_residual<TypeParam::kind, dim>(material, this->X, this->u, R)));
  ASSERT_TRUE((solid_tangent<TypeParam::kind, true, dim>(material, this->X, this->u, this->R,
                                                         this->K_u, this->K_d)));
  expect_same_matrix(this->R, R, 1e-13);
}

// A rotation; with small strains an infinitesimal one, which is exact there however large.
TYPED_TEST(SolidTangent, ARotationCausesNoForce) {
  constexpr int dim = TypeParam::dim;
  Tensor<dim> Q = Tensor<dim>::Identity();
  if (small_strain(TypeParam::kind))
    Q.template topLeftCorner<2, 2>() << 1, -0.7, 0.7, 1;
  else
    Q.template topLeftCorner<2, 2>() << std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7);
  const CellNodal<dim> u = this->X * Q.transpose() - this->X;
  CellNodal<dim> R;
  ASSERT_TRUE((solid_residual<TypeParam::kind, dim>(material, this->X, u, R)));
  EXPECT_LT(R.norm(), 1e-13);
}

// Patch condition: under a homogeneous deformation every kind gives P n integrated over the faces,
// so the nodal forces are the plain ones. The variational kinds need an affine cell in 3D: only
// there (and in any quadrilateral) is the gradient at the centroid the mean gradient.
TYPED_TEST(SolidTangent, HomogeneousDeformationIsThatOfThePlainCell) {
  constexpr int dim = TypeParam::dim;
  constexpr ElementKind plain_kind = small_strain(TypeParam::kind) ? ElementKind::small_plain
                                     : averaged(TypeParam::kind)   ? ElementKind::plain
                                                                   : TypeParam::kind;
  if (dim == 3 && variational(TypeParam::kind))
    this->X = reference_cell<dim>() * (Tensor<dim>::Identity() + noise<Tensor<dim>>(0.2, 6));
  const Tensor<dim> H = noise<Tensor<dim>>(0.2, 5);
  const CellNodal<dim> u = this->X * H.transpose();
  CellNodal<dim> R, plain;
  ASSERT_TRUE((solid_residual<TypeParam::kind, dim>(material, this->X, u, R)));
  ASSERT_TRUE((solid_residual<plain_kind, dim>(material, this->X, u, plain)));
  expect_same_matrix(R, plain, 1e-12);
}

/// Distance of the forces of a finite-strain kind and its small-strain limit at s times the noise.
template <int dim, ElementKind kind>
double distance_to_limit(double s) {
  const CellNodal<dim> X = reference_cell<dim>() + noise<CellNodal<dim>>(0.2, 1);
  const CellNodal<dim> u = s * noise<CellNodal<dim>>(0.3, 2);
  CellNodal<dim> finite, small;
  EXPECT_TRUE((solid_residual<kind, dim>(material, X, u, finite)));
  EXPECT_TRUE((solid_residual<small_strain_limit(kind), dim>(material, X, u, small)));
  return (finite - small).norm();
}

TEST(Solid, SmallStrainsAreTheFirstOrderOfFiniteOnes) {
  const auto check = []<ElementKind kind>() {
    const auto order = [](double coarse, double fine) { return std::log2(coarse / fine); };
    EXPECT_NEAR(order(distance_to_limit<2, kind>(2e-3), distance_to_limit<2, kind>(1e-3)), 2, 0.02);
    EXPECT_NEAR(order(distance_to_limit<3, kind>(2e-3), distance_to_limit<3, kind>(1e-3)), 2, 0.02);
  };
  check.operator()<ElementKind::plain>();
  check.operator()<ElementKind::f_bar>();
  check.operator()<ElementKind::f_bar_variational>();
}

TEST(Solid, SmallStrainStiffnessDoesNotDependOnTheDisplacement) {
  const CellNodal<3> X = reference_cell<3>() + noise<CellNodal<3>>(0.2, 1);
  for (ElementKind kind :
       {ElementKind::small_plain, ElementKind::small_f_bar, ElementKind::small_f_bar_variational}) {
    const auto kernel = SolidKernel<3>::of(kind);
    CellNodal<3> R;
    CellMatrix<3> one, other, K_d;
    // A displacement that would turn a finite-strain cell inside out.
    ASSERT_TRUE(kernel.tangent_u(material, X, noise<CellNodal<3>>(5, 2), R, one, K_d));
    ASSERT_TRUE(kernel.tangent_u(material, X, CellNodal<3>::Zero(), R, other, K_d));
    EXPECT_EQ(one, other);
    EXPECT_EQ(R.norm(), 0);
  }
}

template <int dim, ElementKind kind>
double asymmetry() {
  const CellNodal<dim> X = reference_cell<dim>() + noise<CellNodal<dim>>(0.2, 1);
  const CellNodal<dim> u = noise<CellNodal<dim>>(0.3, 2);
  CellNodal<dim> R;
  CellMatrix<dim> K, K_d;
  EXPECT_TRUE((solid_tangent<kind, false, dim>(material, X, u, R, K, K_d)));
  return (K - K.transpose()).norm() / K.norm();
}

// The variational element is the gradient of an energy, so K_u is symmetric; de Souza Neto's is
// not, except in plane strain with this law, where its pressure depends on the area alone and the
// area of a quadrilateral is four times the Jacobian at its centroid.
TEST(Solid, OnlyEnergiesGiveSymmetricTangents) {
  EXPECT_LT((asymmetry<3, ElementKind::plain>()), 1e-14);
  EXPECT_LT((asymmetry<3, ElementKind::f_bar_variational>()), 1e-14);
  EXPECT_LT((asymmetry<3, ElementKind::plain_blatz_ko>()), 1e-14);
  EXPECT_GT((asymmetry<3, ElementKind::f_bar>()), 1e-3);
  EXPECT_LT((asymmetry<2, ElementKind::f_bar>()), 1e-14);
  EXPECT_LT((asymmetry<3, ElementKind::small_plain>()), 1e-14);
  EXPECT_LT((asymmetry<3, ElementKind::small_f_bar_variational>()), 1e-14);
  EXPECT_GT((asymmetry<3, ElementKind::small_f_bar>()), 1e-3);
}

TEST(Solid, RefusesInvertedCells) {
  CellNodal<2> X = reference_cell<2>(), R;
  CellNodal<2> u = CellNodal<2>::Zero();
  EXPECT_TRUE((solid_residual<ElementKind::f_bar, 2>(material, X, u, R)));
  u(0, 0) = 5;
  EXPECT_FALSE((solid_residual<ElementKind::f_bar, 2>(material, X, u, R)));
  u.setZero();
  X(0, 0) = 5;
  EXPECT_FALSE((solid_residual<ElementKind::plain, 2>(material, X, u, R)));
  EXPECT_FALSE((solid_residual<ElementKind::small_plain, 2>(material, X, u, R)));
}

/// A finite-strain law at a point.
template <class Law>
class FiniteLaw : public ::testing::Test {};
template <template <int, class> class Point_>
struct Law {
  template <int dim, class Scalar = double>
  using Point = Point_<dim, Scalar>;
};
using FiniteLaws = ::testing::Types<Law<NeoHookeanPoint>, Law<BlatzKoPoint>>;
TYPED_TEST_SUITE(FiniteLaw, FiniteLaws);

TYPED_TEST(FiniteLaw, StressIsTheDerivativeOfTheEnergy) {
  const Tensor<3> F = Tensor<3>::Identity() + noise<Tensor<3>>(0.3, 3);
  using Point = TypeParam::template Point<3>;
  using DualPoint = TypeParam::template Point<3, Dual>;
  const auto energy = DualPoint(material, independent(F, 0, 9)).energy();
  expect_same_matrix(Point(material, F).stress().transpose().reshaped(), energy.derivatives(),
                     1e-13);
}

// Small uniaxial strain in plane strain: sigma = E (1 - nu) / ((1 + nu)(1 - 2 nu)) eps.
TYPED_TEST(FiniteLaw, LinearisesToHooke) {
  const double E = 7, nu = 0.4, strain = 1e-7;
  Tensor<2> F = Tensor<2>::Identity();
  F(0, 0) += strain;
  using Point = TypeParam::template Point<2>;
  const Tensor<2> P = Point(material, F).stress();
  EXPECT_NEAR(P(0, 0) / strain, E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), 1e-5);
  EXPECT_NEAR(P(1, 1) / strain, E * nu / ((1 + nu) * (1 - 2 * nu)), 1e-5);
}

// Uniaxial strain F = diag(1.2, 1, 1) by hand: sigma_22 = sigma_33 = lambda (J - 1), so von Mises
// is sigma_11 - sigma_22 = mu (1.2^2 - 1) / 1.2, with small strains 2 mu 0.2; without sigma_33 it
// would depend on lambda.
TEST(Solid, EquivalentStressOfUniaxialStrain) {
  const auto check = []<int dim>(ElementKind kind) {
    const CellNodal<dim> X = reference_cell<dim>() + noise<CellNodal<dim>>(0.2, 1);
    CellNodal<dim> u = CellNodal<dim>::Zero();
    u.col(0) = 0.2 * X.col(0);
    const double expected = small_strain(kind) ? 2 * 2.5 * 0.2 : 2.5 * 0.44 / 1.2;
    EXPECT_NEAR(equivalent_stress<dim>(kind, material, X, u), expected, 1e-13);
  };
  for (ElementKind kind :
       {ElementKind::plain, ElementKind::f_bar, ElementKind::f_bar_variational,
        ElementKind::small_plain, ElementKind::small_f_bar, ElementKind::small_f_bar_variational}) {
    check.operator()<2>(kind);
    check.operator()<3>(kind);
  }
}

TEST(Cell, VolumeAndQualityOfKnownShapes) {
  EXPECT_DOUBLE_EQ(cell_volume<2>(reference_cell<2>()), 4);
  EXPECT_DOUBLE_EQ(cell_volume<3>(reference_cell<3>()), 8);
  EXPECT_DOUBLE_EQ(scaled_jacobian<3>(reference_cell<3>()), 1);
  CellNodal<2> sheared = reference_cell<2>();
  sheared.col(0) += sheared.col(1);  // a parallelogram with 45 degrees: same area
  EXPECT_NEAR(cell_volume<2>(sheared), 4, 1e-14);
  EXPECT_NEAR(scaled_jacobian<2>(sheared), std::sqrt(0.5), 1e-14);
}

}  // namespace
}  // namespace gnomon
