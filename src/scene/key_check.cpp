#include "scene/key_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

bool is_array(KeyKind kind) {
  return kind == KeyKind::integers || kind == KeyKind::reals;
}
bool is_integral(KeyKind kind) {
  return kind == KeyKind::integer || kind == KeyKind::integers;
}

std::string interval(const Range& range) {
  return fmt::format("{}{:g}, {:g}{}", range.min_open || std::isinf(range.min) ? '(' : '[',
                     range.min, range.max, range.max_open || std::isinf(range.max) ? ')' : ']');
}

std::string number_expectation(const Key& key) {
  std::string text = is_integral(key.kind) ? "integer" : "number";
  if (is_array(key.kind))
    text = key.length ? fmt::format("an array of {} {}s", key.length, text)
                      : fmt::format("an array of {}s", text);
  else
    text = (is_integral(key.kind) ? "an " : "a ") + text;
  if (std::isinf(key.range.min) && std::isinf(key.range.max))
    text += is_integral(key.kind) ? "" : ", finite";
  else
    text += " in " + interval(key.range);
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  return text;
}

bool inside(const Range& range, double value) {
  return std::isfinite(value) && (range.min_open ? value > range.min : value >= range.min) &&
         (range.max_open ? value < range.max : value <= range.max);
}

Complaint complain(const Key& key, const std::string& got) {
  return {fmt::format("expected {}, got {}", expectation(key), got)};
}

/// A number of the key's type in the key's range; nothing otherwise.
template <class T>
std::optional<T> number(const Key& key, const RawScalar& raw) {
  std::optional<T> value;
  if (const auto* integer = std::get_if<long>(&raw)) value = static_cast<T>(*integer);
  if constexpr (std::is_same_v<T, double>)
    if (const auto* real = std::get_if<double>(&raw)) value = *real;
  if (value && !inside(key.range, static_cast<double>(*value))) value.reset();
  return value;
}

template <class T>
std::variant<SceneValue, Complaint> check_number(const Key& key, const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content))
    if (const auto value = number<T>(key, *scalar)) return SceneValue(*value);
  return complain(key, describe(raw));
}

template <class T>
std::variant<SceneValue, Complaint> check_numbers(const Key& key, const RawValue& raw) {
  const auto* array = std::get_if<RawArray>(&raw.content);
  if (!array || (key.length && array->size() != key.length)) return complain(key, describe(raw));
  std::vector<T> values;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto value = number<T>(key, (*array)[i]);
    if (!value) return complain(key, fmt::format("{} at place {}", describe((*array)[i]), i + 1));
    values.push_back(*value);
  }
  return SceneValue(values);
}

std::variant<SceneValue, Complaint> check_text(const Key& key, const RawValue& raw) {
  const auto* scalar = std::get_if<RawScalar>(&raw.content);
  const auto* text = scalar ? std::get_if<std::string>(scalar) : nullptr;
  if (!text) return complain(key, describe(raw));
  if (key.choices.empty() ||
      std::find(key.choices.begin(), key.choices.end(), *text) != key.choices.end())
    return SceneValue(*text);
  Complaint complaint = complain(key, describe(raw));
  if (const std::string near = nearest_name(*text, key.choices); !near.empty())
    complaint.text += fmt::format(", did you mean \"{}\"?", near);
  return complaint;
}

std::variant<SceneValue, Complaint> check_flag(const Key& key, const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content))
    if (const auto* flag = std::get_if<bool>(scalar)) return SceneValue(*flag);
  return complain(key, describe(raw));
}

}  // namespace

std::string expectation(const Key& key) {
  if (key.kind == KeyKind::flag) return "true or false";
  if (key.kind != KeyKind::text) return number_expectation(key);
  if (key.choices.empty()) return "a text";
  std::vector<std::string> quoted;
  for (const std::string& choice : key.choices) quoted.push_back(toml_text(choice));
  return fmt::format("{}{}", quoted.size() > 1 ? "one of " : "", fmt::join(quoted, ", "));
}

std::variant<SceneValue, Complaint> check_value(const Key& key, const RawValue& raw) {
  switch (key.kind) {
    case KeyKind::flag:
      return check_flag(key, raw);
    case KeyKind::integer:
      return check_number<long>(key, raw);
    case KeyKind::real:
      return check_number<double>(key, raw);
    case KeyKind::text:
      return check_text(key, raw);
    case KeyKind::integers:
      return check_numbers<long>(key, raw);
    case KeyKind::reals:
      return check_numbers<double>(key, raw);
  }
  return Complaint{"has no type"};  // not reached: all kinds are handled above
}

}  // namespace gnomon
