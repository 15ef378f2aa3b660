#include "scene/raw_value.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

struct Description {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(long value) const { return fmt::format("{}", value); }
  // 2.0 stays "2.0", so that "expected an integer, got 2.0" makes sense.
  std::string operator()(double value) const {
    return std::isfinite(value) ? toml_text(value) : fmt::format("{}", value);
  }
  std::string operator()(const ForeignValue& value) const { return value.description; }
  std::string operator()(const std::string& value) const {
    constexpr std::size_t longest = 60;  // a message stays one readable line
    if (value.size() <= longest) return toml_text(value);
    return toml_text(value.substr(0, longest)) + "...";
  }
};

}  // namespace

bool is_table(const RawValue& value) {
  const auto* scalar = std::get_if<RawScalar>(&value.content);
  const auto* foreign = scalar ? std::get_if<ForeignValue>(scalar) : nullptr;
  return foreign && foreign->is_table;
}

std::string describe(const RawScalar& value) {
  return std::visit(Description{}, value);
}

std::string describe(const RawValue& value) {
  if (const auto* scalar = std::get_if<RawScalar>(&value.content)) return describe(*scalar);
  const auto& array = std::get<RawArray>(value.content);
  if (array.empty()) return "an empty array";
  return fmt::format("an array of {} value{}", array.size(), array.size() == 1 ? "" : "s");
}

}  // namespace gnomon
