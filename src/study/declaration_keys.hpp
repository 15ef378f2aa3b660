// The keys of a study file, each specified once.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <vector>

namespace gnomon::study {

std::vector<Key> top_keys();
std::vector<Key> sweep_keys();
std::vector<Key> method_keys();
std::vector<Key> reference_keys();

}  // namespace gnomon::study
