// Values of fields with any number of components, and their numbers in y.
#include <gtest/gtest.h>

#include <gnomon/fields/numbering.hpp>
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

}  // namespace
}  // namespace gnomon
