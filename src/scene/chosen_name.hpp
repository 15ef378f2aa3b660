// Keys with a part that a scene chooses itself: "wear.constants.*".
#pragma once

#include <optional>
#include <string>

namespace gnomon {

/// The part of `name` in place of the "*" of a key; nothing if the name does not match the key.
/// Chosen names are identifiers: letters, digits and underscores, not beginning with a digit.
std::optional<std::string> chosen_name(const std::string& key, const std::string& name);

}  // namespace gnomon
