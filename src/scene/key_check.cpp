#include "scene/key_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <optional>

#include "scene/chosen_name.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

bool is_array(KeyKind kind) {
  return kind == KeyKind::integers || kind == KeyKind::reals;  // of numbers
}
bool is_integral(KeyKind kind) {
  return kind == KeyKind::integer || kind == KeyKind::integers;
}

bool has_limits(const Range& range) {
  return !std::isinf(range.min) || !std::isinf(range.max);
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
  if (key.or_single)
    text = (has_limits(*key.or_single) ? "a number in " + interval(*key.or_single) : "a number") +
           ", or " + text;
  if (has_limits(key.range))
    text += " in " + interval(key.range);
  else
    text += is_integral(key.kind) ? "" : ", finite";
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  if (!key.or_text.empty()) text += ", or " + toml_text(key.or_text);
  if (key.names_file) text += ", or the name of a file of them";
  return text;
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

/// Of .2 and 2., as other languages write numbers.
bool lacks_digit_at_point(const RawScalar& raw) {
  const auto* text = std::get_if<std::string>(&raw);
  if (!text || text->find_first_not_of("+-.0123456789") != text->npos) return false;
  const std::size_t point = text->find('.'), digit = text->find_first_of("0123456789");
  return digit != text->npos && (point < digit || point + 1 == text->size());
}

template <class T>
std::variant<SceneValue, Complaint> check_number(const Key& key, const RawValue& raw) {
  const auto* scalar = std::get_if<RawScalar>(&raw.content);
  if (scalar)
    if (const auto value = number<T>(key, *scalar)) return SceneValue(*value);
  Complaint complaint = complain(key, describe(raw));
  if (scalar && lacks_digit_at_point(*scalar))
    complaint.text += ": TOML needs a digit before and after the point, as in 0.2 or 2.0";
  return complaint;
}

template <class T>
std::variant<SceneValue, Complaint> check_numbers(const Key& key, const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content); scalar && key.or_single)
    if (const auto value = number<T>(key, *scalar); value && inside(*key.or_single, *value))
      return SceneValue(std::vector<T>{*value});
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content))
    if (const auto* text = std::get_if<std::string>(scalar);
        text && (key.names_file || (!key.or_text.empty() && *text == key.or_text)))
      return SceneValue(*text);
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

bool is_choice(const Key& key, const std::string& text) {
  return key.choices.empty() || std::ranges::find(key.choices, text) != key.choices.end();
}

Complaint no_choice(const Key& key, const std::string& text, const std::string& got) {
  Complaint complaint = complain(key, got);
  if (const std::string near = nearest_name(text, key.choices); !near.empty())
    complaint.text += fmt::format(", did you mean \"{}\"?", near);
  return complaint;
}

std::variant<SceneValue, Complaint> check_text(const Key& key, const RawValue& raw) {
  const auto* scalar = std::get_if<RawScalar>(&raw.content);
  const auto* text = scalar ? std::get_if<std::string>(scalar) : nullptr;
  if (!text) return complain(key, describe(raw));
  if (is_choice(key, *text)) return SceneValue(*text);
  return no_choice(key, *text, describe(raw));
}

/// A single text is an array of one.
std::variant<SceneValue, Complaint> check_texts(const Key& key, const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content))
    return std::holds_alternative<std::string>(*scalar)
               ? check_texts(key, {.content = RawArray{*scalar}})
               : std::variant<SceneValue, Complaint>(complain(key, describe(raw)));
  const auto* array = std::get_if<RawArray>(&raw.content);
  if (!array) return complain(key, describe(raw));
  std::vector<std::string> values;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const auto* text = std::get_if<std::string>(&(*array)[i]);
    const std::string got = fmt::format("{} at place {}", describe((*array)[i]), i + 1);
    if (!text) return complain(key, got);
    if (!is_choice(key, *text)) return no_choice(key, *text, got);
    values.push_back(*text);
  }
  return SceneValue(values);
}

std::variant<SceneValue, Complaint> check_flag(const Key& key, const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content))
    if (const auto* flag = std::get_if<bool>(scalar)) return SceneValue(*flag);
  return complain(key, describe(raw));
}

}  // namespace

bool inside(const Range& range, double value) {
  return std::isfinite(value) && (range.min_open ? value > range.min : value >= range.min) &&
         (range.max_open ? value < range.max : value <= range.max);
}

std::string expectation(const Key& key) {
  if (key.kind == KeyKind::flag) return "true or false";
  if (key.kind == KeyKind::texts && key.choices.empty()) return "a text or an array of texts";
  if (key.kind != KeyKind::text && key.kind != KeyKind::texts) return number_expectation(key);
  if (key.choices.empty()) return "a text";
  std::vector<std::string> quoted;
  for (const std::string& choice : key.choices) quoted.push_back(toml_text(choice));
  const char* const which = key.kind == KeyKind::texts ? "some of " : "one of ";
  return fmt::format("{}{}", quoted.size() > 1 ? which : "", fmt::join(quoted, ", "));
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
    case KeyKind::texts:
      return check_texts(key, raw);
    case KeyKind::integers:
      return check_numbers<long>(key, raw);
    case KeyKind::reals:
      return check_numbers<double>(key, raw);
  }
  return Complaint{"has no type"};  // not reached: all kinds are handled above
}

std::string message_about(const std::string& file, int line, const std::string& key) {
  return line ? fmt::format("{}:{}: key `{}`", file, line, key)
              : fmt::format("{}: key `{}`", file, key);
}

SceneValue checked_value(const Key& key, const RawValue& raw, const std::string& origin) {
  const auto result = check_value(key, raw);
  if (const auto* complaint = std::get_if<Complaint>(&result))
    throw InputError(origin + ": " + complaint->text);
  return std::get<SceneValue>(result);
}

RawValue raw_value(const SceneValue& value) {
  return std::visit(
      []<class T>(const T& content) -> RawValue {
        if constexpr (std::is_same_v<T, std::vector<long>> ||
                      std::is_same_v<T, std::vector<double>> ||
                      std::is_same_v<T, std::vector<std::string>>)
          return {RawArray(content.begin(), content.end())};
        else
          return {RawScalar(content)};
      },
      value);
}

std::optional<Key> find_key(const std::vector<Key>& table, const std::string& name) {
  for (const Key& key : table)
    if (key.name == name || chosen_name(key.name, name)) {
      Key found = key;
      found.name = name;
      return found;
    }
  return std::nullopt;
}

void refuse_missing_key(const std::string& origin, const Key& key) {
  throw InputError(fmt::format("{}: missing, expected {}", origin, expectation(key)));
}

}  // namespace gnomon
