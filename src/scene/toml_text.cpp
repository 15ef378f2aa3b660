#include "scene/toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "scene/key_check.hpp"

namespace gnomon {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? "" : text.substr(first, last - first + 1);
}

std::string toml_text(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos)
    return text.find('.') == std::string::npos ? text + ".0" : text;
  std::size_t digit = exponent + 2;  // after the sign
  while (text[digit] == '0' && digit + 1 < text.size()) text.erase(digit, 1);
  return text;
}

std::string toml_text(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\')
      text += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      text += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      text += c;
  }
  return text + '"';
}

std::string toml_text(const SceneValue& value) {
  return toml_text(raw_value(value));
}

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 0x80 && (std::isalnum(c) || c == '_' || c == '-');
  });
  return bare ? key : toml_text(key);
}

namespace {

struct RawTextOf {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const {
    return std::isfinite(value) ? toml_text(value) : fmt::format("{}", value);
  }
  std::string operator()(const std::string& value) const { return toml_text(value); }
  std::string operator()(const ForeignValue&) const { return "{}"; }
};

}  // namespace

std::string toml_text(const RawValue& value) {
  if (const auto* scalar = std::get_if<RawScalar>(&value.content))
    return std::visit(RawTextOf{}, *scalar);
  std::vector<std::string> parts;
  for (const RawScalar& scalar : std::get<RawArray>(value.content))
    parts.push_back(std::visit(RawTextOf{}, scalar));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

}  // namespace gnomon
