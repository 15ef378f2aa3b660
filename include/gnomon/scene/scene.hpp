// A scene: every parameter of one run, read from a TOML file, checked against a table of keys.
//
// Each key is specified exactly once, as a `Key` value. Parsing, error messages, `gnomon help
// scene` and the resolved dump are all derived from these values.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <gnomon/base/mistakes.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon {

/// A value of a scene key. Integers widen to reals where a real is expected, never the reverse.
using SceneValue = std::variant<bool, long, double, std::string, std::vector<long>,
                                std::vector<double>, std::vector<std::string>>;

enum class KeyKind { flag, integer, real, text, integers, reals, texts };

/// Closed or half-open interval of admissible numbers; applies to each entry of an array.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;
  bool max_open = false;
};

/// Range of physical quantities: wide enough for all sets of units, and products of several
/// quantities stay far from the limits of double.
inline constexpr Range positive_quantity{.min = 1e-30, .max = 1e30};
/// Range of relative tolerances: smaller ones are below rounding errors, larger ones do not control
/// the steps.
inline constexpr Range relative_tolerance{.min = 1e-13, .max = 0.1};

class Scene;

/// What a result is wrong by, for which keys of its scene decide how much.
enum class ErrorSource { time, mesh, model, phases, solves };

/// How a key decides a part of the error.
struct ErrorControl {
  ErrorSource source = ErrorSource::time;
  /// The scene in which steps, tolerance, elements or distances of phases are `factor` times as
  /// large, as nearly as the key allows; of a model, for a factor below 1 the one that neglects
  /// less, above 1 the one that neglects more. Nothing where the scene has no such choice.
  std::function<std::optional<Scene>(const Scene&, double factor)> scaled{};
  /// Plans leave it, because it refines what is given; budgets tell its error.
  bool judges_only = false;
  /// For plans: the scene with a first choice, where it leaves that to the program; else nothing.
  std::function<std::optional<Scene>(const Scene&)> chosen{};
};

/// Specification of one scene key.
struct Key {
  /// Dotted, for example "body.young_modulus". A part "*" stands for any identifier that the scene
  /// chooses: "wear.constants.*" is a table of numbers; a part "\"*\"" for any text, in quotes
  /// where TOML needs them (toml_key()); a part "#" for the number, from 1, of a table of an array:
  /// "load.#.on" is the key `on` of every [[load]]. All three kinds of keys are optional.
  std::string name{};
  KeyKind kind = KeyKind::real;
  std::string unit{};                         ///< "MPa"; empty when dimensionless
  std::optional<SceneValue> default_value{};  ///< its value in scenes without the key
  std::string absent_meaning{};        ///< of a key without a default that scenes may leave out
  Range range{};                       ///< numbers only
  std::vector<std::string> choices{};  ///< texts only; empty means any text
  std::size_t length = 0;              ///< arrays only; 0 means any length
  /// `reals` only: a number in this range, instead of an array of it.
  std::optional<Range> or_single{};
  std::string or_text{};  ///< `reals` only: a text that may stand instead
  /// A text is the name of a file, relative to the folder of the scene. Of `reals`: it may stand
  /// instead of the numbers, which are in the file.
  bool names_file = false;
  /// `required` numbers only: keys, each with a number, whose product may stand instead. Empty:
  /// none.
  std::vector<std::string> or_product{};
  bool on_resume = false;  ///< whether it may change where a run continues from a checkpoint
  std::string help{};      ///< one line
  /// Why a scene has no use for the key, as in "KEY has no effect: REASON"; an empty text where it
  /// has one. Where it has none, resolved() leaves the key out if it has its default, so that the
  /// scene can be read without laws that it does not choose. No function: there always is a use.
  std::function<std::string(const Scene&)> idle{};
  std::optional<ErrorControl> controls{};  ///< a part of the error, or nothing

  bool required() const { return !default_value && absent_meaning.empty(); }
};

/// Keys that every scene has, for every problem: `problem` and those of the tables `time`,
/// `integrator` and `output`.
const std::vector<Key>& run_keys();

/// Keys shared by problems of a worn hyperelastic body: those of the tables `body`, `load`, `wear`,
/// `tables`, `shape`, `solver`, `contact` and `friction`. A problem adds its own geometry and mesh
/// keys.
const std::vector<Key>& worn_body_keys(int dim);

/// A validated scene. Every key of its table either has a value or is an absent optional key.
class Scene {
public:
  /// Typed access. Asking for a key that is not in the table, or with the wrong kind, is a
  /// programming error (std::logic_error).
  bool flag(const std::string& key) const;
  long integer(const std::string& key) const;
  double real(const std::string& key) const;
  const std::string& text(const std::string& key) const;
  const std::vector<long>& integers(const std::string& key) const;
  const std::vector<double>& reals(const std::string& key) const;
  const std::vector<std::string>& texts(const std::string& key) const;
  const SceneValue& any(const std::string& key) const;  ///< of whatever kind
  bool has(const std::string& key) const;               ///< false for an absent optional key
  /// Whether the key has a text instead of its numbers (Key::or_text, Key::names_file).
  bool has_text_instead(const std::string& key) const;
  bool knows(const std::string& key) const;   ///< whether the key is in the table of the scene
  bool given(const std::string& key) const;   ///< knows(key) && has(key)
  bool is_set(const std::string& key) const;  ///< whether the file or an override gives it
  std::optional<double> real_if(const std::string& key) const;
  bool is_default(const std::string& key) const;  ///< whether a key has its default value
  /// The keys that the file or an override gives, be it with their defaults, and for which the
  /// scene has no use (Key::idle): one line for each reason.
  std::vector<std::string> idle_texts() const;
  /// The other keys that the file or an override gives, not with their defaults, and whose values
  /// have not been asked for, in this scene or in one made of it.
  std::vector<std::string> unread_keys() const;
  /// The names that the scene gives in place of the "*" or "#" in a key of the table, ascending.
  std::vector<std::string> chosen_names(const std::string& key) const;

  /// The keys of its table that decide a part of the error, and have an effect.
  std::vector<Key> controlling_keys() const;

  /// The file it came from, for messages.
  const std::filesystem::path& path() const { return path_; }
  /// Beginning of a message about a key's value: "FILE:LINE: key `KEY`", or "FILE: key `KEY`" if
  /// the file does not contain the key, or "--set KEY" if it is overridden. For checks that involve
  /// several keys.
  std::string where(const std::string& key) const;
  /// The complete scene as TOML text, with one `key = value  # [unit] help` per line, grouped in
  /// tables, without defaults of no use (Key::idle). Loading this text gives an equal scene.
  std::string resolved() const;
  /// The same scene with another value of a key.
  Scene with(const std::string& key, SceneValue value) const;
  /// The same scene with a key that is not in its table, in the place of a "*": it stands behind
  /// the others of its table.
  Scene with(Key key, SceneValue value) const;
  /// The same scene as if nobody had given an optional key: it is absent, or has its default.
  Scene without(const std::string& key) const;
  /// The same scene with absolute paths of the files that it names (Key::names_file), for a copy of
  /// it in another folder.
  Scene with_absolute_files() const;

  /// The keys, in the order of the tables, whose values differ between the scenes; an absent
  /// key differs from one with a value.
  static std::vector<std::string> differing_keys(const Scene& a, const Scene& b);

  /// Same keys with the same values, independent of their origin.
  friend bool operator==(const Scene& a, const Scene& b);

private:
  friend class SceneLoader;
  struct Entry {
    Key key;
    std::optional<SceneValue> value;
    std::string origin;  ///< where it was given, for messages; empty: nowhere
    /// Whether the value was asked for; one for all scenes that are made of this one.
    std::shared_ptr<std::atomic<bool>> is_read = std::make_shared<std::atomic<bool>>(false);
  };
  template <class T>
  const T& read(const std::string& key) const;
  const Entry& entry(const std::string& key) const;
  std::optional<SceneValue>& value(const std::string& key);

  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

/// Returns the key table of the problem with this name; throws InputError (naming the nearest
/// problem) when there is no such problem. The message is prefixed by the loader with file, line
/// and key.
using KeyTableOf = std::function<std::vector<Key>(const std::string& problem)>;

/// Reads and validates `file`, with `overrides` ("key=value", value in TOML syntax; a bare word is
/// taken as a text) replacing values of the file. Messages name an override by `source` and key.
/// Throws InputError with one line for each mistake, naming file, line, key, and what was expected,
/// with the nearest known key for an unknown one. With `mistakes` these lines are added there
/// instead, and the scene has what is right: a key with a mistake has its default, or no value.
Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const KeyTableOf& table_of, Mistakes* mistakes = nullptr,
                 const std::string& source = "--set ");

/// The same from TOML text in memory; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<std::string>& overrides, const KeyTableOf& table_of,
                  Mistakes* mistakes = nullptr, const std::string& source = "--set ");

/// The help text of a key table, aligned for a terminal.
std::string describe_keys(const std::vector<Key>& table);

/// The candidate closest to `word` by edit distance, or empty if none is near.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

/// The message, always one line, about a name that is not among the candidates. `what` is the noun
/// for them ("integrator").
std::string unknown_name(const std::string& name, const std::string& what,
                         const std::vector<std::string>& candidates);

}  // namespace gnomon
