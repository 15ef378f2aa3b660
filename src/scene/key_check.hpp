// Checks what a file gives against the specifications of its keys: the one validator of scenes and
// of studies.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/raw_value.hpp"

namespace gnomon {

/// The description of the values that a key accepts: "a number in (0, inf) [MPa]", `one of "plain",
/// "f-bar"`.
std::string expectation(const Key& key);

/// The mistake: "expected a number in (0, inf) [MPa], got -3".
struct Complaint {
  std::string text;
};

/// The value in the type of the key, or the reason why it is not acceptable.
std::variant<SceneValue, Complaint> check_value(const Key& key, const RawValue& raw);

/// Beginning of a message: "FILE:LINE: key `KEY`", or "FILE: key `KEY`" for line 0.
std::string message_about(const std::string& file, int line, const std::string& key);

/// As check_value(), but throws InputError, which begins with `origin`.
SceneValue checked_value(const Key& key, const RawValue& raw, const std::string& origin);

/// What a file would give for the value: reals stay reals where it gave an integer.
RawValue raw_value(const SceneValue& value);

/// Whether a value is finite and within the limits.
bool inside(const Range& range, double value);

/// The key of that name, or the key with "*" that the name is one of, under the chosen name. None
/// where the table has no such key.
std::optional<Key> find_key(const std::vector<Key>& table, const std::string& name);

/// Throws InputError for a required key that is missing.
[[noreturn]] void refuse_missing_key(const std::string& origin, const Key& key);

}  // namespace gnomon
