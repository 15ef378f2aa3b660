#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::app {

/// What CLI11 asks of a check of an argument: a complaint, empty when there is none.
std::string check_file_name(const std::string& name);
std::string check_number(const std::string& text);

/// CLI11 lets a flag take a value (--quiet=3), which says nothing here. Of all commands below, too.
void refuse_values_of_flags(CLI::App* command);

}  // namespace gnomon::app
