#include "app/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/number_text.hpp>
#include <thread>

namespace gnomon::app {

std::string check_file_name(const std::string& name) {
  return name.empty() ? "expected a name, got an empty text" : "";
}

std::string check_number(const std::string& text) {
  const auto number = parsed_number<double>(text);
  return number && std::isfinite(*number) ? ""
                                          : fmt::format("expected a finite number, got `{}`", text);
}

void refuse_values_of_flags(CLI::App* command) {
  for (CLI::Option* option : command->get_options())
    if (option->get_items_expected_max() == 0) option->disable_flag_override();
  for (CLI::App* below : command->get_subcommands([](CLI::App*) { return true; }))
    refuse_values_of_flags(below);
}

/// Each occurrence takes one argument, so that the arguments after it are not taken too.
void add_overrides(CLI::App* command, std::vector<std::string>& overrides) {
  command->add_option("--set", overrides, "Replaces a scene key; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_quiet(CLI::App* command, bool& quiet) {
  command->add_flag("--quiet", quiet, "Prints nothing but errors");
}

void add_jobs(CLI::App* command, int& jobs) {
  command
      ->add_option("--jobs", jobs, "Number of runs at the same time; default: the number of cores")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
}

StudyOptions options_of_runs(const StudyCommandOptions& given) {
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  return {.folder = given.folder,
          .program = std::filesystem::read_symlink("/proc/self/exe"),
          .jobs = given.jobs > 0 ? given.jobs : cores,
          .resume = given.resume,
          .limit = given.limit,
          .lost_after = given.lost_after};
}

void add_flags_of_studies(CLI::App* command, bool& resume, bool& quiet) {
  command->add_flag("--resume", resume, "Continues in an existing folder and keeps finished runs");
  add_quiet(command, quiet);
}

}  // namespace gnomon::app
