// The man page and the completion of the shell, made from the command line and the key tables.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace gnomon::app {

/// gnomon.1, in roff.
std::string man_page(const CLI::App& app);

/// A script for bash: commands, options, and the names that some options take.
std::string bash_completion(const CLI::App& app);

}  // namespace gnomon::app
