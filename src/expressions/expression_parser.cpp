#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "expressions/expression_grammar.hpp"

namespace gnomon {

ExpressionProgram ExpressionParser::operator()() {
  const Part whole = number();
  if (token_.kind != Token::Kind::end) refuse_rest();
  return builder_.program(whole.node);
}

ExpressionParser::Part ExpressionParser::number() {
  return checked_number(condition());
}

template <class Right>
ExpressionParser::Part ExpressionParser::followed(Operation operation, const Part& left,
                                                  const Right& parse_right) {
  checked_number(left);
  advance();
  return combined(operation, left, checked_number(parse_right()));
}

template <class Right>
ExpressionParser::Part ExpressionParser::joined(const Part& left, Operation operation,
                                                const Right& parse_right) {
  checked_condition(left);
  advance();
  const bool decisive = operation == Operation::either;
  const std::optional<double> known = builder_.constant_value(left.node);
  Node skip = 0;
  if (known)
    builder_.remove_from(left.node);
  else
    skip = builder_.skip(decisive ? Operation::skip_if_true : Operation::skip_if_false, left.node);
  const Node right_begin = builder_.next();
  const Part right = checked_condition(parse_right());
  if (!known) {
    const Part result = combined(operation, left, right, true);
    builder_.set_target(skip, result.node);
    return result;
  }
  if (*known != decisive) return part(right.node, left.begin, true);
  builder_.remove_from(right_begin);
  return part(builder_.constant(*known), left.begin, true);
}

ExpressionParser::Part ExpressionParser::combined(Operation operation, const Part& a, const Part& b,
                                                  bool is_condition) {
  return part(builder_.binary(operation, a.node, b.node), std::min(a.begin, b.begin), is_condition);
}

ExpressionParser::Part ExpressionParser::condition() {
  Part left = conjunction();
  while (token_.is("or")) left = joined(left, Operation::either, [this] { return conjunction(); });
  return left;
}

ExpressionParser::Part ExpressionParser::conjunction() {
  Part left = comparison();
  while (token_.is("and")) left = joined(left, Operation::both, [this] { return comparison(); });
  return left;
}

ExpressionParser::Part ExpressionParser::comparison() {
  const Part left = sum();
  if (!at_comparison()) return left;
  const bool is_strict = token_.is("<") || token_.is(">");
  const bool is_exchanged = token_.is(">") || token_.is(">=");
  const Operation operation = is_strict ? Operation::below : Operation::at_most;
  checked_number(left);
  advance();
  const Part right = checked_number(sum());
  if (at_comparison())
    refuse(
        fmt::format("comparisons cannot be chained, expected \"and\" as in a < b and b < c, got {}",
                    token_.description()));
  return is_exchanged ? combined(operation, right, left, true)
                      : combined(operation, left, right, true);
}

ExpressionParser::Part ExpressionParser::sum() {
  Part left = product();
  while (token_.is("+") || token_.is("-")) {
    const Operation operation = token_.is("+") ? Operation::add : Operation::subtract;
    left = followed(operation, left, [this] { return product(); });
  }
  return left;
}

ExpressionParser::Part ExpressionParser::product() {
  Part left = sign();
  while (token_.is("*") || token_.is("/")) {
    const Operation operation = token_.is("*") ? Operation::multiply : Operation::divide;
    left = followed(operation, left, [this] { return sign(); });
  }
  return left;
}

ExpressionParser::Part ExpressionParser::sign() {
  if (nesting_ == Expression::max_nesting)
    refuse(
        fmt::format("parentheses, calls, signs and exponents are nested more than {} deep, "
                    "expected at most {}",
                    nesting_, nesting_));
  ++nesting_;
  Part result{};
  const std::size_t begin = token_.begin;
  if (accept("-")) {
    const Part positive = checked_number(sign());
    result = part(builder_.unary(Operation::negate, positive.node), begin);
  } else {
    result = power();
  }
  --nesting_;
  return result;
}

ExpressionParser::Part ExpressionParser::power() {
  const Part base = primary();
  return token_.is("^") ? followed(Operation::power, base, [this] { return sign(); }) : base;
}

ExpressionParser::Part ExpressionParser::part(Node node, std::size_t begin,
                                              bool is_condition) const {
  const Part result{node, is_condition, begin, behind_};
  const std::optional<double> value = builder_.constant_value(node);
  if (value && !std::isfinite(*value))
    refuse_expression(
        text_, begin,
        fmt::format("{} is {}, expected a finite number", quote_part(result), *value));
  return result;
}

ExpressionParser::Part ExpressionParser::checked_number(const Part& part) const {
  if (part.is_condition)
    refuse_expression(text_, part.begin,
                      fmt::format("{} is a condition, expected a number (conditions occur in "
                                  "if(condition, a, b) only)",
                                  quote_part(part)));
  return part;
}

ExpressionParser::Part ExpressionParser::checked_condition(const Part& part) const {
  if (!part.is_condition)
    refuse_expression(
        text_, part.begin,
        fmt::format("{} is a number, expected a condition such as a < b", quote_part(part)));
  return part;
}

std::string ExpressionParser::quote_part(const Part& part) const {
  return quote(text_.substr(part.begin, part.end - part.begin));
}

void ExpressionParser::advance() {
  behind_ = token_.end();
  token_ = token_at(text_, behind_);
}

bool ExpressionParser::accept(std::string_view word) {
  if (!token_.is(word)) return false;
  advance();
  return true;
}

bool ExpressionParser::at_comparison() const {
  return token_.is("<") || token_.is("<=") || token_.is(">") || token_.is(">=");
}

void ExpressionParser::expect(std::string_view word, const std::string& where) {
  if (!accept(word))
    refuse(fmt::format("expected \"{}\" {}, got {}", word, where, token_.description()));
}

void ExpressionParser::refuse(const std::string& what) const {
  refuse_expression(text_, token_.begin, what);
}

void ExpressionParser::refuse_rest() const {
  if (token_.is(")")) refuse("\")\" closes nothing, expected an operator or the end of the text");
  refuse(fmt::format("expected an operator or the end of the text, got {}{}", token_.description(),
                     token_.kind == Token::Kind::symbol ? "" : " (a product is written a * b)"));
}

}  // namespace gnomon
