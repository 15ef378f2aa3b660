// The contents of a study file, before it is expanded into runs.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/keyed_table.hpp"
#include "study/methods.hpp"

namespace gnomon::study {

/// A [[sweep]].
struct Sweep {
  std::string key;
  std::string unit;  ///< of the key
  std::vector<SceneSetting> values;
  std::vector<std::string> labels;  ///< of the values: "20", "20x40"
  std::string origin;
};

/// The [self_reference].
struct SelfReference {
  std::size_t method = 0;
  StudySetting setting;
};

struct Declaration {
  std::string file;
  std::string text;
  std::string title;
  std::filesystem::path scene;
  std::vector<double> times;  ///< empty: five equal parts
  std::string times_origin;
  std::vector<SceneSetting> common;
  std::vector<Method> methods;
  bool compared = true;            ///< false: reference = "none"
  std::vector<Method> references;  ///< empty unless compared
  bool chosen_references = false;  ///< by [[reference]], and so in place of a closed form
  std::vector<Sweep> sweeps;
  std::optional<SelfReference> self_reference;
};

/// Reads and checks a study file. Throws InputError.
Declaration read_declaration(const std::filesystem::path& file, Impossible impossible);

/// The closed form of a problem as the reference of a study: the contact surface at these times;
/// empty without one. Throws InputError for a problem that has no contact surface to compare.
std::vector<ContactSurface> closed_form(const Model& model, const std::vector<double>& times);

/// What a file of TOML says of itself at its beginning; empty without a comment there.
std::string first_comment(const std::string& text);

}  // namespace gnomon::study
