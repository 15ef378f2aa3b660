// Options that several commands with many runs have.
#pragma once

#include <CLI/CLI.hpp>
#include <gnomon/study/study.hpp>

namespace gnomon::app {

void add_jobs(CLI::App* command, int& jobs);
/// With all cores for 0 jobs.
StudyOptions options_of_runs(int jobs, bool resume);
void add_flags_of_studies(CLI::App* command, bool& resume, bool& quiet);

}  // namespace gnomon::app
