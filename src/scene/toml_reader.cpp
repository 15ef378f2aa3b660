#include "scene/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <gnomon/error.hpp>

#include "scene/nesting.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

RawScalar scalar_of(const toml::node& node) {
  if (const auto* value = node.as_boolean()) return value->get();
  if (const auto* value = node.as_integer()) return static_cast<long>(value->get());
  if (const auto* value = node.as_floating_point()) return value->get();
  if (const auto* value = node.as_string()) return value->get();
  if (node.is_table()) return ForeignValue{"a table", true};
  if (node.is_array()) return ForeignValue{"an array"};
  return ForeignValue{"a date or time"};
}

RawValue value_of(const toml::node& node) {
  const toml::array* array = node.as_array();
  if (!array) return {scalar_of(node)};
  RawArray values;
  for (const toml::node& item : *array) values.push_back(scalar_of(item));
  return {values};
}

void flatten(const toml::table& table, const std::string& prefix, std::vector<RawEntry>& entries) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + toml_key(std::string(key.str()));
    const toml::table* inner = node.as_table();
    if (inner && !inner->empty())
      flatten(*inner, name + ".", entries);
    else
      entries.push_back({name, static_cast<int>(node.source().begin.line), value_of(node)});
  }
}

}  // namespace

std::vector<RawEntry> read_toml(const std::string& text, const std::string& name) {
  if (const auto deep = find_deep_nesting(text))
    throw InputError(fmt::format("{}:{}: {}", name, deep->line, deep->message));
  std::vector<RawEntry> entries;
  try {
    flatten(toml::parse(text, name), "", entries);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}:{}: not valid TOML: {}", name, error.source().begin.line,
                                 error.description()));
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const RawEntry& a, const RawEntry& b) { return a.line < b.line; });
  return entries;
}

std::optional<RawValue> read_toml_value(const std::string& text) {
  // A line break would let the text smuggle in more than one value.
  if (text.find_first_of("\r\n") != std::string::npos) return std::nullopt;
  if (find_deep_nesting(text)) return std::nullopt;
  try {
    const toml::table table = toml::parse("value = " + text);
    return value_of(*table.get("value"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace gnomon
