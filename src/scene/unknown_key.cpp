#include "scene/unknown_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>

#include "scene/chosen_name.hpp"
#include "scene/retired_keys.hpp"

namespace gnomon {

namespace {

bool names_table(const std::string& name, const std::vector<Key>& table) {
  return std::any_of(table.begin(), table.end(),
                     [&](const Key& key) { return key.name.starts_with(name + "."); });
}

/// The table before a number in the name: "mesh" of "mesh.1.elements", if keys stand in it and it
/// is no array.
std::optional<std::string> table_given_as_array(const std::string& name,
                                                const std::vector<Key>& table) {
  for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    const std::string before = name.substr(0, dot);
    const std::size_t next = std::min(name.find('.', dot + 1), name.size());
    const std::string part = name.substr(dot + 1, next - dot - 1);
    if (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos &&
        names_table(before, table) && !names_table(before + ".#", table))
      return before;
  }
  return std::nullopt;
}

}  // namespace

bool gives_table(const std::string& name, const RawValue& value, const std::vector<Key>& table) {
  return is_table(value) && names_table(name, table);
}

std::optional<std::string> array_without_number(const std::string& name,
                                                const std::vector<Key>& table) {
  const std::size_t dot = std::min(name.find('.'), name.size());
  const std::string array = name.substr(0, dot);
  const bool has_number = dot + 1 < name.size() && name[dot + 1] >= '0' && name[dot + 1] <= '9';
  const bool is_table_too = std::ranges::any_of(table, [&](const Key& key) {
    return key.name.starts_with(array + ".") && !key.name.starts_with(array + ".#");
  });
  if (has_number || is_table_too || !names_table(array + ".#", table)) return std::nullopt;
  return array;
}

std::string key_meant(const std::string& name, const std::vector<Key>& table) {
  std::vector<std::string> names;
  for (const Key& key : table) names.push_back(key_like(key.name, name));
  std::string near = nearest_name(name, names);
  const std::string first = name.substr(0, name.find('.'));
  if (first == name || names_table(first, table)) return near;
  // Not a table: that may be the mistake, rather than the key in it.
  std::vector<std::string> tables;
  for (const Key& key : table)
    if (const auto dot = key.name.find('.'); dot != key.name.npos)
      tables.push_back(key.name.substr(0, dot));
  const std::string meant = nearest_name(first, tables);
  return meant.empty() || near.starts_with(meant + ".") ? near : meant;
}

void refuse_unknown_key(const std::string& origin, const std::string& name, const RawValue& value,
                        const std::vector<Key>& table, const std::string& help,
                        const std::string& prefix) {
  if (const auto single = table_given_as_array(name, table))
    throw InputError(
        fmt::format("{}: expected a table of keys, [{}{}], got an array of tables, [[{}{}]]",
                    origin, prefix, *single, prefix, *single));
  if (const auto array = array_without_number(name, table))
    throw InputError(fmt::format(
        "{}: expected an array of tables, [[{}{}]], got {}", origin, prefix, *array,
        name == *array ? describe(value) : fmt::format("a table, [{}{}]", prefix, *array)));
  if (names_table(name, table))
    throw InputError(fmt::format("{}: expected a table of keys, [{}{}], got {}", origin, prefix,
                                 name, describe(value)));
  if (const std::string instead = instead_of_retired(name); !instead.empty())
    throw InputError(origin + ": " + instead);
  for (const Key& key : table)
    if (const std::string expected = misnaming(key.name, name); !expected.empty())
      throw InputError(fmt::format("{}: {}", origin, expected));
  std::string near = key_meant(name, table);
  if (const auto number = near.find('#'); number != near.npos) near[number] = '1';
  throw InputError(fmt::format("{}: unknown key, {}", origin,
                               near.empty() ? fmt::format("expected one of `{}`", help)
                                            : fmt::format("did you mean `{}{}`?", prefix, near)));
}

}  // namespace gnomon
