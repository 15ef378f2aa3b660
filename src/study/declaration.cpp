#include "study/declaration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>

#include "scene/key_check.hpp"
#include "scene/raw_value.hpp"
#include "scene/scene_file.hpp"
#include "scene/toml_reader.hpp"
#include "scene/toml_text.hpp"
#include "scene/unknown_key.hpp"
#include "study/text_file.hpp"

namespace gnomon::study {

namespace {

namespace fs = std::filesystem;
using Kind = StudySetting::Kind;

std::string read_file(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (!fs::exists(status))
    throw InputError(fmt::format("{}: no such file, expected a study", file.string()));
  if (fs::is_directory(status))
    throw InputError(fmt::format("{}: is a folder, expected a study file", file.string()));
  return text_of(file);
}

/// "20", "20x40": a value for names and labels.
std::string label_text(const RawValue& value) {
  const auto text = [](const RawScalar& scalar) {
    if (const auto* real = std::get_if<double>(&scalar)) return number_text(*real);
    if (const auto* word = std::get_if<std::string>(&scalar)) return *word;
    return describe(scalar);
  };
  if (const auto* scalar = std::get_if<RawScalar>(&value.content)) return text(*scalar);
  std::vector<std::string> parts;
  for (const RawScalar& scalar : std::get<RawArray>(value.content)) parts.push_back(text(scalar));
  return fmt::format("{}", fmt::join(parts, "x"));
}

class Reader {
public:
  Reader(const fs::path& file, std::string text, Impossible impossible)
      : text_(std::move(text)), document_(read_toml_document(text_, file.string())) {
    scene_keys_.impossible = impossible;
    declaration_.file = file.string();
    declaration_.title = first_comment(text_);
  }

  Declaration read() {
    check_brackets();
    read_scene();
    const KeyedTable top(declaration_.file, 0, document_.entries,
                         {.prefix = "", .keys = top_keys(), .scene_keys = &scene_keys_});
    declaration_.common = top.settings();
    declaration_.times_origin = top.where("times");
    if (top.has("times")) declaration_.times = top.reals("times");
    for (const RawTable& table : document_.tables) read_table(table);
    declaration_.compared = !top.has("reference");
    add_method_of_scene();
    read_references(top);
    read_self_reference(top);
    check_conflicts();
    declaration_.text = std::move(text_);
    return std::move(declaration_);
  }

private:
  /// With a missing bracket the table's keys would only be reported as unknown.
  void check_brackets() const {
    for (const RawEntry& entry : document_.entries)
      for (const char* name : {"sweep", "method", "reference"})
        if ((entry.name == name && is_table(entry.value)) ||
            entry.name.starts_with(fmt::format("{}.", name)))
          throw InputError(fmt::format("{}: there may be several of these tables, expected [[{}]]",
                                       message_about(declaration_.file, entry.line, entry.name),
                                       name));
  }

  /// The scene is read first, because it determines which keys can be set.
  void read_scene() {
    const std::vector<Key> keys = top_keys();
    std::vector<RawEntry> entries;
    for (const RawEntry& entry : document_.entries)
      if (!entry.name.starts_with("set.") && entry.name != "set") entries.push_back(entry);
    const KeyedTable top(declaration_.file, 0, entries, {.prefix = "", .keys = keys});
    declaration_.scene = fs::path(declaration_.file).parent_path() / top.text("scene");
    if (std::error_code ignored; !fs::is_regular_file(declaration_.scene, ignored))
      throw InputError(fmt::format("{}: expected a scene file, there is no {}", top.where("scene"),
                                   toml_text(declaration_.scene.string())));
    const SceneFile file(declaration_.scene);
    scene_ = file.scene({}, key_table);
    scene_keys_.numbered = [file](const std::string& key, const std::string& origin) {
      return file.numbered(key, origin);
    };
    scene_keys_.keys = key_table(scene_.text("problem"));
    if (top.has("reference") &&
        std::ranges::find(document_.tables, "method", &RawTable::name) == document_.tables.end())
      scene_keys_.method = MethodFrom::scene;
  }

  void add_method_of_scene() {
    if (!declaration_.methods.empty()) return;
    if (declaration_.compared)
      throw InputError(declaration_.file +
                       ": expected one [[method]] or more, got none; reference = \"none\" at the "
                       "top makes a sweep without errors, which needs no method");
    declaration_.methods.push_back(method_of_scene(scene_));
  }

  void read_table(const RawTable& table) {
    if (table.name == "sweep")
      declaration_.sweeps.push_back(sweep(table));
    else if (table.name == "method")
      add_method(declaration_.file, table, scene_keys_, declaration_.methods);
    else if (table.name == "reference")
      declaration_.references.push_back(read_reference(declaration_.file, table, scene_keys_));
    else {
      const std::string near = nearest_name(table.name, {"sweep", "method", "reference"});
      throw InputError(fmt::format("{}: unknown table, {}",
                                   message_about(declaration_.file, table.line, table.name),
                                   near.empty() ? "expected [[sweep]], [[method]] or [[reference]]"
                                                : fmt::format("did you mean [[{}]]?", near)));
    }
  }

  Sweep sweep(const RawTable& table) const {
    const KeyedTable keyed(declaration_.file, table.line, table.entries,
                           {.prefix = "sweep.", .keys = sweep_keys(), .open_key = "values"});
    Sweep sweep;
    sweep.origin = keyed.where("key");
    sweep.key = scene_keys_.numbered(keyed.text("key"), sweep.origin);
    for (const Sweep& earlier : declaration_.sweeps)
      if (earlier.key == sweep.key)
        throw InputError(
            fmt::format("{}: `{}` is swept twice, expected once", sweep.origin, sweep.key));
    const std::optional<Key> key = find_key(scene_keys_.keys, sweep.key);
    if (!key)
      refuse_unknown_key(sweep.origin, sweep.key, keyed.open_values().front(), scene_keys_.keys,
                         "gnomon help scene");
    sweep.unit = key->unit;
    require_settable(sweep.key, sweep.origin, scene_keys_.method);
    sweep_values(sweep, keyed);
    return sweep;
  }

  void sweep_values(Sweep& sweep, const KeyedTable& keyed) const {
    for (const RawValue& value : keyed.open_values()) {
      SceneSetting setting = scene_setting(sweep.key, value, keyed.where("values"), scene_keys_);
      for (const SceneSetting& earlier : sweep.values)
        if (const std::string text = toml_text(setting.value); toml_text(earlier.value) == text)
          throw InputError(
              fmt::format("{}: {} is given twice, expected once", setting.origin, text));
      sweep.values.push_back(std::move(setting));
      sweep.labels.push_back(label_text(value));
    }
  }

  void read_references(const KeyedTable& top) {
    auto& references = declaration_.references;
    if (!declaration_.compared) {
      if (top.has("self_reference.method"))
        throw InputError(top.where("self_reference.method") +
                         ": expected no self-reference with reference = \"none\"");
      return;
    }
    declaration_.chosen_references = !references.empty();
    if (references.empty()) references = default_references(declaration_.file);
    require_two_families(references);
  }

  void read_self_reference(const KeyedTable& top) {
    const bool step = top.has("self_reference.step"), rtol = top.has("self_reference.tolerance");
    if (!top.has("self_reference.method")) {
      if (step || rtol)
        throw InputError(top.where(step ? "self_reference.step" : "self_reference.tolerance") +
                         ": expected self_reference.method too");
      return;
    }
    if (step == rtol)
      throw InputError(top.where("self_reference.method") +
                       ": expected one of self_reference.step and .tolerance too");
    SelfReference self{
        method_called(top.text("self_reference.method"), top.where("self_reference.method")), {}};
    self.setting = step ? StudySetting{Kind::step, top.real("self_reference.step")}
                        : StudySetting{Kind::tolerance, top.real("self_reference.tolerance")};
    const Method& method = declaration_.methods[self.method];
    if (step && !Integrators::find(method.integrator, "integrator").fixed_steps)
      throw InputError(fmt::format("{}: expected a tolerance, {} chooses its own steps",
                                   top.where("self_reference.step"), method.integrator));
    declaration_.self_reference = self;
  }

  std::size_t method_called(const std::string& name, const std::string& origin) const {
    std::vector<std::string> names;
    for (const Method& method : declaration_.methods) names.push_back(method.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    const std::string near = nearest_name(name, names);
    throw InputError(fmt::format("{}: expected a method of the study, got \"{}\"{}", origin, name,
                                 near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near)));
  }

  /// A swept key must not be set elsewhere: one of the two would be ignored. A reference may: it is
  /// then the same for all values.
  void check_conflicts() const {
    const auto check = [&](const std::vector<SceneSetting>& settings) {
      for (const SceneSetting& setting : settings)
        for (const Sweep& sweep : declaration_.sweeps)
          if (sweep.key == setting.key)
            throw InputError(
                fmt::format("{}: expected it to be set or swept, not both", setting.origin));
    };
    check(declaration_.common);
    for (const Method& method : declaration_.methods) check(method.settings);
  }

  std::string text_;
  RawDocument document_;
  Declaration declaration_;
  Scene scene_;
  SceneKeys scene_keys_;
};

}  // namespace

std::string first_comment(const std::string& text) {
  if (!text.starts_with("#")) return {};
  const std::string line = text.substr(0, text.find('\n'));
  const std::size_t begin = line.find_first_not_of("# ");
  return begin == std::string::npos ? "" : line.substr(begin);
}

Declaration read_declaration(const fs::path& file, Impossible impossible) {
  return Reader(file, read_file(file), impossible).read();
}

}  // namespace gnomon::study
