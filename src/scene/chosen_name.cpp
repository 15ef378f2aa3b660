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

bool is_number(std::string_view text) {
  return !text.empty() && text.front() != '0' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Where the "*" or "#" of a key is.
std::size_t place_of(const std::string& key) {
  return key.find_first_of("*#");
}

/// Whether a name may stand in that place.
bool fits(const std::string& key, std::string_view part) {
  return key[place_of(key)] == '#' ? is_number(part) : is_identifier(part);
}

/// What stands in `name` for "*" or "#", as it should or not.
std::optional<std::string> chosen_part(const std::string& key, const std::string& name) {
  const std::size_t star = place_of(key);
  if (star == std::string::npos) return std::nullopt;
  const std::string_view before = std::string_view(key).substr(0, star),
                         behind = std::string_view(key).substr(star + 1);
  if (name.size() <= before.size() + behind.size() || !name.starts_with(before) ||
      !name.ends_with(behind))
    return std::nullopt;
  return name.substr(before.size(), name.size() - before.size() - behind.size());
}

}  // namespace

std::optional<std::string> chosen_name(const std::string& key, const std::string& name) {
  std::optional<std::string> part = chosen_part(key, name);
  return part && fits(key, *part) ? part : std::nullopt;
}

bool is_misnamed(const std::string& key, const std::string& name) {
  const auto part = chosen_part(key, name);
  return part && key.find('*') != std::string::npos && !is_identifier(*part) &&
         part->find('.') == std::string::npos;
}

std::string key_like(const std::string& key, const std::string& name) {
  const std::size_t star = place_of(key);
  if (star == std::string::npos) return key;
  std::size_t begin = 0;  // of the part of the name with as many parts before it
  for (auto dots = std::count(key.begin(), key.begin() + std::ptrdiff_t(star), '.'); dots > 0;
       --dots) {
    begin = name.find('.', begin) + 1;
    if (begin == 0) return key;
  }
  const std::string part = name.substr(begin, name.find('.', begin) - begin);
  return fits(key, part) ? std::string(key).replace(star, 1, part) : key;
}

}  // namespace gnomon
