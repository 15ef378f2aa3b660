#include "scene/raw_value.hpp"

#include <fmt/format.h>

#include "scene/toml_text.hpp"

namespace gnomon {

bool is_table(const RawValue& value) {
  const auto* scalar = std::get_if<RawScalar>(&value.content);
  const auto* foreign = scalar ? std::get_if<ForeignValue>(scalar) : nullptr;
  return foreign && foreign->is_table;
}

std::string describe(const RawScalar& value) {
  constexpr std::size_t longest = 60;  // a message stays one readable line
  if (const auto* foreign = std::get_if<ForeignValue>(&value)) return foreign->description;
  if (const auto* text = std::get_if<std::string>(&value); text && text->size() > longest)
    return toml_text(text->substr(0, longest)) + "...";
  return toml_text(RawValue{value});
}

std::string describe(const RawValue& value) {
  if (const auto* scalar = std::get_if<RawScalar>(&value.content)) return describe(*scalar);
  const auto& array = std::get<RawArray>(value.content);
  if (array.empty()) return "an empty array";
  return fmt::format("an array of {} value{}", array.size(), array.size() == 1 ? "" : "s");
}

}  // namespace gnomon
