#include "expressions/expression_program.hpp"

#include <algorithm>
#include <cassert>

#include "base/untrapped_arithmetic.hpp"

namespace gnomon {

namespace {

using Node = ProgramBuilder::Node;

bool is_skip(Operation operation) {
  return operation == Operation::skip_if_false || operation == Operation::skip_if_true;
}

std::size_t kinks_of(const Instruction& instruction, const std::vector<PiecewiseLinear>& tables) {
  switch (instruction.operation) {
    case Operation::absolute:
    case Operation::maximum:
    case Operation::minimum:
    case Operation::at_most:
    case Operation::below:
      return 1;
    case Operation::table:
      return tables[instruction.b].breakpoints().size();
    default:
      return 0;
  }
}

/// Whether the value may jump at the kink of an instruction that has this number among its own.
bool may_jump(const Instruction& instruction, const std::vector<PiecewiseLinear>& tables,
              std::size_t own) {
  if (instruction.operation == Operation::table) return tables[instruction.b].jumps_at(own);
  return instruction.operation == Operation::at_most || instruction.operation == Operation::below;
}

std::uint16_t narrow(std::size_t number) {
  assert(number <= Expression::max_length);
  return static_cast<std::uint16_t>(number);
}

}  // namespace

Node ProgramBuilder::constant(double value) {
  nodes_.push_back({.kind = Kind::constant, .value = value});
  return nodes_.size() - 1;
}

Node ProgramBuilder::variable(std::size_t index) {
  nodes_.push_back({.kind = Kind::variable, .variable = index});
  return nodes_.size() - 1;
}

Node ProgramBuilder::unary(Operation operation, Node a) {
  return add_or_fold({.operation = operation, .a = narrow(a)});
}

Node ProgramBuilder::binary(Operation operation, Node a, Node b) {
  if (operation == Operation::power && constant_value(b)) operation = Operation::constant_power;
  return add_or_fold({.operation = operation, .a = narrow(a), .b = narrow(b)});
}

Node ProgramBuilder::call(const PiecewiseLinear& table, Node a) {
  auto known = std::find(tables_.begin(), tables_.end(), &table);
  if (known == tables_.end()) known = tables_.insert(known, &table);
  return add_or_fold({.operation = Operation::table,
                      .a = narrow(a),
                      .b = narrow(static_cast<std::size_t>(known - tables_.begin()))});
}

Node ProgramBuilder::select(Node condition, Node yes, Node no) {
  return add(
      {.operation = Operation::select, .a = narrow(condition), .b = narrow(yes), .c = narrow(no)});
}

Node ProgramBuilder::skip(Operation operation, Node condition) {
  return add({.operation = operation, .a = narrow(condition)});
}

void ProgramBuilder::set_target(Node skip, Node target) {
  nodes_[skip].instruction.b = narrow(target);
}

void ProgramBuilder::remove_from(Node node) {
  nodes_.erase(nodes_.begin() + std::ptrdiff_t(node), nodes_.end());
}

std::optional<double> ProgramBuilder::constant_value(Node node) const {
  if (nodes_[node].kind != Kind::constant) return std::nullopt;
  return nodes_[node].value;
}

Node ProgramBuilder::add(const Instruction& instruction) {
  nodes_.push_back({.kind = Kind::instruction, .instruction = instruction});
  return nodes_.size() - 1;
}

Node ProgramBuilder::add_or_fold(const Instruction& instruction) {
  const bool two = operands_of(instruction.operation) == 2;
  const auto a = constant_value(instruction.a);
  const auto b = two ? constant_value(instruction.b) : a;
  if (!a || !b) return add(instruction);
  ExpressionProgram one{.constants = {*a, *b}, .instructions = {instruction}, .result = 2};
  one.instructions[0].a = 0;
  if (two) one.instructions[0].b = 1;
  if (instruction.operation == Operation::table) {
    one.tables = {*tables_[instruction.b]};
    one.instructions[0].b = 0;
  }
  const UntrappedArithmetic untrapped;
  const double value = evaluate(one, {}, {});
  remove_from(two ? std::min(instruction.a, instruction.b) : instruction.a);
  return constant(value);
}

std::vector<std::uint16_t> ProgramBuilder::lay_out(ExpressionProgram& program) const {
  std::vector<std::uint16_t> slots(nodes_.size());
  for (Node node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].kind == Kind::constant) {
      slots[node] = narrow(program.constants.size());
      program.constants.push_back(nodes_[node].value);
    }
  auto& variables = program.variables;
  for (Node node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].kind == Kind::variable) {
      const auto known = std::find(variables.begin(), variables.end(), nodes_[node].variable);
      const auto index = static_cast<std::size_t>(known - variables.begin());
      if (known == variables.end()) variables.push_back(narrow(nodes_[node].variable));
      slots[node] = narrow(program.constants.size() + index);
    }
  std::size_t next = program.first_result();
  for (Node node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].kind == Kind::instruction) slots[node] = narrow(next++);
  return slots;
}

ExpressionProgram ProgramBuilder::program(Node result) const {
  ExpressionProgram program;
  for (const PiecewiseLinear* table : tables_) program.tables.push_back(*table);
  const std::vector<std::uint16_t> slots = lay_out(program);
  std::vector<VariableSet> occurring(nodes_.size());
  for (Node node = 0; node < nodes_.size(); ++node) {
    const Entry& entry = nodes_[node];
    if (entry.kind == Kind::variable) occurring[node] = VariableSet{1} << entry.variable;
    if (entry.kind != Kind::instruction) continue;
    Instruction instruction = entry.instruction;
    std::uint16_t* const operands[] = {&instruction.a, &instruction.b, &instruction.c};
    for (std::size_t i = 0; i < operands_of(instruction.operation); ++i) {
      occurring[node] |= occurring[*operands[i]];
      *operands[i] = slots[*operands[i]];
    }
    if (is_skip(instruction.operation)) {
      instruction.b = narrow(slots[instruction.b] - program.first_result());
      program.skips = true;
    }
    instruction.kink = static_cast<std::uint32_t>(program.kinks.size());
    for (std::size_t own = 0; own < kinks_of(instruction, program.tables); ++own) {
      program.kinks.push_back(occurring[node]);
      program.jumps.push_back(may_jump(instruction, program.tables, own));
    }
    program.instructions.push_back(instruction);
  }
  program.occurring = occurring[result];
  program.result = slots[result];
  return program;
}

}  // namespace gnomon
