#include "scene/toml_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

/// Longer lines are no headers; std::regex would use much of the stack for them.
constexpr std::size_t longest = 500;

std::string header_of(const std::string& line) {
  static const std::regex header(R"(^\s*(\[\[?[^\[\]#]*\]\]?)\s*(#.*)?$)");
  std::smatch found;
  return line.size() <= longest && std::regex_match(line, found, header) ? found.str(1) : "";
}

/// Parts of a dotted name, those with blanks in quotes; empty if none has blanks, or it has quotes.
std::string with_quotes(const std::string& name) {
  if (name.find_first_of("\"'") != name.npos) return {};
  std::string result, part;
  bool blank = false;
  std::istringstream parts(name);
  while (std::getline(parts, part, '.')) {
    part = trimmed(part);
    const bool own = part.find_first_of(" \t") != part.npos;
    blank = blank || own;
    if (!result.empty()) result += ".";
    result += own ? fmt::format("\"{}\"", part) : part;
  }
  return blank ? result : "";
}

/// The line before `line` with a table of this name of the other kind; 0 if there is none.
int line_of_header(const std::string& text, const std::string& header, int line) {
  std::istringstream lines(text);
  std::string one;
  for (int number = 1; number < line && std::getline(lines, one); ++number)
    if (header_of(trimmed(one)) == header) return number;
  return 0;
}

}  // namespace

std::string usual_toml_mistake(const std::string& text, int line) {
  std::istringstream lines(text);
  std::string one;
  for (int number = 0; number < line; ++number) std::getline(lines, one);
  const std::string header = header_of(one);
  if (header.empty()) {
    const std::string key = trimmed(one.substr(0, one.find('=')));
    const std::string quoted =
        one.size() <= longest && one.find('=') != one.npos ? with_quotes(key) : "";
    return quoted.empty() || key.starts_with('[')
               ? ""
               : fmt::format("`{}`: expected a key without blanks, or with quotes: {}", key,
                             quoted);
  }
  const bool several = header.starts_with("[[");
  const std::string brackets = several ? "[[" : "[", closing = several ? "]]" : "]";
  const std::string name =
      header.substr(brackets.size(), header.size() - brackets.size() - closing.size());
  if (const std::string quoted = with_quotes(name); !quoted.empty())
    return fmt::format("{}: a name with blanks stands in quotes, expected {}{}{}", header, brackets,
                       quoted, closing);
  const std::string other = several ? "[" + name + "]" : "[[" + name + "]]";
  if (const int first = line_of_header(text, other, line); first > 0)
    return fmt::format("{}, but line {} has {}: expected [[{}]] for each of several tables", header,
                       first, other, name);
  return {};
}

namespace {

class NestingScan {
public:
  explicit NestingScan(std::string_view text) : text_(text) {}

  std::optional<DeepNesting> operator()() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_string(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        step(c);
      if (parts_ > max_nesting)
        return found(fmt::format("a key of more than {} parts", max_nesting));
      if (depth_ > max_nesting)
        return found(fmt::format("arrays or tables nested more than {} deep", max_nesting));
    }
    return std::nullopt;
  }

private:
  void step(char c) {
    ++at_;
    if (c == '[' || c == '{') ++depth_;
    if (c == ']' || c == '}') depth_ = std::max(0, depth_ - 1);
    if (c == '\n') ++line_;
    if (c == '.')
      ++parts_;
    else if (std::string_view("[]{},=\n").find(c) != std::string_view::npos)
      parts_ = 1;
  }

  /// Moves past the string that begins here. A string in single quotes has no escapes; a string
  /// that is not closed ends with its line, or with the text if it may span lines.
  void skip_string(char quote) {
    const std::string fence(3, quote);
    const bool spans_lines = text_.substr(at_, 3) == fence;
    at_ += spans_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        if (!spans_lines) return;
        ++line_;
      } else if (text_[at_] == '\\' && quote == '"') {
        if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      } else if (text_[at_] == quote && (!spans_lines || text_.substr(at_, 3) == fence)) {
        close_string(quote, spans_lines);
        return;
      }
    }
  }

  /// A string that may span lines can end in up to two quotes of its own before the closing three.
  void close_string(char quote, bool spans_lines) {
    at_ += spans_lines ? 3 : 1;
    for (int own = 0; spans_lines && own < 2 && at_ < text_.size() && text_[at_] == quote; ++own)
      ++at_;
  }

  DeepNesting found(const std::string& what) const {
    return {line_, fmt::format("{}, expected at most {}", what, max_nesting)};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int parts_ = 1;  // of the key that is being read, dots plus one
  int depth_ = 0;  // of brackets and braces that are open
};

}  // namespace

std::optional<DeepNesting> find_deep_nesting(std::string_view text) {
  return NestingScan(text)();
}

}  // namespace gnomon
