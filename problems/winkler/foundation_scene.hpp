// The scene of the pin on springs.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <memory>
#include <vector>

#include "winkler_system.hpp"

namespace gnomon::winkler {

std::vector<Key> foundation_keys();

/// With as many phases of a cycle as its tolerance asks for where cycle.phases is "auto". Throws
/// InputError.
std::shared_ptr<const Foundation> read_foundation(const Scene& scene);

/// Whether the wear rate is k v p, for which the closed form holds.
bool has_archard_rate(const Scene& scene);

}  // namespace gnomon::winkler
