// Keys that scenes no longer have, and the keys that have their place: earlier scenes and results
// stay readable.
#pragma once

#include <functional>
#include <gnomon/base/mistakes.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene_file.hpp"

namespace gnomon {

/// What the value of a retired key means for the key that has its place.
struct Translated {
  bool accepted = true;             ///< false: the key in its place cannot say so
  std::optional<RawValue> value{};  ///< none: that key stays as it is
};

struct RetiredKey {
  std::string name;      ///< with "*" or "#" as that of a Key
  std::string now = {};  ///< the key that has its place, with the same "*" or "#"; empty: none has
  /// Of its value and that of the other key, if that is given. None: the value is the same.
  std::function<Translated(const RawValue&, const RawValue* beside)> translate = nullptr;
  std::vector<SceneValue> accepted = {};  ///< of a key in whose place there is none; empty: any
  std::string instead = {};               ///< "expected ...", for other values
};

/// The retired key of that name, or nothing.
const RetiredKey* find_retired(const std::string& name);

/// What to write in the place of a retired key.
std::string instead_of(const RetiredKey& key);

/// The values with those of retired keys translated to the keys of the table. `below` are those
/// that they replace (overrides a file), `above` those that replace them. Mistakes are added.
std::vector<GivenValue> without_retired_keys(const std::vector<GivenValue>& given,
                                             const std::vector<GivenValue>& below,
                                             const std::vector<GivenValue>& above,
                                             const std::vector<Key>& table, Mistakes& mistakes);

}  // namespace gnomon
