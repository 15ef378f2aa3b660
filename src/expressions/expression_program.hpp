// The compiled form of an expression: a list of instructions, each of which fills its own slot.
#pragma once

#include <cstdint>
#include <gnomon/expressions/expression.hpp>
#include <optional>
#include <span>
#include <vector>

namespace gnomon {

enum class Operation : std::uint8_t {
  // of one operand, a
  negate,
  exponential,
  logarithm,
  square_root,
  sine,
  cosine,
  absolute,
  table,          // number b
  skip_if_false,  // continues at instruction b if a is 0
  skip_if_true,   // continues at instruction b if a is 1
  // of two
  add,
  subtract,
  multiply,
  divide,
  power,
  constant_power,  // b is a constant, so its derivative, which has a logarithm, is not needed
  maximum,
  minimum,
  at_most,  // a <= b; conditions are 1 or 0, or NaN where they are undefined
  below,    // a < b
  both,     // a and b
  either,   // a or b
  // of three
  select,  // b if a, else c
};

/// How many of a, b and c are operands.
inline std::size_t operands_of(Operation operation) {
  return operation < Operation::add ? 1 : operation < Operation::select ? 2 : 3;
}

struct Instruction {
  Operation operation;
  std::uint16_t a = 0, b = 0, c = 0;  // slots, except as stated above
  std::uint32_t kink = 0;             // the first of its kinks, where it has some
};

using VariableSet = std::uint64_t;  // bit i stands for variable i
inline constexpr std::size_t max_variables = 64;

/// Slots in order: the constants, the variables that occur, the results of the instructions. A text
/// needs at most one slot per byte: operations that need two slots (`or`) or three (`if(,,)`) have
/// more bytes than that.
struct ExpressionProgram {
  std::vector<double> constants{};
  std::vector<std::uint16_t> variables{};
  std::vector<Instruction> instructions{};
  std::size_t result = 0;  // slot
  std::vector<PiecewiseLinear> tables{};
  VariableSet occurring = 0;
  std::vector<VariableSet> kinks{};  // what occurs in each switching function
  std::vector<char> jumps{};         // whether the value may jump at each kink
  bool skips = false;                // whether there are parts that are not always evaluated

  std::size_t first_result() const { return constants.size() + variables.size(); }
  std::size_t slots() const { return first_result() + instructions.size(); }
};

double evaluate(const ExpressionProgram& program, std::span<const double> x,
                std::span<const char> branches);
double evaluate_with_gradient(const ExpressionProgram& program, std::span<const double> x,
                              std::span<const char> branches, std::span<double> gradient);
void evaluate_switching(const ExpressionProgram& program, std::span<const double> x,
                        std::span<const char> branches, std::span<double> values);

/// Makes a program node by node, in the order of evaluation. An operation on constants becomes a
/// constant, which replaces all nodes from which it was computed.
class ProgramBuilder {
public:
  using Node = std::size_t;

  Node constant(double value);
  Node variable(std::size_t index);
  Node unary(Operation operation, Node a);
  Node binary(Operation operation, Node a, Node b);  ///< not select, not a skip
  Node call(const PiecewiseLinear& table, Node a);
  Node select(Node condition, Node yes, Node no);
  Node skip(Operation operation, Node condition);
  void set_target(Node skip, Node target);

  Node next() const { return nodes_.size(); }
  /// Removes this node and all later ones.
  void remove_from(Node node);
  std::optional<double> constant_value(Node node) const;

  ExpressionProgram program(Node result) const;

private:
  enum class Kind : std::uint8_t { constant, variable, instruction };
  struct Entry {
    Kind kind;
    double value = 0;           // of a constant
    std::size_t variable = 0;   // index
    Instruction instruction{};  // operands and targets are nodes
  };
  Node add(const Instruction& instruction);
  /// Fills in the constants and variables, and returns the slot of each node.
  std::vector<std::uint16_t> lay_out(ExpressionProgram& program) const;
  Node add_or_fold(const Instruction& instruction);

  std::vector<Entry> nodes_;
  std::vector<const PiecewiseLinear*> tables_;
};

}  // namespace gnomon
