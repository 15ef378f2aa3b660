// Keys with a part that a scene chooses itself: "wear.constants.*".
#pragma once

#include <optional>
#include <string>

namespace gnomon {

/// The part of `name` in place of the "*", "\"*\"" or "#" of a key; nothing if the name does not
/// match the key. Names in the place of "*" are identifiers: letters, digits and underscores, not
/// beginning with a digit. Those in the place of "\"*\"" are any at all, as toml_key() writes them.
/// Numbers ("#") are those of the tables of an array, from 1.
std::optional<std::string> chosen_name(const std::string& key, const std::string& name);

/// What was expected instead, where the name would be one of the key with another part in the place
/// of "*"; else empty.
std::string misnaming(const std::string& key, const std::string& name);

/// The key with the part of the name that stands in the place of "*" or "#", so that
/// "wear.constnts.a" is near to "wear.constants.a"; the key itself where the name has no such part.
std::string key_like(const std::string& key, const std::string& name);

}  // namespace gnomon
