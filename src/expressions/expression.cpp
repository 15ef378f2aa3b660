#include <fmt/format.h>

#include <cassert>
#include <gnomon/expressions/expression.hpp>
#include <utility>

#include "expressions/expression_grammar.hpp"

namespace gnomon {

Expression::Expression(std::string text, const ExpressionNames& names)
    : text_(std::move(text)), variables_(names.variables.size()) {
  check_expression_names(names);
  if (text_.size() > max_length)
    throw ExpressionError(
        fmt::format("an expression has {} bytes, expected at most {}", text_.size(), max_length));
  program_ = std::make_shared<const ExpressionProgram>(ExpressionParser(text_, names)());
}

bool Expression::depends_on(std::size_t variable) const {
  assert(variable < variables_);
  return program_->occurring >> variable & 1;
}

std::size_t Expression::kinks() const {
  return program_->kinks.size();
}

bool Expression::kink_depends_on(std::size_t kink, std::size_t variable) const {
  assert(kink < kinks() && variable < variables_);
  return program_->kinks[kink] >> variable & 1;
}

bool Expression::kink_may_jump(std::size_t kink) const {
  return program_->jumps[kink] != 0;
}

double Expression::value(std::span<const double> x, std::span<const char> branches) const {
  assert(x.size() == variables_);
  return evaluate(*program_, x, branches);
}

double Expression::value_and_gradient(std::span<const double> x, std::span<double> gradient,
                                      std::span<const char> branches) const {
  assert(x.size() == variables_ && gradient.size() == variables_);
  return evaluate_with_gradient(*program_, x, branches, gradient);
}

void Expression::switching(std::span<const double> x, std::span<double> values,
                           std::span<const char> branches) const {
  assert(x.size() == variables_);
  evaluate_switching(*program_, x, branches, values);
}

}  // namespace gnomon
