#include "scene/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <string_view>

#include "base/untrapped_arithmetic.hpp"
#include "scene/toml_mistakes.hpp"
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

int line_of(const toml::node& node) {
  return static_cast<int>(node.source().begin.line);
}

RawEntry entry_of(const std::string& name, const toml::node& node) {
  RawEntry entry{name, line_of(node), value_of(node)};
  if (const toml::array* array = node.as_array())
    for (const toml::node& item : *array) entry.elements.push_back(value_of(item));
  return entry;
}

void flatten(const toml::table& table, const std::string& prefix, std::vector<RawEntry>& entries);

/// An array of tables: their numbers, from 1, are parts of the names.
void flatten_array(const toml::array& tables, const std::string& prefix,
                   std::vector<RawEntry>& entries) {
  for (std::size_t k = 0; k < tables.size(); ++k)
    flatten(*tables[k].as_table(), fmt::format("{}{}.", prefix, k + 1), entries);
}

void flatten(const toml::table& table, const std::string& prefix, std::vector<RawEntry>& entries) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + toml_key(std::string(key.str()));
    const toml::table* inner = node.as_table();
    if (inner && !inner->empty())
      flatten(*inner, name + ".", entries);
    else if (node.is_array_of_tables())
      flatten_array(*node.as_array(), name + ".", entries);
    else
      entries.push_back(entry_of(name, node));
  }
}

template <class Item>
void sort_by_line(std::vector<Item>& items) {
  std::stable_sort(items.begin(), items.end(),
                   [](const Item& a, const Item& b) { return a.line < b.line; });
}

/// The parser quotes what it met, line breaks included.
std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c >= 0 && c < 0x20; }, ' ');
  return line;
}

toml::table parse(const std::string& text, const std::string& name) {
  if (const auto deep = find_deep_nesting(text))
    throw InputError(fmt::format("{}:{}: {}", name, deep->line, deep->message));
  const UntrappedArithmetic untrapped;  // toml++ recognizes by an overflow that 1e999 is too large
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    if (const std::string usual = usual_toml_mistake(text, line); !usual.empty())
      throw InputError(fmt::format("{}:{}: {}", name, line, one_line(usual)));
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", name, line, one_line(error.description())));
  }
}

/// Moves the arrays of tables of `table` into `tables`.
void take_tables(toml::table& table, std::vector<RawTable>& tables) {
  std::vector<std::string> taken;
  for (const auto& [key, node] : table) {
    if (!node.is_array_of_tables()) continue;
    taken.emplace_back(key.str());
    for (const toml::node& item : *node.as_array()) {
      tables.push_back({toml_key(taken.back()), line_of(item), {}});
      flatten(*item.as_table(), "", tables.back().entries);
      sort_by_line(tables.back().entries);
    }
  }
  for (const std::string& key : taken) table.erase(key);
  sort_by_line(tables);
}

}  // namespace

std::vector<RawEntry> read_toml(const std::string& text, const std::string& name) {
  std::vector<RawEntry> entries;
  flatten(parse(text, name), "", entries);
  sort_by_line(entries);
  return entries;
}

RawDocument read_toml_document(const std::string& text, const std::string& name) {
  RawDocument document;
  toml::table table = parse(text, name);
  take_tables(table, document.tables);
  flatten(table, "", document.entries);
  sort_by_line(document.entries);
  return document;
}

std::optional<RawValue> read_toml_value(const std::string& text) {
  // With a line break the text could contain more than one value.
  if (text.find_first_of("\r\n") != std::string::npos) return std::nullopt;
  if (find_deep_nesting(text)) return std::nullopt;
  const UntrappedArithmetic untrapped;
  try {
    const toml::table table = toml::parse("value = " + text);
    return value_of(*table.get("value"));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace gnomon
