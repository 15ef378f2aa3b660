// Reads TOML text. Only its source file includes the TOML library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"

namespace gnomon {

/// All keys of a document in the order of their lines; an empty table is an entry of its own.
/// Throws InputError "NAME:LINE: ..." for text that is not TOML or nests absurdly
/// (toml_mistakes.hpp).
std::vector<RawEntry> read_toml(const std::string& text, const std::string& name);

/// The same with the tables of arrays of tables apart, in the order of their lines. Throws as well.
RawDocument read_toml_document(const std::string& text, const std::string& name);

/// A value in TOML syntax; nothing when `text` is not exactly one value, or nests absurdly.
std::optional<RawValue> read_toml_value(const std::string& text);

}  // namespace gnomon
