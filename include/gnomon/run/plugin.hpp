// Plug-ins: shared libraries of users, whose registrations (scene/registry.hpp) add integrators,
// problems, laws, materials or terms to a program that is running.
#pragma once

#include <filesystem>

namespace gnomon {

/// Loads a plug-in, for the rest of the process. Throws InputError if it cannot be loaded (it is
/// no shared library, or made for another version of gnomon), registers nothing, or registers a
/// name that is taken.
void load_plugin(const std::filesystem::path& file);

/// Loads the plug-ins that the environment variable GNOMON_PLUGINS names, separated by colons.
/// Throws InputError that names the variable too.
void load_plugins_of_environment();

}  // namespace gnomon
