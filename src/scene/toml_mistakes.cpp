#include "scene/toml_mistakes.hpp"

#include <fmt/format.h>

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

}  // namespace gnomon
