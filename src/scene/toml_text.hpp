// Values as TOML text, the inverse of reading them.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <string>

#include "scene/raw_value.hpp"

namespace gnomon {

/// Shortest text that reads back as exactly this real: `1e-7`, `640.0`.
std::string toml_text(double value);
std::string toml_text(const std::string& value);  ///< quoted and escaped
std::string toml_text(const SceneValue& value);

/// Without blanks around it, and without the end of a line of Windows.
std::string trimmed(const std::string& text);

/// Also of what no key accepts; a table or a date, which has no text here, gives an empty table.
std::string toml_text(const RawValue& value);

}  // namespace gnomon
