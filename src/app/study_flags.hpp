// Options that several commands with many runs have.
#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::app {

void add_jobs(CLI::App* command, int& jobs);
void add_flags_of_studies(CLI::App* command, bool& resume, bool& quiet);

}  // namespace gnomon::app
