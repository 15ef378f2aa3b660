// The words of an expression, and messages about its text.
#pragma once

#include <string>
#include <string_view>

namespace gnomon {

/// Throws ExpressionError: where `begin` is in the text, and what is wrong there.
[[noreturn]] void refuse_expression(std::string_view text, std::size_t begin,
                                    const std::string& what);

/// A part of a text in quotes, on one line and not too long.
std::string quote(std::string_view part);

/// Whether it is a letter or underscore followed by such and digits.
bool is_expression_name(std::string_view name);

struct Token {
  enum class Kind { number, name, symbol, end };
  Kind kind = Kind::end;
  std::string_view text{};
  std::size_t begin = 0;  // in the whole text
  double number = 0;

  bool is(std::string_view word) const { return kind != Kind::end && text == word; }
  std::size_t end() const { return begin + text.size(); }
  std::string description() const;  // for messages
};

/// Takes a text apart, from `begin`. Throws ExpressionError at what begins no token.
Token token_at(std::string_view text, std::size_t begin);

}  // namespace gnomon
