// The tokens of an expression, and messages about its text.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace gnomon {

/// Throws ExpressionError with the place of `begin` in the text and the description of the mistake.
[[noreturn]] void refuse_expression(std::string_view text, std::size_t begin,
                                    const std::string& what);

/// A part of a text in quotes, on one line and not too long.
std::string quote(std::string_view part);

/// Whether it is a letter or underscore followed by letters, underscores and digits.
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

/// The token of a text that begins at `begin`. Throws ExpressionError where no token begins.
Token token_at(std::string_view text, std::size_t begin);

/// The texts of all tokens. Throws ExpressionError.
std::set<std::string, std::less<>> tokens_in(std::string_view text);

}  // namespace gnomon
