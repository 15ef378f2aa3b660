// The commonest kinds of keys in a line or two; rarer ones are written as a `Key`.
#pragma once

#include <cmath>
#include <gnomon/scene/scene.hpp>
#include <utility>

namespace gnomon {

inline constexpr Range non_negative{.min = 0};
inline constexpr Range any_quantity{.min = -positive_quantity.max, .max = positive_quantity.max};
inline constexpr Range poisson_ratios{.min = 0, .max = 0.5, .max_open = true};

/// What a scene without the key has: required(), by_default(VALUE) or absent(MEANING).
struct WithoutKey {
  std::optional<SceneValue> value{};
  std::string meaning{};
};

inline WithoutKey required() {
  return {};
}

inline WithoutKey by_default(SceneValue value) {
  return {.value = std::move(value)};
}

inline WithoutKey absent(std::string meaning) {
  return {.meaning = std::move(meaning)};
}

/// `idle` is Key::idle.
inline Key real_key(std::string name, std::string unit, WithoutKey without, Range range,
                    std::string help, std::function<std::string(const Scene&)> idle = {}) {
  return {.name = std::move(name),
          .unit = std::move(unit),
          .default_value = std::move(without.value),
          .absent_meaning = std::move(without.meaning),
          .range = range,
          .help = std::move(help),
          .idle = std::move(idle)};
}

/// A required length greater than zero.
inline Key length_key(std::string name, std::string help) {
  return real_key(std::move(name), "mm", required(), positive_quantity, std::move(help));
}

/// A `length` of zero is any.
inline Key reals_key(std::string name, std::string unit, WithoutKey without, Range range,
                     std::string help, std::size_t length = 0) {
  Key key = real_key(std::move(name), std::move(unit), std::move(without), range, std::move(help));
  key.kind = KeyKind::reals;
  key.length = length;
  return key;
}

inline Key integer_key(std::string name, WithoutKey without, Range range, std::string help) {
  Key key = real_key(std::move(name), "", std::move(without), range, std::move(help));
  key.kind = KeyKind::integer;
  return key;
}

inline Key integers_key(std::string name, WithoutKey without, Range range, std::string help,
                        std::size_t length) {
  Key key = reals_key(std::move(name), "", std::move(without), range, std::move(help), length);
  key.kind = KeyKind::integers;
  return key;
}

/// No `choices` allow any text.
inline Key text_key(std::string name, WithoutKey without, std::string help,
                    std::vector<std::string> choices = {}) {
  Key key = real_key(std::move(name), "", std::move(without), {}, std::move(help));
  key.kind = KeyKind::text;
  key.choices = std::move(choices);
  return key;
}

inline Key texts_key(std::string name, WithoutKey without, std::string help) {
  Key key = text_key(std::move(name), std::move(without), std::move(help));
  key.kind = KeyKind::texts;
  return key;
}

/// The key decides a part of the error.
inline Key controlling(Key key, ErrorSource source,
                       std::function<std::optional<Scene>(const Scene&, double)> scaled) {
  key.controls = ErrorControl{source, std::move(scaled)};
  return key;
}

/// The same of a number to which the error is proportional, to some power.
inline Key controlling(const Key& key, ErrorSource source) {
  return controlling(key, source,
                     [name = key.name, range = key.range](const Scene& scene,
                                                          double factor) -> std::optional<Scene> {
                       if (!scene.has(name)) return {};
                       const double value = scene.real(name) * factor;
                       if (value == 0 || value < range.min || value > range.max) return {};
                       return scene.with(name, value);
                     });
}

/// The same of numbers of elements.
inline Key controlling_by_count(const Key& key) {
  return controlling(key, ErrorSource::mesh,
                     [name = key.name, range = key.range](const Scene& scene,
                                                          double factor) -> std::optional<Scene> {
                       std::vector<long> counts = scene.integers(name);
                       for (long& count : counts) {
                         count = std::lround(static_cast<double>(count) / factor);
                         const double value = static_cast<double>(count);
                         if (value < range.min || value > range.max) return {};
                       }
                       return scene.with(name, counts);
                     });
}

/// The key may change where a run continues from a checkpoint.
inline Key resumable(Key key) {
  key.on_resume = true;
  return key;
}

}  // namespace gnomon
