// One table of a study file, checked against its keys as scenes are against theirs.
#pragma once

#include <functional>
#include <gnomon/scene/scene.hpp>
#include <gnomon/study/study.hpp>
#include <map>
#include <string>
#include <vector>

#include "scene/raw_value.hpp"

namespace gnomon::study {

/// A scene key that the study sets, and where.
struct SceneSetting {
  std::string key;
  RawValue value;
  std::string origin;  ///< beginning of a message about it
};

/// The keys of a study file, each specified once.
std::vector<Key> top_keys();
std::vector<Key> sweep_keys();
std::vector<Key> method_keys();
std::vector<Key> reference_keys();

/// What gives a run its integrator, and this its step or tolerance.
enum class MethodFrom { method, reference, scene };

/// The scene keys that a study can set.
struct SceneKeys {
  std::vector<Key> keys;
  Impossible impossible = Impossible::refused;  ///< values of these
  MethodFrom method = MethodFrom::method;       ///< scene: a sweep by the scene's integrator
  /// SceneFile::numbered() of the scene.
  std::function<std::string(const std::string& key, const std::string& origin)> numbered =
      [](const std::string& key, const std::string&) { return key; };
};

/// Refuses keys that a study gives itself; `origin` begins the message. Throws InputError.
void require_settable(const std::string& key, const std::string& origin, MethodFrom method);

/// Checks `raw` for the scene key `name`; `origin` begins the message. Refuses keys that a study
/// gives itself, and values that are none of the key's unless impossible ones are kept. Throws
/// InputError.
SceneSetting scene_setting(const std::string& name, const RawValue& raw, const std::string& origin,
                           const SceneKeys& scene_keys);

/// What a table may hold.
struct TableSpec {
  std::string prefix;  ///< put before names in messages: "method."
  std::vector<Key> keys;
  std::string open_key{};                 ///< an array of values of any type; empty: none
  const SceneKeys* scene_keys = nullptr;  ///< what "set." may set; null: nothing
};

class KeyedTable {
public:
  /// Throws InputError for the first mistake.
  KeyedTable(const std::string& file, int line, const std::vector<RawEntry>& entries,
             const TableSpec& spec);

  bool has(const std::string& key) const { return values_.contains(key); }
  const std::string& text(const std::string& key) const;
  double real(const std::string& key) const;
  const std::vector<double>& reals(const std::string& key) const;
  const std::vector<SceneSetting>& settings() const { return settings_; }
  const std::vector<RawValue>& open_values() const { return open_values_; }
  /// Beginning of a message about a key, or about the table where the key is absent.
  std::string where(const std::string& key) const;

private:
  void read(const RawEntry& entry, const TableSpec& spec);

  std::string file_;
  int line_;
  std::string prefix_;
  std::map<std::string, SceneValue> values_;
  std::map<std::string, int> lines_;
  std::vector<SceneSetting> settings_;
  std::vector<RawValue> open_values_;
};

}  // namespace gnomon::study
