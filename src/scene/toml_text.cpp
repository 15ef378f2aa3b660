#include "scene/toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

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

namespace {

template <class T>
std::string array_text(const std::vector<T>& values) {
  std::vector<std::string> texts;
  for (const T& value : values) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, std::string>)
      texts.push_back(toml_text(value));
    else
      texts.push_back(fmt::format("{}", value));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

struct TextOf {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return toml_text(value); }
  std::string operator()(const std::string& value) const { return toml_text(value); }
  std::string operator()(const std::vector<long>& value) const { return array_text(value); }
  std::string operator()(const std::vector<double>& value) const { return array_text(value); }
  std::string operator()(const std::vector<std::string>& value) const { return array_text(value); }
};

}  // namespace

std::string toml_text(const SceneValue& value) {
  return std::visit(TextOf{}, value);
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
