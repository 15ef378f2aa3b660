// Names in expressions: variables, constants, functions and tables.

#include <fmt/format.h>

#include <algorithm>

#include "expressions/expression_grammar.hpp"

namespace gnomon {

ExpressionParser::Part ExpressionParser::primary() {
  const Token token = token_;
  if (token.kind == Token::Kind::number) {
    advance();
    return part(builder_.constant(token.number), token.begin);
  }
  if (token.kind == Token::Kind::name && !token.is("and") && !token.is("or")) return named();
  if (!accept("("))
    refuse(fmt::format("expected a number, a name or \"(\", got {}", token.description()));
  Part inner = condition();
  expect(")", "to close the parenthesis");
  return {inner.node, inner.is_condition, token.begin, behind_};
}

ExpressionParser::Part ExpressionParser::named() {
  const Token name = token_;
  advance();
  const std::string key(name.text);
  const auto constant = names_.constants.find(key);
  const auto variable = std::find(names_.variables.begin(), names_.variables.end(), key);
  const auto table = names_.tables.find(key);
  if (name.is("if")) return conditional(name);
  if (const ExpressionFunction* function = find_function(name.text))
    return function_call(name, *function);
  if (table != names_.tables.end()) return table_call(name, table->second);
  if (constant == names_.constants.end() && variable == names_.variables.end())
    refuse_expression(text_, name.begin, unknown_expression_name(name.text, names_));
  if (token_.is("("))
    refuse_expression(text_, name.begin,
                      fmt::format("{} is not a function or table, expected an operator after it, "
                                  "got \"(\" (a product is written a * b)",
                                  quote(name.text)));
  if (constant != names_.constants.end())
    return part(builder_.constant(constant->second), name.begin);
  const auto index = static_cast<std::size_t>(variable - names_.variables.begin());
  return part(builder_.variable(index), name.begin);
}

template <class Take>
std::size_t ExpressionParser::arguments(const Token& name, const Take& take) {
  expect("(", fmt::format("after {}", quote(name.text)));
  std::size_t count = 0;
  if (!token_.is(")")) do {
      take(number(), count++);
    } while (accept(","));
  expect(")", fmt::format("or \",\" in the arguments of {}", quote(name.text)));
  return count;
}

void ExpressionParser::check_count(const Token& name, std::size_t count, std::size_t least,
                                   std::size_t most) const {
  if (least <= count && count <= most) return;
  refuse_expression(
      text_, name.begin,
      fmt::format("{} takes {}{} argument{}, got {}", quote(name.text),
                  least == most ? "" : "at least ", least, least == 1 ? "" : "s", count));
}

ExpressionParser::Part ExpressionParser::function_call(const Token& name,
                                                       const ExpressionFunction& function) {
  Node result = 0;
  const std::size_t count = arguments(name, [&](const Part& argument, std::size_t before) {
    const bool first = before == 0 || function.most_arguments == 1;
    result = first ? argument.node : builder_.binary(function.operation, result, argument.node);
  });
  check_count(name, count, function.least_arguments, function.most_arguments);
  if (function.most_arguments == 1) result = builder_.unary(function.operation, result);
  return part(result, name.begin);
}

ExpressionParser::Part ExpressionParser::table_call(const Token& name,
                                                    const PiecewiseLinear& table) {
  Part argument{};
  const std::size_t count =
      arguments(name, [&](const Part& given, std::size_t) { argument = given; });
  check_count(name, count, 1, 1);
  return part(builder_.call(table, argument.node), name.begin);
}

ExpressionParser::Part ExpressionParser::conditional(const Token& name) {
  const std::string where = "in if(condition, a, b)";
  expect("(", "after \"if\"");
  const Node test = checked_condition(condition()).node;
  expect(",", where);
  const std::optional<double> known = builder_.constant_value(test);
  if (known) builder_.remove_from(test);

  const Node skip_yes = known ? 0 : builder_.skip(Operation::skip_if_false, test);
  Node yes_begin = builder_.next();
  Node result = number().node;
  if (known && *known == 0) builder_.remove_from(yes_begin);
  expect(",", where);

  const Node skip_no = known ? 0 : builder_.skip(Operation::skip_if_true, test);
  const Node no_begin = builder_.next();
  const Node no = number().node;
  expect(")", where);
  if (!known) {
    builder_.set_target(skip_yes, skip_no);
    result = builder_.select(test, result, no);
    builder_.set_target(skip_no, result);
  } else if (*known == 0) {
    result = no;
  } else {
    builder_.remove_from(no_begin);
  }
  return part(result, name.begin);
}

}  // namespace gnomon
