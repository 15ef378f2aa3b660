#include "scene/chosen_name.hpp"

#include <algorithm>
#include <string_view>

namespace gnomon {

namespace {

bool is_identifier(std::string_view text) {
  const auto letter = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && !digit(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) { return letter(c) || digit(c); });
}

}  // namespace

std::optional<std::string> chosen_name(const std::string& key, const std::string& name) {
  const std::size_t star = key.find('*');
  if (star == std::string::npos) return std::nullopt;
  const std::string_view before = std::string_view(key).substr(0, star),
                         behind = std::string_view(key).substr(star + 1);
  if (name.size() <= before.size() + behind.size() || !name.starts_with(before) ||
      !name.ends_with(behind))
    return std::nullopt;
  std::string chosen = name.substr(before.size(), name.size() - before.size() - behind.size());
  return is_identifier(chosen) ? std::optional(std::move(chosen)) : std::nullopt;
}

}  // namespace gnomon
