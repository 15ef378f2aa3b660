#include "support/derivatives.hpp"
#include "support/pin.hpp"
#include "support/rough_state.hpp"

namespace gnomon::wear_system_test {
namespace {

using namespace testing;

/// Number of a value of one of the pin's fields.
int number(const Model& model, FieldId WornBodyFields::*field, int entity, int component = 0) {
  const auto& wear = dynamic_cast<const WearModel<2>&>(model);
  return wear.system().numbering().number(wear.equations().fields().*field, entity, component);
}

/// A rough state with closed and open contact nodes in turn.
std::vector<double> rough_state(const Model& model) {
  return testing::rough_state(dynamic_cast<const WearModel<2>&>(model),
                              {.size = 0.05, .closed = -2000, .open = 300});
}

TEST(WearSystem, JacobianEqualsCentralDifferences) {
  for (const char* form : {"eliminated", "multiplier"})
    for (const char* element : {"plain", "f-bar", "f-bar-variational"})
      for (const char* normal : {"averaged", "normalised", "conservative"}) {
        SCOPED_TRACE(std::string(form) + " " + element + " " + normal);
        const auto model = pin_model({elements(4), std::string("shape.constraint=") + form,
                                      std::string("body.element=") + element,
                                      std::string("wear.normal=") + normal});
        const System& system = model->system();
        const std::vector<double> y = rough_state(*model);
        ActiveSet active = active_set(system, 0, y);
        const auto closed = std::count(active.begin(), active.end(), 1);
        ASSERT_GT(closed, 0);
        ASSERT_LT(closed, static_cast<long>(active.size()));
        check_jacobian(system, 0, y, 0.2);
        // The same on another smooth branch, continued beyond its border: every node is on its
        // wrong side.
        for (char& closed_node : active) closed_node = !closed_node;
        check_jacobian(system, 0, y, 0.2, &active);
      }
}

TEST(WearSystem, JacobianEqualsCentralDifferencesWithEveryAuxiliaryEnergy) {
  for (const char* form : {"eliminated", "multiplier"})
    for (const char* setting : {"shape.energy=blatz-ko", "shape.stiffening=1.5"}) {
      SCOPED_TRACE(std::string(form) + " " + setting);
      const auto model = pin_model({elements(4), std::string("shape.constraint=") + form, setting});
      check_jacobian(model->system(), 0, rough_state(*model), 0.2);
    }
}

// A prescribed branch gives the same result as the choice by sign where both are the same branch.
TEST(WearSystem, TheGivenPieceOfAStateIsItsResidual) {
  const auto model = pin_model({elements(4)});
  const System& system = model->system();
  const std::vector<double> y = rough_state(*model);
  ActiveSet branch = active_set(system, 0, y);
  std::vector<double> own(y.size()), given(y.size()), other(y.size());
  system.residual({0, y, y}, own);
  system.residual({0, y, y, &branch}, given);
  EXPECT_EQ(own, given);
  branch[1] = !branch[1];
  system.residual({0, y, y, &branch}, other);
  EXPECT_NE(own, other);
}

TEST(WearSystem, StageJacobiansEqualCentralDifferences) {
  for (const char* form : {"eliminated", "multiplier"}) {
    const auto model = pin_model({elements(4), std::string("shape.constraint=") + form});
    const std::vector<double> y = rough_state(*model);
    const auto stages = model->system().algebraic_stages();
    ASSERT_EQ(stages.size(), 2u);
    for (const AlgebraicStage& stage : stages) {
      stage.freeze(0, y);
      std::vector<double> part;
      for (int unknown : stage.unknowns) part.push_back(y[unknown]);
      check_jacobian(*stage.system, 0, part, 0);
    }
  }
}

// The stages and the differential rows together are the whole system: their residuals agree.
TEST(WearSystem, StagesAreItsAlgebraicRows) {
  const auto model = pin_model({elements(4)});
  const System& system = model->system();
  const std::vector<double> y = rough_state(*model);
  std::vector<double> F(y.size());
  system.residual({0, y, std::vector<double>(y.size(), 0.0)}, F);
  long rows =
      std::count(system.structure().differential.begin(), system.structure().differential.end(), 1);
  for (const AlgebraicStage& stage : system.algebraic_stages()) {
    stage.freeze(0, y);
    std::vector<double> part, G(stage.unknowns.size());
    for (int unknown : stage.unknowns) part.push_back(y[unknown]);
    stage.system->residual({.y = part}, G);
    for (std::size_t k = 0; k < G.size(); ++k) EXPECT_DOUBLE_EQ(G[k], F[stage.unknowns[k]]);
    rows += static_cast<long>(G.size());
  }
  EXPECT_EQ(rows, system.structure().size);
}

TEST(WearSystem, PatternHoldsTheDiagonalAndNoDisplacementInTheMeshMotion) {
  const auto model = pin_model({elements(6)});
  const SparsePattern& pattern = model->system().structure().pattern;
  for (int i = 0; i < pattern.size(); ++i) EXPECT_GE(pattern.find(i, i), 0);
  const int inner = 3 * 7 + 3;  // a node off every boundary
  const auto u = [&](int i) { return number(*model, &WornBodyFields::u, inner, i); };
  const auto d = [&](int i) { return number(*model, &WornBodyFields::d, inner, i); };
  EXPECT_GE(pattern.find(u(0), d(1)), 0);
  EXPECT_EQ(pattern.find(d(0), u(1)), -1);
}

TEST(WearSystem, InvertedElementIsRecoverableAndNamed) {
  const auto model = pin_model({elements(4)});
  std::vector<double> y(model->system().structure().size, 0.0), F(y.size());
  y[number(*model, &WornBodyFields::u, 12, 1)] = 100;
  try {
    model->system().residual({0, y, y}, F);
    FAIL() << "no exception";
  } catch (const RecoverableError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("inverted element"));
  }
}

TEST(WearSystem, BlocksAddUpToTheSystem) {
  for (const char* form : {"eliminated", "multiplier"}) {
    const auto model = pin_model({elements(5), std::string("shape.constraint=") + form});
    long sum = 0;
    for (const BlockSize& block : model->blocks) sum += block.size;
    EXPECT_EQ(sum, model->system().structure().size);
  }
}

}  // namespace
}  // namespace gnomon::wear_system_test
