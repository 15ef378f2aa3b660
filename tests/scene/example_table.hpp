// A table with one key of every kind, for tests of scenes.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::test {

inline std::vector<Key> example_table(const std::string& problem) {
  if (problem != "example") throw InputError("unknown problem \"" + problem + "\"");
  return {
      {.name = "problem", .kind = KeyKind::text, .help = "the problem"},
      {.name = "body.young_modulus",
       .unit = "MPa",
       .range = {.min = 0, .min_open = true},
       .help = "stiffness"},
      {.name = "body.element",
       .kind = KeyKind::text,
       .default_value = std::string("f-bar"),
       .choices = {"plain", "f-bar"},
       .help = "element"},
      {.name = "body.poisson_ratio",
       .default_value = 0.3,
       .range = {.min = 0, .max = 0.5, .max_open = true},
       .help = "Poisson's ratio"},
      {.name = "mesh.elements",
       .kind = KeyKind::integers,
       .default_value = std::vector<long>{4, 4},
       .range = {.min = 1},
       .length = 2,
       .help = "elements"},
      {.name = "mesh.level",
       .kind = KeyKind::integer,
       .default_value = 1L,
       .range = {.min = 0, .max = 9},
       .help = "refinement"},
      {.name = "output.times",
       .kind = KeyKind::reals,
       .unit = "s",
       .default_value = std::vector<double>{},
       .range = {.min = 0},
       .help = "times"},
      {.name = "output.last", .kind = KeyKind::flag, .default_value = true, .help = "last"},
      {.name = "output.title",
       .kind = KeyKind::text,
       .default_value = std::string(),
       .help = "any text"},
      {.name = "output.limit", .unit = "s", .absent_meaning = "none", .help = "limit"},
  };
}

inline Scene example_scene(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "example.toml", overrides, example_table);
}

/// The message of the InputError that reading `text` ends in; empty when it is accepted.
inline std::string complaint(const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
  try {
    example_scene(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace gnomon::test
