// Elastic laws at one point, each against its definition.

#include <gnomon/laws/blatz_ko.hpp>
#include <gnomon/laws/linear_elastic.hpp>
#include <gnomon/laws/mooney_rivlin.hpp>
#include <gnomon/laws/neo_hookean.hpp>

#include "support/derivatives.hpp"
#include "support/test_material.hpp"

namespace gnomon::elastic_law_test {
namespace {

using namespace testing;

const ElasticModuli moduli = test_moduli();

template <int dim_, template <int, class> class Law>
struct Case {
  static constexpr int dim = dim_;
  static constexpr bool small = Law<dim, double>::kinematics == Kinematics::small;
  using T = Tensor<dim>;
  template <class Scalar = double>
  using Point = Law<dim, Scalar>;
  using InSpace = Law<3, double>;

  /// The unstrained state.
  static T rest() { return small ? T(T::Zero()) : T(T::Identity()); }
  static T strained(unsigned seed) { return rest() + noise<T>(0.3, seed); }
};

template <class C>
class ElasticLaw : public ::testing::Test {};
using Cases =
    ::testing::Types<Case<2, NeoHookeanPoint>, Case<3, NeoHookeanPoint>, Case<2, BlatzKoPoint>,
                     Case<3, BlatzKoPoint>, Case<2, MooneyRivlinPoint>, Case<3, MooneyRivlinPoint>,
                     Case<2, LinearElasticPoint>, Case<3, LinearElasticPoint>>;
TYPED_TEST_SUITE(ElasticLaw, Cases);

/// Value i, j of a tensor at row dim * i + j.
template <class T>
Eigen::VectorXd by_rows(const T& tensor) {
  return tensor.transpose().reshaped();
}

template <class C, class Function>
Eigen::MatrixXd central_differences(const typename C::T& F, const Function& values) {
  constexpr double h = 1e-5;
  Eigen::MatrixXd result(values(F).size(), F.size());
  for (int k = 0; k < F.size(); ++k) {
    typename C::T plus = F, minus = F;
    plus(k / C::dim, k % C::dim) += h;
    minus(k / C::dim, k % C::dim) -= h;
    result.col(k) = (values(plus) - values(minus)) / (2 * h);
  }
  return result;
}

template <class C>
Eigen::MatrixXd stress_changes(const typename C::T& F) {
  const typename C::template Point<> at(moduli, F);
  Eigen::MatrixXd result(F.size(), F.size());
  for (int k = 0; k < F.size(); ++k) {
    typename C::T dF = C::T::Zero();
    dF(k / C::dim, k % C::dim) = 1;
    result.col(k) = by_rows(typename C::T(at.stress_change(dF)));
  }
  return result;
}

TYPED_TEST(ElasticLaw, StressIsTheDerivativeOfTheEnergy) {
  using C = TypeParam;
  const auto F = C::strained(3);
  const Eigen::VectorXd P = by_rows(typename C::template Point<>(moduli, F).stress());
  EXPECT_GT(P.norm(), 0.1);  // not zero, so the test is meaningful
  const auto energy =
      typename C::template Point<Dual>(moduli, independent(F, 0, C::dim * C::dim)).energy();
  expect_same_matrix(P, energy.derivatives(), 1e-13);
  const Eigen::MatrixXd differences = central_differences<C>(F, [](const typename C::T& at) {
    return Eigen::VectorXd::Constant(1, typename C::template Point<>(moduli, at).energy()).eval();
  });
  expect_same_matrix(P.transpose(), differences, 1e-8);
}

TYPED_TEST(ElasticLaw, StressChangeIsTheDerivativeOfTheStress) {
  using C = TypeParam;
  const auto F = C::strained(3);
  const Eigen::MatrixXd changes = stress_changes<C>(F);
  EXPECT_GT(changes.norm(), 0.1);
  const auto P =
      typename C::template Point<Dual>(moduli, independent(F, 0, C::dim * C::dim)).stress();
  expect_same_matrix(changes, derivative_matrix(P, C::dim * C::dim), 1e-12);
  const Eigen::MatrixXd differences = central_differences<C>(F, [](const typename C::T& at) {
    return by_rows(typename C::template Point<>(moduli, at).stress());
  });
  expect_same_matrix(changes, differences, 1e-8);
  // The variational element relies on it.
  expect_same_matrix(changes, changes.transpose(), 1e-13);
}

TYPED_TEST(ElasticLaw, IsObjective) {
  using C = TypeParam;
  const auto F = C::strained(4);
  typename C::T Q = C::T::Identity();
  if constexpr (C::small) {  // an infinitesimal rotation
    const typename C::T W = noise<typename C::T>(0.3, 5);
    const auto P = typename C::template Point<>(moduli, F).stress();
    expect_same_matrix(typename C::template Point<>(moduli, F + W - W.transpose()).stress(), P,
                       1e-13);
  } else {
    Q = Eigen::HouseholderQR<typename C::T>(noise<typename C::T>(1, 5)).householderQ();
    if (Q.determinant() < 0) Q.col(0) *= -1;
    EXPECT_GT((Q - C::T::Identity()).norm(), 0.1);
    expect_same_matrix(typename C::template Point<>(moduli, Q * F).stress(),
                       Q * typename C::template Point<>(moduli, F).stress(), 1e-13);
  }
}

TYPED_TEST(ElasticLaw, HasNoStressAtRestAndTheGivenLinearisation) {
  using C = TypeParam;
  const auto rest = C::rest();
  EXPECT_LT((typename C::template Point<>(moduli, rest).stress().norm()), 1e-14);
  EXPECT_NEAR((typename C::template Point<>(moduli, rest).energy()), 0, 1e-14);
  const auto dF = noise<typename C::T>(1, 6);
  const typename C::T hooke =
      moduli.lambda * dF.trace() * C::T::Identity() + moduli.mu * (dF + dF.transpose());
  expect_same_matrix((typename C::template Point<>(moduli, rest).stress_change(dF)), hooke, 1e-13);
}

TYPED_TEST(ElasticLaw, ThePlaneIsTheStateOfPlaneStrain) {
  using C = TypeParam;
  if constexpr (C::dim == 2) {
    const auto F = C::strained(7), dF = noise<Tensor<2>>(1, 8);
    Tensor<3> whole = C::small ? Tensor<3>(Tensor<3>::Zero()) : Tensor<3>(Tensor<3>::Identity());
    Tensor<3> change = Tensor<3>::Zero();
    whole.topLeftCorner<2, 2>() = F;
    change.topLeftCorner<2, 2>() = dF;
    const typename C::template Point<> plane(moduli, F);
    const typename C::InSpace space(moduli, whole);
    const Tensor<3> P = space.stress(), dP = space.stress_change(change);
    expect_same_matrix(plane.stress(), P.topLeftCorner<2, 2>(), 1e-13);
    expect_same_matrix(plane.stress_change(dF), dP.topLeftCorner<2, 2>(), 1e-13);
    EXPECT_NEAR(plane.energy(), space.energy(), 1e-13 * space.energy());
  }
}

TYPED_TEST(ElasticLaw, DyadsAreThoseOfTheStressChange) {
  using C = TypeParam;
  using Point = typename C::template Point<>;
  constexpr bool general = std::is_same_v<C, Case<C::dim, MooneyRivlinPoint>>;
  static_assert(DyadicPoint<Point> == !general);
  if constexpr (!general) {
    const auto F = C::strained(9), dF = noise<typename C::T>(1, 10);
    const Point at(moduli, F);
    const typename C::T G =
        C::small ? typename C::T(C::T::Identity()) : typename C::T(F.inverse().transpose());
    const typename C::T sum = at.shear() * dF + at.volumetric() * G.cwiseProduct(dF).sum() * G +
                              at.geometric() * G * dF.transpose() * G;
    expect_same_matrix(at.stress_change(dF), sum, 1e-13);
  }
}

Tensor<3> cauchy(const ElasticModuli& of, const Tensor<3>& F) {
  return MooneyRivlinPoint<3>(of, F).stress() * F.transpose() / F.determinant();
}

// Simple shear g in an incompressible state: sigma = 2 C10 B - 2 C01 B^-1 - p I, thus
// sigma_12 = mu g for every ratio, sigma_11 - sigma_22 = mu g^2 (Rivlin's universal relation:
// g sigma_12), and sigma_33 - sigma_22 = 2 C01 g^2, which eq. (38) does not have.
TEST(MooneyRivlin, SimpleShear) {
  const double g = 0.6, C01 = 0.3 * moduli.mu / 2;
  Tensor<3> F = Tensor<3>::Identity();
  F(0, 1) = g;
  const Tensor<3> sigma = cauchy(moduli, F);
  EXPECT_NEAR(sigma(0, 1), moduli.mu * g, 1e-13);
  EXPECT_NEAR(sigma(0, 0) - sigma(1, 1), moduli.mu * g * g, 1e-13);
  EXPECT_NEAR(sigma(2, 2) - sigma(1, 1), 2 * C01 * g * g, 1e-13);
}

TEST(MooneyRivlin, WithoutTheSecondInvariantIsNeoHookean) {
  ElasticModuli without = moduli;
  without.ratios[0] = 0;
  const Tensor<3> F = Tensor<3>::Identity() + noise<Tensor<3>>(0.3, 11);
  expect_same_matrix(MooneyRivlinPoint<3>(without, F).stress(),
                     NeoHookeanPoint<3>(without, F).stress(), 1e-14);
  EXPECT_GT(
      (MooneyRivlinPoint<3>(moduli, F).stress() - NeoHookeanPoint<3>(moduli, F).stress()).norm(),
      0.01);
}

TEST(ElasticModuli, OfEngineeringConstants) {
  const ElasticModuli hooke = ElasticModuli::from_young_poisson(7, 0.4);
  EXPECT_DOUBLE_EQ(hooke.mu, 2.5);
  EXPECT_NEAR(hooke.lambda, 10, 1e-13);
  EXPECT_NEAR(hooke.young_modulus(), 7, 1e-13);
  const ElasticModuli twice = moduli.scaled(2);
  EXPECT_EQ(twice.mu, 2 * moduli.mu);
  EXPECT_EQ(twice.lambda, 2 * moduli.lambda);
  EXPECT_EQ(twice.ratios, moduli.ratios);  // no unit
}

}  // namespace
}  // namespace gnomon::elastic_law_test
