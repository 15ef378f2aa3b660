// Options that several commands have, and checks of arguments.
#pragma once

#include <CLI/CLI.hpp>
#include <gnomon/study/study.hpp>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace gnomon::app {

/// Checks of an argument as CLI11 requires them: a complaint, empty if there is none.
std::string check_file_name(const std::string& name);
std::string check_number(const std::string& text);

/// CLI11 lets a flag take a value (--quiet=3), which has no meaning here. Includes all subcommands.
void refuse_values_of_flags(CLI::App* command);

/// An argument, which the command needs.
template <class Value>
CLI::Option* add_argument(CLI::App* command, const std::string& name, Value& value,
                          const std::string& help) {
  return command->add_option(name, value, help)->required()->type_name("");
}
/// An option that takes the name of a file or folder.
template <class Value>
CLI::Option* add_name(CLI::App* command, const std::string& option, Value& value,
                      const std::string& type, const std::string& help) {
  return command->add_option(option, value, help)->type_name(type)->check(check_file_name);
}
template <class Value>
CLI::Option* add_number(CLI::App* command, const std::string& option, Value& value,
                        const std::string& type, const std::string& help) {
  return command->add_option(option, value, help)->type_name(type)->check(check_number);
}

void add_overrides(CLI::App* command, std::vector<std::string>& overrides);
void add_quiet(CLI::App* command, bool& quiet);
void add_jobs(CLI::App* command, int& jobs);
/// With all cores for 0 jobs.
StudyOptions options_of_runs(const StudyCommandOptions& given);
void add_flags_of_studies(CLI::App* command, bool& resume, bool& quiet);

}  // namespace gnomon::app
