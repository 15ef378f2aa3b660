// How a path is loaded for the first time (docs/fretting.md): cycle.loading.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>

namespace gnomon::part {

std::vector<Key> first_loading_keys();

/// The steps of the first loading. Throws InputError.
std::vector<LoadingStep> read_first_loading(const Scene& scene, bool sticks);

/// For the user: that the first loading matters, since the bodies are unlike; empty: it does not.
template <int dim>
std::string history_that_matters(const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
