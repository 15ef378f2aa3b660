// How a table of keys is printed: grouped by TOML table, with one comment per key.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// The keys of one TOML table.
struct KeyGroup {
  std::string name;  ///< "body"; empty for keys outside any table
  std::vector<Key> keys;
};

/// Groups in order of first appearance, keys outside any table first (as TOML demands).
std::vector<KeyGroup> group_keys(const std::vector<Key>& table);

std::string last_part(const std::string& name);  ///< "young_modulus" of "body.young_modulus"

/// "[MPa] Young's modulus; absent: ..."
std::string key_comment(const Key& key);

}  // namespace gnomon
