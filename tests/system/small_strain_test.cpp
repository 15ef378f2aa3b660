#include <gnomon/model/wear_model.hpp>

#include "support/derivatives.hpp"
#include "support/pin.hpp"

namespace gnomon::small_strain_test {
namespace {

using namespace testing;

TEST(SmallStrains, JacobianEqualsCentralDifferences) {
  for (const char* element : {"plain", "f-bar", "f-bar-variational"}) {
    SCOPED_TRACE(element);
    const auto model =
        pin_model({elements(4), "body.material=linear", std::string("body.element=") + element});
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-0.05, 0.05);
    std::vector<double> y(model->system().structure().size);
    for (double& value : y) value = uniform(generator);
    check_jacobian(model->system(), 0, y, 0.2);
  }
}

// The stiffness of the body does not depend on its displacement: at frozen shape and on one smooth
// branch the whole residual is linear in u and lambda, so its Jacobian is the same at every state.
TEST(SmallStrains, ContactProblemIsLinearOnAPiece) {
  const auto jacobian_at = [](const char* material, double amplitude) {
    const auto model = pin_model({elements(4), std::string("body.material=") + material});
    const std::vector<AlgebraicStage> stages = model->system().algebraic_stages();
    const System& contact = *stages.back().system;
    std::vector<double> y(contact.structure().size);
    for (std::size_t k = 0; k < y.size(); ++k) y[k] = amplitude * std::sin(3.0 * k);
    const ActiveSet branch(contact.structure().switch_node.size(), 1);
    std::vector<double> values(contact.structure().pattern.nonzeros());
    contact.jacobian({.y = y, .branch = &branch}, 0, values);
    return values;
  };
  EXPECT_EQ(jacobian_at("linear", 0), jacobian_at("linear", 0.05));
  EXPECT_NE(jacobian_at("neo-hookean", 0), jacobian_at("neo-hookean", 0.05));
}

}  // namespace
}  // namespace gnomon::small_strain_test
