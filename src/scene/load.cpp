// Loads a scene with the overrides of the command line.

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>

#include "scene/scene_file.hpp"
#include "scene/toml_mistakes.hpp"
#include "scene/toml_reader.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

void refuse_deep_nesting(const std::string& text, const std::string& source) {
  constexpr std::size_t shown = 40;
  const auto deep = find_deep_nesting(text);
  if (!deep) return;
  std::string key = trimmed(text.substr(0, text.find_first_of("=\r\n")));
  if (key.size() > shown) key = key.substr(0, shown) + "...";
  throw InputError(fmt::format("{}{}: {}", source, key, deep->message));
}

/// What to write for a text that is not a bare word: max(p, 0).
std::string quoting_hint(const std::string& key, const std::string& value) {
  const bool is_begun = std::string("\"'[{").find(value.front()) != std::string::npos;
  if (is_begun || value.find_first_of("\"'\r\n") != std::string::npos) return {};
  return fmt::format(", expected quotes around a text: --set '{}=\"{}\"'", key, value);
}

/// After the key, which may have names in quotes: a."b = c".d=value.
std::size_t place_of_equals(const std::string& text) {
  char open = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (open && c == '\\' && open == '"')
      ++at;
    else if (open)
      open = c == open ? char{0} : open;
    else if (c == '=')
      return at;
    else if (c == '"' || c == '\'')
      open = c;
  }
  return text.find('=');  // quotes that are not closed
}

/// The key as a file would give it: with quotes where they are needed.
std::string normal_key(const std::string& key, const std::string& source) {
  if (key.find_first_of("\"'") == std::string::npos) return key;
  try {
    return read_toml(key + " = 0", "").front().name;
  } catch (const InputError&) {
    throw InputError(fmt::format("{}{}: expected a key of TOML before \"=\"", source, key));
  }
}

/// "key=value".
GivenValue parse_override(const std::string& text, const std::string& source) {
  refuse_deep_nesting(text, source);
  const std::size_t equals = place_of_equals(text);
  const std::string key = normal_key(trimmed(text.substr(0, equals)), source);
  if (equals == std::string::npos || key.empty())
    throw InputError(fmt::format("{}{}: expected KEY=VALUE", source, text));
  const std::string origin = source + key;
  const std::string value = trimmed(text.substr(equals + 1));
  if (value.empty()) throw InputError(origin + ": expected a value after \"=\"");
  if (auto raw = read_toml_value(value)) return {key, origin, *raw};
  if (value.find_first_of("\"'[]{}#=,\r\n") != std::string::npos)
    throw InputError(
        fmt::format("{}: not a TOML value: {}{}", origin, value, quoting_hint(key, value)));
  return {key, origin, RawValue{RawScalar(value)}};  // a bare word is a text
}

std::vector<GivenValue> parse_overrides(const std::vector<std::string>& texts,
                                        const std::string& source) {
  std::vector<GivenValue> overrides;
  for (const std::string& text : texts) {
    GivenValue given = parse_override(text, source);
    for (const GivenValue& earlier : overrides)
      if (earlier.name == given.name)
        throw InputError(given.origin + ": given twice, expected once");
    overrides.push_back(std::move(given));
  }
  return overrides;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<std::string>& overrides, const KeyTableOf& table_of,
                  Mistakes* mistakes, const std::string& source) {
  return SceneFile(text, name).scene(parse_overrides(overrides, source), table_of, mistakes);
}

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const KeyTableOf& table_of, Mistakes* mistakes, const std::string& source) {
  return SceneFile(file).scene(parse_overrides(overrides, source), table_of, mistakes);
}

}  // namespace gnomon
