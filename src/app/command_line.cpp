#include "app/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/run/plugin.hpp>
#include <gnomon/scene/scene.hpp>

#include "app/options.hpp"

namespace gnomon::app {

namespace {

/// Throws InputError that names the option, because the scene does not contain it.
const std::string& known_integrator(const std::string& name) {
  try {
    Integrators::find(name, "integrator");
  } catch (const InputError& error) {
    throw InputError(fmt::format("--integrator: {}", error.what()));
  }
  return name;
}

/// Loads a plug-in, also into the processes that this one starts, as the runs of a study are.
void load_for_all(const std::filesystem::path& plugin) {
  load_plugin(plugin);
  const char* earlier = std::getenv("GNOMON_PLUGINS");
  const std::string name = std::filesystem::absolute(plugin).string();
  setenv("GNOMON_PLUGINS", (earlier ? earlier + (":" + name) : name).c_str(), 1);
}

void add_summary(CLI::App* command, std::filesystem::path& summary) {
  add_name(command, "--summary", summary, "FILE.json",
           "Also writes a summary as JSON; - prints it instead");
}

}  // namespace

CommandLine::CommandLine()
    : app_("gnomon computes how wear changes the shape of bodies over time.", "gnomon") {
  app_.set_help_flag("-h,--help", "Shows this help");
  app_.add_flag_callback(
      "--version", [this] { command_ = version_command; },
      "Shows the versions of gnomon and its libraries");
  add_name(&app_, "--plugin", plugins_, "FILE.so",
           "Loads a plug-in; stands before the command; repeatable; GNOMON_PLUGINS=A.so:B.so does "
           "the same")
      ->allow_extra_args(false);
  app_.require_subcommand(0, 1);
  app_.footer(
      "More: gnomon help TOPIC, with TOPIC one of scene [PROBLEM], studies, integrators,\n"
      "commands, units, output, exit-codes, or a command; man-page (roff) and completion (bash) "
      "are\n"
      "files to install.");
  add_run();
  add_resume();
  add_study();
  add_extremes();
  add_check();
  add_inspection();
  add_meshes();
  add_compare();
  add_budget();
  add_plan();
  add_stability();
  add_plot();
  add_help();
  refuse_values_of_flags(&app_);
}

void CommandLine::on(CLI::App* command, std::function<void()> run) {
  command->callback([this, run = std::move(run)] { command_ = run; });
}

void CommandLine::add_run() {
  CLI::App* command = app_.add_subcommand("run", "Integrates a scene in time");
  add_argument(command, "SCENE", run_.scene, "Scene file (TOML)");
  command->add_option("--integrator", integrator_, "The same as --set integrator.name=NAME")
      ->type_name("NAME");
  add_overrides(command, run_.overrides);
  add_name(command, "-o,--output", run_.result, "RESULT.h5",
           "Result file; default: SCENE's name, -NAME and .h5, in the current folder");
  command->add_flag(
      "--force", run_.force,
      "Replaces result, sidecar and summary of an earlier run, once the start is solved");
  add_summary(command, run_.summary);
  add_quiet(command, run_.quiet);
  on(command, [this] {
    if (integrator_) run_.overrides.push_back("integrator.name=" + known_integrator(*integrator_));
    exit_code_ = run_command(run_);
  });
}

void CommandLine::add_resume() {
  CLI::App* command = app_.add_subcommand(
      "resume", "Continues a run that was interrupted, failed, was killed, or has ended");
  add_argument(command, "RESULT", run_.result, "Result file (HDF5); the new steps are added to it");
  add_number(command, "--end", run_.end, "T", "A later end; the same as --set time.end=T");
  add_overrides(command, run_.overrides);
  command->add_flag("--force", run_.force, "Replaces an earlier summary");
  add_summary(command, run_.summary);
  add_quiet(command, run_.quiet);
  on(command, [this] { exit_code_ = resume_command(run_); });
}

void CommandLine::add_check() {
  CLI::App* command =
      app_.add_subcommand("check", "Validates a scene; prints all its keys and its unknowns");
  add_argument(command, "SCENE", run_.scene, "Scene file (TOML)");
  add_overrides(command, run_.overrides);
  on(command, [this] { check_command(run_.scene, run_.overrides); });
}

void CommandLine::add_extremes() {
  CLI::App* command = app_.add_subcommand(
      "extremes", "Runs studies at the extremes of their parameters and judges every run");
  add_name(command, "STUDIES", extremes_.studies, "",
           "Study files (TOML) and folders of them; default: problems/*/extremes");
  add_name(command, "-o,--output", extremes_.folder, "DIR",
           "Folder of the results; default: extremes, in the current folder");
  add_jobs(command, extremes_.jobs);
  add_number(command, "--limit", extremes_.limit, "SECONDS",
             "Wall time after which a run counts as hung; default: 300")
      ->check(CLI::Range(0.01, 1e6));
  add_flags_of_studies(command, extremes_.resume, extremes_.quiet);
  on(command, [this] { extremes_command(extremes_); });
}

void CommandLine::add_compare() {
  CLI::App* command = app_.add_subcommand("compare", "Compares results in a table");
  add_argument(command, "RESULTS", results_, "Result files (HDF5)");
  add_name(command, "--reference", reference_, "RESULT.h5",
           "Result against which shape errors are measured; default: the last result");
  on(command, [this] { compare_command(results_, reference_); });
}

void CommandLine::add_budget() {
  CLI::App* command = app_.add_subcommand(
      "budget", "Tells how wrong the result of a scene is, and by what, from further runs of it");
  add_argument(command, "SCENE", budget_.scene, "Scene file (TOML)");
  add_overrides(command, budget_.overrides);
  command->add_flag("--json", budget_.json, "Prints it as JSON");
  add_quiet(command, budget_.quiet);
  on(command, [this] { budget_command(budget_); });
}

void CommandLine::add_plan() {
  CLI::App* command = app_.add_subcommand(
      "plan", "Shows the settings that meet accuracy.within at the least cost, by pilot runs");
  add_argument(command, "SCENE", budget_.scene, "Scene file (TOML)");
  add_overrides(command, budget_.overrides);
  add_quiet(command, budget_.quiet);
  on(command, [this] { plan_command(budget_); });
}

void CommandLine::add_stability() {
  CLI::App* command = app_.add_subcommand(
      "stability",
      "Shows the spectrum of the wear rate, and the largest stable step of every explicit method");
  add_argument(command, "SCENE", stability_.scene, "Scene file (TOML)");
  add_number(command, "--time", stability_.times, "T",
             "Time at which the spectrum is computed; repeatable; default: the start, time.end / 5 "
             "and time.end")
      ->allow_extra_args(false);
  command
      ->add_option("--integrator", stability_.methods,
                   "An explicit method to show; repeatable; default: all of them")
      ->type_name("NAME")
      ->allow_extra_args(false);
  add_overrides(command, stability_.overrides);
  add_number(command, "--rtol", stability_.rtol, "R",
             "Relative tolerance of the run to these times, by esdirk-4; default: 1e-5");
  command->add_flag("--no-onset", stability_.no_onset,
                    "Only the linearized equations: does not measure the onset of instability");
  command->add_flag("--all", stability_.all,
                    "The whole spectrum instead of the largest eigenvalues");
  add_name(command, "-o,--output", stability_.folder, "DIR",
           "Folder for spectrum.csv and critical_steps.csv; made if it does not exist");
  on(command, [this] { stability_command(stability_); });
}

void CommandLine::add_plot() {
  CLI::App* command =
      app_.add_subcommand("plot", "Draws figures as PNG and SVG, and pages of studies");
  add_argument(command, "RESULT|DIR", results_,
               "Result files (HDF5), and folders of studies, spectra or results")
      ->check(check_file_name);
  add_name(command, "-o,--output", figures_, "DIR",
           "Folder of the figures, then without pages; default: the folder figures beside each "
           "target");
  on(command, [this] { plot_command(results_, figures_); });
}

void CommandLine::add_help() {
  CLI::App* command = app_.add_subcommand("help", "Explains a topic");
  command->add_option("TOPIC", topic_, "One of the topics below; default: the overview")
      ->type_name("");
  command
      ->add_option("PROBLEM", problem_,
                   "For the topic scene: the problem whose keys are shown; default: all problems")
      ->type_name("");
  on(command, [this] { help(); });
}

void CommandLine::help() const {
  const std::vector<std::string> commands = command_names();
  const auto print = [](const CLI::App* app, const std::string& parent) {
    // App::help() would describe the command that was parsed, which is `help`.
    fmt::print("{}", app->get_formatter()->make_help(app, parent, CLI::AppFormatMode::Normal));
  };
  const auto is_in = [this](const std::vector<std::string>& names) {
    return std::ranges::find(names, *topic_) != names.end();
  };
  if (!topic_) {
    print(&app_, "gnomon");
  } else if (problem_ && *topic_ != "scene") {
    throw InputError(
        fmt::format("unexpected argument `{}`, see `gnomon help {}`", *problem_, *topic_));
  } else if (*topic_ == "man-page") {
    fmt::print("{}", man_page(app_));
  } else if (*topic_ == "completion") {
    fmt::print("{}", bash_completion(app_));
  } else if (*topic_ == "commands") {
    for (const std::string& name : commands) {
      print(app_.get_subcommand(name), "gnomon " + name);
      fmt::print("\n");
    }
  } else if (is_in(help_topics())) {  // scene, which is a command too, is asked for more often
    fmt::print("{}", topic_text(*topic_, problem_));
  } else if (is_in(commands)) {
    print(app_.get_subcommand(*topic_), "gnomon " + *topic_);
  } else {
    std::vector<std::string> known = help_topics();
    known.insert(known.end(), {"commands", "man-page", "completion"});
    known.insert(known.end(), commands.begin(), commands.end());
    const std::string near = nearest_name(*topic_, known);
    throw InputError(
        fmt::format("unknown topic `{}`, {}", *topic_,
                    near.empty() ? "see `gnomon help`" : "did you mean `" + near + "`?"));
  }
}

std::vector<std::string> CommandLine::command_names() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

int CommandLine::operator()(int argc, char** argv) {
  try {
    app_.parse(argc, argv);
  } catch (const CLI::CallForHelp& request) {
    const auto [command, words] = chosen_command();
    fmt::print("{}", command == &app_ ? app_.help() : command->help(words));
    return success;
  }
  if (!command_) throw InputError("expected a command, see `gnomon help`");
  load_plugins_of_environment();
  for (const std::filesystem::path& plugin : plugins_) load_for_all(plugin);
  command_();
  return exit_code_;
}

std::pair<const CLI::App*, std::string> CommandLine::chosen_command() const {
  const CLI::App* command = &app_;
  std::string words;
  for (auto chosen = app_.get_subcommands(); !chosen.empty(); chosen = command->get_subcommands()) {
    words += (words.empty() ? "" : " ") + command->get_name();
    command = chosen.front();
  }
  return {command, words};
}

std::string CommandLine::complaint(const CLI::ParseError& error) const {
  const auto chosen = app_.get_subcommands();
  const CLI::App* command = chosen_command().first;
  const bool overview = chosen.empty() || command->get_name() == "help";
  const std::string help = overview ? "gnomon help" : "gnomon help " + chosen.front()->get_name();
  for (const std::string& word : app_.remaining(true)) {
    const bool option = word.starts_with("-");
    if (!option && !chosen.empty()) continue;
    std::vector<std::string> known = option ? std::vector<std::string>{} : command_names();
    if (option)
      for (const CLI::Option* candidate : command->get_options())
        for (const std::string& name : candidate->get_lnames()) known.push_back("--" + name);
    const std::string near = nearest_name(word.substr(0, word.find('=')), known);
    return fmt::format("unknown {} `{}`, {}", option ? "option" : "command", word,
                       near.empty() ? "see `" + help + "`" : "did you mean `" + near + "`?");
  }
  for (const std::string& word : app_.remaining(true))
    return fmt::format("unexpected argument `{}`, see `{}`", word, help);
  return fmt::format("{}, see `{}`", error.what(), help);
}

}  // namespace gnomon::app
