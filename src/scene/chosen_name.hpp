// Keys whose names a scene chooses itself: "wear.constants.*".
#pragma once

#include <optional>
#include <string>

namespace gnomon {

/// What stands in `name` for the "*" of a key; nothing where the name is not one of the key. Chosen
/// names are identifiers: letters, digits and underscores, no digit first.
std::optional<std::string> chosen_name(const std::string& key, const std::string& name);

}  // namespace gnomon
