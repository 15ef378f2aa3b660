// Every registered material in every element, and materials as scenes choose them.

#include <gmock/gmock.h>

#include <gnomon/base/error.hpp>
#include <gnomon/terms/material_law.hpp>

#include "support/derivatives.hpp"
#include "support/pin.hpp"
#include "support/test_material.hpp"

namespace gnomon::material_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// Every law, technology and kinematics, including laws that a test registers.
struct Combination {
  std::string law;
  Element element;
};

std::vector<Combination> combinations() {
  std::vector<Combination> result;
  for (const std::string& law : MaterialLaws::names())
    for (const auto technology :
         {ElementTechnology::plain, ElementTechnology::f_bar, ElementTechnology::f_bar_variational})
      for (const auto kinematics : {Kinematics::finite, Kinematics::small})
        result.push_back({law, {technology, kinematics}});
  return result;
}

std::string name_of(const ::testing::TestParamInfo<Combination>& info) {
  const auto& [law, element] = info.param;
  std::string name = law + "_" + technology_names[static_cast<std::size_t>(element.technology)] +
                     (element.kinematics == Kinematics::small ? "_small" : "_finite");
  std::ranges::replace(name, '-', '_');
  return name;
}

template <int dim>
void check_tangents(const Combination& combination) {
  const Material material = make_material(combination.law, test_moduli());
  const auto& kernel = material.kernel<dim>(combination.element);
  CellNodal<dim> X, u = noise<CellNodal<dim>>(0.2, 2), R, R_u, expected;
  for (int a = 0; a < (1 << dim); ++a) X.row(a) = reference_corner<dim>(a).transpose();
  X += noise<CellNodal<dim>>(0.2, 1);
  CellMatrix<dim> K_u, K_d, K_u_alone, untouched = CellMatrix<dim>::Constant(3);
  ASSERT_TRUE(kernel.residual(material.moduli, X, u, expected));
  ASSERT_TRUE(kernel.tangent_ud(material.moduli, X, u, R, K_u, K_d));
  ASSERT_TRUE(kernel.tangent_u(material.moduli, X, u, R_u, K_u_alone, untouched));
  EXPECT_GT(K_u.norm(), 1);
  EXPECT_GT(K_d.norm(), 0.1);
  expect_same_matrix(R, expected, 1e-13);
  EXPECT_EQ(R_u, R);
  EXPECT_EQ(K_u_alone, K_u);
  EXPECT_EQ(untouched, (CellMatrix<dim>::Constant(3)));
  expect_same_matrix(K_u, residual_differences<dim>(kernel, material.moduli, X, u, u), 1e-7);
  expect_same_matrix(K_d, residual_differences<dim>(kernel, material.moduli, X, u, X), 1e-7);
}

class MaterialInElement : public ::testing::TestWithParam<Combination> {};
INSTANTIATE_TEST_SUITE_P(Every, MaterialInElement, ::testing::ValuesIn(combinations()), name_of);

TEST_P(MaterialInElement, TangentsEqualCentralDifferences) {
  check_tangents<2>(GetParam());
  check_tangents<3>(GetParam());
}

// With small strains every material uses the elements of its linearization.
TEST(Material, SmallStrainsAreThoseOfTheLinearLaw) {
  const ElasticModuli moduli = test_moduli();
  for (const std::string& law : MaterialLaws::names()) {
    const Material material = make_material(law, moduli);
    EXPECT_EQ(&material.kernel<3>({ElementTechnology::plain, Kinematics::small}),
              &small_strain_kernels.of<3>(ElementTechnology::plain));
    CellNodal<3> X, R;
    for (int a = 0; a < 8; ++a) X.row(a) = reference_corner<3>(a).transpose();
    CellMatrix<3> finite, small, K_d;
    for (const auto technology : {ElementTechnology::plain, ElementTechnology::f_bar,
                                  ElementTechnology::f_bar_variational}) {
      const auto stiffness = [&](Kinematics kinematics, CellMatrix<3>& K) {
        const auto& kernel = material.kernel<3>({technology, kinematics});
        EXPECT_TRUE(kernel.tangent_u(moduli, X, CellNodal<3>::Zero(), R, K, K_d));
      };
      stiffness(Kinematics::finite, finite);
      stiffness(Kinematics::small, small);
      expect_same_matrix(finite, small, 1e-13);
    }
  }
}

Material of_scene(const Overrides& overrides, const std::string& choice = "body.material") {
  return read_material(pin_scene(overrides), choice);
}

TEST(Material, ComesFromTheSceneWithItsKeys) {
  const Material paper = of_scene({});
  EXPECT_EQ(paper.finite_kernels, make_material("neo-hookean", {}).finite_kernels);
  EXPECT_NEAR(paper.moduli.young_modulus(), pin_scene().real("body.young_modulus"), 1e-9);
  EXPECT_EQ(paper.moduli.ratios[0], 0);
  const Overrides mooney = {"body.material=mooney-rivlin", "body.poisson_ratio=0.4"};
  EXPECT_EQ(of_scene(mooney).moduli.ratios[0], 0.2);
  const Material more = of_scene({mooney[0], mooney[1], "body.mooney_ratio=0.35"});
  EXPECT_EQ(more.finite_kernels, make_material("mooney-rivlin", {}).finite_kernels);
  EXPECT_EQ(more.moduli.ratios[0], 0.35);
  // The mesh motion has its own.
  const Overrides shape = {"shape.energy=mooney-rivlin", "shape.mooney_ratio=0.1"};
  EXPECT_EQ(of_scene(shape, "shape.energy").moduli.ratios[0], 0.1);
  EXPECT_EQ(of_scene(shape).finite_kernels, paper.finite_kernels);
}

void expect_refused(const Overrides& overrides, const std::string& message) {
  try {
    of_scene(overrides);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(message));
  }
}

TEST(Material, RefusesWhatDoesNotFit) {
  expect_refused({"body.material=neohookean"}, "did you mean \"neo-hookean\"?");
  expect_refused({"body.mooney_ratio=0.1"}, "only for body.material = \"mooney-rivlin\"");
  expect_refused({"body.material=mooney-rivlin", "body.poisson_ratio=0.2", "body.mooney_ratio=0.4"},
                 "expected nu / (1 - 2 nu) = 0.3333 or less");
  EXPECT_THROW(make_material("neo-hokean", {}), InputError);
}

TEST(Material, KeysOfLawsStandBehindTheirChoice) {
  const std::vector<Key> keys = key_table("pin_on_flat");
  for (const std::string choice : {"body.material", "shape.energy"}) {
    const auto place = std::ranges::find(keys, choice, &Key::name);
    ASSERT_NE(place, keys.end());
    std::vector<std::string> names = MaterialLaws::names();
    if (choice == "body.material") {  // small strains and the default stand first
      std::erase(names, "neo-hookean");
      names.insert(names.begin(), {"linear", "neo-hookean"});
    }
    EXPECT_EQ(place->choices, names);
    EXPECT_EQ(std::get<std::string>(*place->default_value), "neo-hookean");
    EXPECT_THAT((place + 1)->name, ::testing::EndsWith(".mooney_ratio"));
  }
}

}  // namespace
}  // namespace gnomon::material_test
