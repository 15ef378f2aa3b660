// Counter-bodies from the text of a scene.
#pragma once

#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <string>

namespace gnomon::testing {

/// A scene that has the keys of a run and of a counter-body.
inline Scene scene_of(const std::string& text, const std::string& name = "scene.toml") {
  std::vector<Key> keys = run_keys();
  const auto table = counter_body_keys();
  keys.insert(keys.end(), table.begin(), table.end());
  return parse_scene("problem = \"any\"\ntime.end = 1.0\nintegrator.name = \"any\"\n" + text, name,
                     {}, [&](const std::string&) { return keys; });
}

template <int dim>
CounterBody<dim> body_of(const std::string& text, Section section = Section::plane) {
  return read_counter_body<dim>(scene_of("[counter_body]\n" + text), section);
}

/// What read_counter_body says; empty where it reads.
template <int dim>
std::string refusal(const std::string& text, Section section = Section::plane) {
  try {
    body_of<dim>(text, section);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

}  // namespace gnomon::testing
