// Checks a value against the specification of its key.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <string>
#include <variant>

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

}  // namespace gnomon
