// A scene file that has been read, of which scenes are made that differ in some values.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"

namespace gnomon {

/// A value that a file or the command line gives for a key.
struct GivenValue {
  std::string name;    ///< of the key
  std::string origin;  ///< beginning of a message about it
  RawValue value;
};

/// As `--set KEY=VALUE` gives it.
GivenValue override_of(const std::string& key, RawValue value);

class SceneFile {
public:
  /// Throw InputError where there is no such file or the text is not TOML.
  explicit SceneFile(const std::filesystem::path& file);
  SceneFile(const std::string& text, const std::string& name);

  /// The scene with these values in the place of those of the file. A table of an array may be
  /// meant by its number or by the value of its key `name`. Throws InputError for values
  /// that their keys do not accept, first those of the file, then those of the overrides, and for
  /// missing ones; with `mistakes` as load_scene().
  Scene scene(std::vector<GivenValue> overrides, const KeyTableOf& table_of,
              Mistakes* mistakes = nullptr) const;

  /// body.2.KEY of body.NAME.KEY, where NAME is the `name` of the second [[body]]; any other key as
  /// it is. Throws InputError, which begins with `origin`, where such a name needs quotes.
  std::string numbered(const std::string& key, const std::string& origin) const;

private:
  std::string name_;
  std::vector<GivenValue> values_;
};

}  // namespace gnomon
