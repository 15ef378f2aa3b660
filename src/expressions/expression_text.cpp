#include "expressions/expression_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <gnomon/expressions/expression.hpp>

#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

// By the bytes of ASCII, independent of the locale.
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}
/// Whether the byte continues a UTF-8 character that began earlier.
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

std::size_t characters(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_continuation));
}

/// Length of all characters that could be meant as parts of a number.
std::size_t number_length(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size()) {
    const char c = text[length];
    const bool signs_exponent = (c == '+' || c == '-') && length > 0 &&
                                (text[length - 1] == 'e' || text[length - 1] == 'E');
    if (!is_digit(c) && !is_letter(c) && c != '.' && !signs_exponent) break;
    ++length;
  }
  return length;
}

double read_number(std::string_view whole, std::size_t begin, std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc::result_out_of_range && parsed == end)
    refuse_expression(
        whole, begin,
        fmt::format("{} is too large or too small, expected 1e-307 to 1e308 or 0", quote(text)));
  if (error != std::errc() || parsed != end)
    refuse_expression(
        whole, begin,
        fmt::format("{} is not a number, expected one such as 2, 0.5 or 2e-9", quote(text)));
  return number;
}

struct ForeignSymbol {
  std::string_view text, meant;
};
constexpr ForeignSymbol foreign_symbols[] = {
    {"**", "^ for a power"},  {"&&", "and"},          {"||", "or"}, {"==", "<, <=, > or >="},
    {"!=", "<, <=, > or >="}, {"=", "<, <=, > or >="}};
constexpr std::string_view symbols[] = {"<=", ">=", "<", ">", "+", "-",
                                        "*",  "/",  "^", "(", ")", ","};

std::string_view symbol_at(std::string_view text, std::size_t begin) {
  const std::string_view rest = text.substr(begin);
  for (const auto& [foreign, meant] : foreign_symbols)
    if (rest.starts_with(foreign))
      refuse_expression(text, begin,
                        fmt::format("unknown symbol {}, expected {}", quote(foreign), meant));
  for (const std::string_view symbol : symbols)
    if (rest.starts_with(symbol)) return symbol;
  std::size_t length = 1;
  while (length < rest.size() && is_continuation(rest[length])) ++length;
  refuse_expression(text, begin,
                    fmt::format("{} has no meaning in an expression, expected a number, a name or "
                                "one of + - * / ^ ( ) , < <= > >=",
                                quote(rest.substr(0, length))));
}

}  // namespace

void refuse_expression(std::string_view text, std::size_t begin, const std::string& what) {
  const std::string_view before = text.substr(0, begin);
  const std::size_t line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  const std::size_t column = characters(before.substr(line_begin)) + 1;
  const bool of_one_line = text.find('\n') == text.npos;
  throw ExpressionError(of_one_line
                            ? fmt::format("column {}: {}", column, what)
                            : fmt::format("line {}, column {}: {}", line + 1, column, what));
}

std::string quote(std::string_view part) {
  constexpr std::size_t longest = 40;
  std::size_t length = std::min(part.size(), longest);
  while (length > 0 && length < part.size() && is_continuation(part[length])) --length;
  return toml_text(std::string(part.substr(0, length))) + (length < part.size() ? "..." : "");
}

bool is_expression_name(std::string_view name) {
  return !name.empty() && is_letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

std::string Token::description() const {
  return kind == Kind::end ? "the end of the text" : quote(text);
}

Token token_at(std::string_view text, std::size_t begin) {
  while (begin < text.size() && is_space(text[begin])) ++begin;
  Token token{.begin = begin};
  if (begin == text.size()) return token;
  const std::string_view rest = text.substr(begin);
  if (is_letter(rest[0])) {
    const auto behind = std::find_if(rest.begin(), rest.end(),
                                     [](char c) { return !is_letter(c) && !is_digit(c); });
    token.kind = Token::Kind::name;
    token.text = rest.substr(0, static_cast<std::size_t>(behind - rest.begin()));
  } else if (is_digit(rest[0]) || rest[0] == '.') {
    token.kind = Token::Kind::number;
    token.text = rest.substr(0, number_length(rest));
    token.number = read_number(text, begin, token.text);
  } else {
    token.kind = Token::Kind::symbol;
    token.text = symbol_at(text, begin);
  }
  return token;
}

std::set<std::string, std::less<>> tokens_in(std::string_view text) {
  std::set<std::string, std::less<>> tokens;
  for (Token token = token_at(text, 0); token.kind != Token::Kind::end;
       token = token_at(text, token.end()))
    tokens.emplace(token.text);
  return tokens;
}

}  // namespace gnomon
