// Values of fields with any number of components, and their numbers in y.
#include <gtest/gtest.h>

#include <gnomon/fields/reduced_entries.hpp>
#include <numeric>

namespace gnomon {
namespace {

/// Fields of 1, 2, 3 and 4 components at three nodes, all unknown but the last value of each.
std::shared_ptr<FieldSet> fields_of_all_sizes() {
  auto set = std::make_shared<FieldSet>();
  set->nodes = 3;
  for (int components = 1; components <= 4; ++components) {
    const int block = set->add(Block{.name = "field", .symbol = "f", .where = "all nodes"});
    Field field("field", {0, 1, 2}, components);
    field.block.setConstant(block);
    field.block(2, components - 1) = -1;
    set->add(std::move(field));
  }
  return set;
}

template <class Dimension>
class FieldValuesTest : public ::testing::Test {};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FieldValuesTest, Dimensions);

TYPED_TEST(FieldValuesTest, EveryValueGoesToItsNumberAndBack) {
  constexpr int dim = TypeParam::value;
  const auto set = fields_of_all_sizes();
  const Numbering numbering(set, BlockSelection(set->blocks.size(), 1));
  ASSERT_EQ(numbering.size(), 3 * (1 + 2 + 3 + 4) - 4);
  std::vector<double> y(static_cast<std::size_t>(numbering.size())), back(y.size());
  std::iota(y.begin(), y.end(), 1);
  FieldValues<dim> values(*set);
  numbering.scatter<dim>(y, values);
  for (int f = 0; f < 4; ++f) {
    const auto id = static_cast<FieldId>(f);
    for (int node = 0; node < 3; ++node)
      for (int i = 0; i <= f; ++i) {
        const int number = numbering.number(id, node, i);
        const double expected = number < 0 ? 0 : y[static_cast<std::size_t>(number)];
        const double value = f + 1 == dim ? values.vector(id)(node, std::min(i, dim - 1))
                                          : values.matrix(id)(node, i);
        EXPECT_EQ(value, expected) << f + 1 << " components, node " << node;
      }
  }
  numbering.gather<dim>(values, back);
  EXPECT_EQ(back, y);
}

/// Three nodes move along their own directions by one unknown, that of the first; the last one is
/// free.
std::shared_ptr<FieldSet> fields_with_directions() {
  auto set = std::make_shared<FieldSet>();
  set->nodes = 4;
  const int block = set->add(Block{.name = "field", .symbol = "f", .where = "all nodes"});
  Field field("field", {0, 1, 2, 3}, 2);
  field.block.setConstant(block);
  field.block(2, 0) = -1;
  field.carrier = {0, 0, 0, 3};
  field.direction = Field::Values::Zero(4, 2);
  field.direction.topRows<3>() << 0.6, -0.8, -0.8, 0.6, 0, 1;
  set->add(std::move(field));
  return set;
}

TEST(FieldDirection, ValuesAreMultiplesOfOneUnknown) {
  const auto set = fields_with_directions();
  const Numbering numbering(set, {1});
  ASSERT_EQ(numbering.size(), 3);
  EXPECT_EQ(numbering.all_numbers(), 8);
  EXPECT_EQ(numbering.unknowns()[0].component, 1);  // the largest
  const std::vector<double> y{5, 7, 11};
  FieldValues<2> values(*set);
  numbering.scatter<2>(y, values);
  Field::Values expected(4, 2);
  expected << 3, -4, -4, 3, 0, 5, 7, 11;
  EXPECT_LE((values.vector(FieldId{0}) - expected).norm(), 1e-14);
  std::vector<double> back(3);
  numbering.gather<2>(values, back);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], y[k], 1e-14);
}

// J = T^T J_all T for a full matrix, F = T^T F_all.
TEST(FieldDirection, RowsAndColumnsAreThoseOfTheUnknown) {
  const Numbering numbering(fields_with_directions(), {1});
  const int all = numbering.all_numbers();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(all, 3);
  std::vector<int> numbers(all);
  for (int k = 0; k < all; ++k) {
    T(k, numbering.meaning(k).unknown) = numbering.meaning(k).factor;
    numbers[k] = k;
  }
  PatternBuilder builder(all);
  builder.add(numbers, numbers);
  const ReducedEntries reduced(numbering, builder.build());
  const Eigen::MatrixXd J = Eigen::MatrixXd::NullaryExpr(
      all, all,
      [](Eigen::Index i, Eigen::Index j) { return 1.0 + double(i) + 0.1 * double(j * j); });
  std::vector<double> values(9);
  reduced.add_entries(std::span(J.data(), J.size()), values);
  EXPECT_LE((Eigen::Map<Eigen::MatrixXd>(values.data(), 3, 3) - T.transpose() * J * T).norm(),
            1e-12);
  std::vector<double> F(3, 1e9);
  reduced.add_rows(std::span(J.data(), static_cast<std::size_t>(all)), F);
  EXPECT_LE((Eigen::Map<Eigen::VectorXd>(F.data(), 3) - T.transpose() * J.col(0)).norm(), 1e-12);
}

}  // namespace
}  // namespace gnomon
