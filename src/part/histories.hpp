// What readers of a part's scene share: refusals, entries of arrays of tables, directions,
// histories.
#pragma once

#include <functional>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/section.hpp>
#include <gnomon/scene/keys.hpp>
#include <string>
#include <vector>

namespace gnomon::part {

/// Throws InputError for the value of a key, in the place of which something else was expected.
[[noreturn]] void refuse(const Scene& scene, const std::string& key, const std::string& expected);

/// The entries of `[[table]]`, which has these keys: "load.1" and so on. Throws InputError where
/// one lacks a needed key.
std::vector<std::string> entries_of(const Scene& scene, const std::string& table,
                                    const std::vector<Key>& keys,
                                    const std::vector<std::string>& needed);

/// What a mesh in the plane is a section of; of no meaning in space.
Section section_of(const Scene& scene);

/// "x", "y", and in space "z", or "r", "z" of a body of revolution.
template <int dim>
std::vector<std::string> direction_names(const Scene& scene);

Key density_key(const std::string& name, std::function<std::string(const Scene&)> idle = {});

/// PREFIX.times and PREFIX.factors, the history of a quantity.
Key times_key(const std::string& prefix, const std::string& quantity);
Key factors_key(const std::string& prefix, const std::string& quantity);

/// That history; without the keys the factor is one. Throws InputError.
LoadHistory read_history(const Scene& scene, const std::string& prefix);

}  // namespace gnomon::part
