#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::app {

/// A check of an argument as CLI11 requires it: returns a complaint, empty if there is none.
std::string check_file_name(const std::string& name);
std::string check_number(const std::string& text);

/// CLI11 lets a flag take a value (--quiet=3), which has no meaning here. Includes all subcommands.
void refuse_values_of_flags(CLI::App* command);

}  // namespace gnomon::app
