// The command line: which commands and options exist, and the variables that they set.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "app/program.hpp"

namespace gnomon::app {

class CommandLine {
public:
  CommandLine();

  /// Parses and runs the command. Throws CLI::ParseError as CLI11 does.
  int operator()(int argc, char** argv);

  /// One line on a parse error, with the nearest command or option for an unknown one.
  std::string complaint(const CLI::ParseError& error) const;

private:
  /// What the command does, if it is given.
  void on(CLI::App* command, std::function<void()> run);
  void add_run();
  void add_resume();
  void add_check();
  void add_study();
  void add_parts_of_study(CLI::App* study);
  void add_extremes();
  void add_inspection();
  void add_meshes();
  void add_compare();
  void add_budget();
  void add_plan();
  void add_stability();
  void add_plot();
  void add_help();
  void help() const;
  std::vector<std::string> command_names() const;
  /// The innermost command that was parsed, or the program, and the words before it.
  std::pair<const CLI::App*, std::string> chosen_command() const;

  CLI::App app_;
  std::function<void()> command_;
  int exit_code_ = success;

  // The variables that the options set; each command uses its own part.
  RunOptions run_;
  StudyCommandOptions study_;
  StudyCommandOptions extremes_{.folder = "extremes", .limit = 300};
  BudgetOptions budget_;
  StabilityOptions stability_;
  std::optional<std::string> integrator_;
  std::string subject_;
  std::filesystem::path result_;
  std::string time_;
  std::optional<double> size_;
  std::filesystem::path scene_;
  std::vector<std::filesystem::path> results_;
  std::filesystem::path reference_;
  std::filesystem::path figures_;
  std::optional<std::string> topic_;
  std::optional<std::string> problem_;
  std::vector<std::filesystem::path> plugins_;
};

/// gnomon.1, in roff.
std::string man_page(const CLI::App& app);

/// A script for bash: commands, options, and the names that some options take.
std::string bash_completion(const CLI::App& app);

}  // namespace gnomon::app
