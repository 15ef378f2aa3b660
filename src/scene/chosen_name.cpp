#include "scene/chosen_name.hpp"

#include <algorithm>
#include <gnomon/scene/toml_key.hpp>
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

/// As toml_key() writes it: bare, or quoted as a whole.
bool is_toml_key(std::string_view text) {
  if (!text.starts_with('"')) return toml_key(std::string(text)) == text;
  std::size_t end = 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  return end + 1 == text.size();
}

/// Where the "*", "\"*\"" or "#" of a key is.
struct Place {
  enum class For { identifier, any_name, number };
  std::size_t begin = 0, size = 1;
  For what = For::identifier;
};

std::optional<Place> place_of(const std::string& key) {
  const std::size_t at = key.find_first_of("*#");
  if (at == std::string::npos) return std::nullopt;
  if (key[at] == '#') return Place{at, 1, Place::For::number};
  if (at > 0 && key[at - 1] == '"') return Place{at - 1, 3, Place::For::any_name};
  return Place{at, 1, Place::For::identifier};
}

/// Whether a name may stand in that place.
bool fits(const Place& place, std::string_view part) {
  switch (place.what) {
    case Place::For::identifier:
      return is_identifier(part);
    case Place::For::any_name:
      return is_toml_key(part);
    case Place::For::number:
      return is_number(part);
  }
  return false;
}

/// What stands in `name` in that place of the key, as it should or not.
std::optional<std::string> chosen_part(const std::string& key, const Place& place,
                                       const std::string& name) {
  const std::string_view before = std::string_view(key).substr(0, place.begin),
                         behind = std::string_view(key).substr(place.begin + place.size);
  if (name.size() <= before.size() + behind.size() || !name.starts_with(before) ||
      !name.ends_with(behind))
    return std::nullopt;
  return name.substr(before.size(), name.size() - before.size() - behind.size());
}

}  // namespace

std::optional<std::string> chosen_name(const std::string& key, const std::string& name) {
  const auto place = place_of(key);
  if (!place) return std::nullopt;
  std::optional<std::string> part = chosen_part(key, *place, name);
  return part && fits(*place, *part) ? part : std::nullopt;
}

std::string misnaming(const std::string& key, const std::string& name) {
  const auto place = place_of(key);
  const auto part = place ? chosen_part(key, *place, name) : std::nullopt;
  if (!part || place->what == Place::For::number || fits(*place, *part)) return {};
  if (place->what == Place::For::any_name)
    return "expected quotes around the name, " +
           std::string(key).replace(place->begin, place->size, toml_key(*part));
  if (part->find('.') != std::string::npos) return {};
  return "expected letters, digits and underscores, no digit first, in the place of * in `" + key +
         "`";
}

std::string key_like(const std::string& key, const std::string& name) {
  const auto place = place_of(key);
  if (!place) return key;
  const bool is_last = place->begin + place->size == key.size();
  const std::string table = key.substr(0, key.find('.') + 1);
  if (is_last && !name.starts_with(table)) return key;  // any name would be near
  std::size_t begin = 0;  // of the part of the name with as many parts before it
  for (auto dots = std::count(key.begin(), key.begin() + std::ptrdiff_t(place->begin), '.');
       dots > 0; --dots) {
    begin = name.find('.', begin) + 1;
    if (begin == 0) return key;
  }
  const std::string part = name.substr(begin, name.find('.', begin) - begin);
  return fits(*place, part) ? std::string(key).replace(place->begin, place->size, part) : key;
}

}  // namespace gnomon
