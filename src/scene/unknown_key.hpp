// What is meant by a name that no key has.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"

namespace gnomon {

/// Whether a whole table is given that keys stand in: in a file an empty one, since of others there
/// are the keys.
bool gives_table(const std::string& name, const RawValue& value, const std::vector<Key>& table);

/// The array of tables, "load" for [[load]], that an unknown name would be in if it had the number
/// of a table: `load.on`. Nothing for other names.
std::optional<std::string> array_without_number(const std::string& name,
                                                const std::vector<Key>& table);

/// The key of the table that an unknown name most likely means; empty if none is near.
std::string key_meant(const std::string& name, const std::vector<Key>& table);

/// Throws InputError for a name that no key has, with the nearest one or the command that lists
/// them all (`help`). `prefix` is put before names.
[[noreturn]] void refuse_unknown_key(const std::string& origin, const std::string& name,
                                     const RawValue& value, const std::vector<Key>& table,
                                     const std::string& help, const std::string& prefix = "");

}  // namespace gnomon
