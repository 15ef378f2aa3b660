// Numbers in texts that shall be nothing else.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace gnomon {

/// The number that the whole text is; none where it is something else or out of range.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  return parsed == end && error == std::errc() ? std::optional(number) : std::nullopt;
}

}  // namespace gnomon
