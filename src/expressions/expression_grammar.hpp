// The language of expressions: its reserved names, and its grammar as the class that parses it.
#pragma once

#include <string>
#include <string_view>

#include "expressions/expression_program.hpp"
#include "expressions/expression_text.hpp"

namespace gnomon {

struct ExpressionFunction {
  std::string_view name;
  Operation operation;
  std::size_t least_arguments, most_arguments;
};

/// All functions except `if`, which does not evaluate all of its arguments.
const ExpressionFunction* find_function(std::string_view name);

/// The message that there is no such name, with the nearest name and the list of all names.
std::string unknown_expression_name(std::string_view name, const ExpressionNames& names);

/// Throws ExpressionError unless the names are as ExpressionNames says.
void check_expression_names(const ExpressionNames& names);

/// By recursive descent, a function per level of precedence:
///
///     condition   conjunction { or conjunction }
///     conjunction comparison { and comparison }
///     comparison  sum [ (< | <= | > | >=) sum ]
///     sum         product { (+ | -) product }
///     product     sign { (* | /) sign }
///     sign        - sign | power
///     power       primary [ ^ sign ]
///     primary     number | name | name ( condition { , condition } ) | ( condition )
///
/// Parentheses may contain numbers and conditions, so the two are distinguished afterwards.
class ExpressionParser {
public:
  /// Throws ExpressionError, also in the call, for a text that is not an expression of these names.
  ExpressionParser(std::string_view text, const ExpressionNames& names)
      : text_(text), names_(names), token_(token_at(text, 0)) {}

  ExpressionProgram operator()();

private:
  using Node = ProgramBuilder::Node;

  struct Part {
    Node node;
    bool is_condition;
    std::size_t begin, end;  // in the text
  };

  Part number();  // a `condition` of the grammar that is a number
  Part condition();
  Part conjunction();
  Part comparison();
  Part sum();
  Part product();
  Part sign();  // every recursion passes through this function
  Part power();
  Part primary();
  Part named();
  Part function_call(const Token& name, const ExpressionFunction& function);
  Part table_call(const Token& name, const PiecewiseLinear& table);
  Part conditional(const Token& name);

  template <class Right>
  Part followed(Operation operation, const Part& left, const Right& parse_right);
  /// By `and` or `or`: the right side is not evaluated where the left side decides.
  template <class Right>
  Part joined(const Part& left, Operation operation, const Right& parse_right);
  Part combined(Operation operation, const Part& a, const Part& b, bool is_condition = false);
  /// Takes arguments in parentheses one by one, and returns their number.
  template <class Take>
  std::size_t arguments(const Token& name, const Take& take);
  void check_count(const Token& name, std::size_t count, std::size_t least, std::size_t most) const;

  /// The part that ends before the current token. A constant must be finite.
  Part part(Node node, std::size_t begin, bool is_condition = false) const;
  Part checked_number(const Part& part) const;
  Part checked_condition(const Part& part) const;
  std::string quote_part(const Part& part) const;

  void advance();
  bool accept(std::string_view word);
  bool at_comparison() const;
  void expect(std::string_view word, const std::string& where);
  [[noreturn]] void refuse(const std::string& what) const;
  [[noreturn]] void refuse_rest() const;

  std::string_view text_;
  const ExpressionNames& names_;
  Token token_;             // the next one
  std::size_t behind_ = 0;  // the end of the one before
  int nesting_ = 0;
  ProgramBuilder builder_;
};

}  // namespace gnomon
