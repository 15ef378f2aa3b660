// Mistakes of TOML in the words of scenes, and how deep a text nests; checked before the text is
// given to a recursive parser.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// What to write instead, for mistakes that scenes often have, where the parser refuses line `line`
/// (from 1) of `text`; empty for others.
std::string usual_toml_mistake(const std::string& text, int line);

/// Largest number of parts of a dotted key or table header, and of arrays and inline tables within
/// each other.
inline constexpr int max_nesting = 32;

struct DeepNesting {
  int line = 0;         ///< 1-based, where the limit is exceeded
  std::string message;  ///< what was found and what was expected
};

/// The first place that nests deeper than max_nesting. Strings and comments do not count; text that
/// is not TOML is read as far as it makes sense.
std::optional<DeepNesting> find_deep_nesting(std::string_view text);

}  // namespace gnomon
