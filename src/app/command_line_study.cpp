// gnomon study and its parts: plan, run, collect.

#include "app/command_line.hpp"
#include "app/options.hpp"

namespace gnomon::app {

namespace {

void add_study_file(CLI::App* command, StudyCommandOptions& options, bool required) {
  command
      ->add_option("STUDY", options.study,
                   "Study file (TOML), see gnomon help studies; one that is called plan, run or "
                   "collect is given as ./plan")
      ->required(required)
      ->type_name("");
  add_name(command, "-o,--output", options.folder, "DIR",
           "Folder of the results; default: STUDY's name, in the current folder");
}

void add_planned_folder(CLI::App* command, StudyCommandOptions& options) {
  add_argument(command, "DIR", options.folder, "Folder that gnomon study plan has made")
      ->check(check_file_name);
}

void add_times(CLI::App* command, StudyCommandOptions& options) {
  add_number(
      command, "--lost-after", options.lost_after, "SECONDS",
      "Time without a sign of life after which a run of another process counts as lost and is "
      "done again; default: 120")
      ->check(CLI::Range(0.1, 1e6));
}

void add_executor(CLI::App* command, StudyCommandOptions& options) {
  command
      ->add_option("--executor", options.executor,
                   "Who does the runs: local (this process), slurm (job arrays); default: local")
      ->type_name("NAME")
      ->check(CLI::IsMember({"local", "slurm"}));
  command
      ->add_option("--slurm-option", options.slurm_options,
                   "An option for sbatch, as --slurm-option=--time=60; repeatable")
      ->type_name("OPTION")
      ->allow_extra_args(false);
  add_number(command, "--poll", options.poll, "SECONDS",
             "Time between looks at the jobs of Slurm; default: 10")
      ->check(CLI::Range(0.05, 1e6));
}

}  // namespace

void CommandLine::add_study() {
  CLI::App* command = app_.add_subcommand(
      "study", "Runs a scene with many methods and settings; makes a table of results and costs");
  add_study_file(command, study_, false);
  add_jobs(command, study_.jobs);
  add_flags_of_studies(command, study_.resume, study_.quiet);
  add_executor(command, study_);
  add_times(command, study_);
  command->require_subcommand(0, 1);
  command->callback([this] {
    if (!command_) command_ = [this] { study_command(study_); };
  });
  add_parts_of_study(command);
}

void CommandLine::add_parts_of_study(CLI::App* study) {
  CLI::App* plan =
      study->add_subcommand("plan", "Makes the folder of a study with the scenes of all its runs");
  add_study_file(plan, study_, true);
  add_flags_of_studies(plan, study_.resume, study_.quiet);
  on(plan, [this] { study_plan_command(study_); });

  CLI::App* run = study->add_subcommand(
      "run", "Does runs of a planned study that are not done and that nobody else is doing");
  add_planned_folder(run, study_);
  add_argument(run, "NUMBERS", study_.numbers,
               "Runs by their numbers in plan.csv: one (3), a range (3-7), or several of both with "
               "commas and without blanks (3,5,9-12)");
  add_jobs(run, study_.jobs);
  add_times(run, study_);
  add_quiet(run, study_.quiet);
  on(run, [this] { study_run_command(study_); });

  CLI::App* collect = study->add_subcommand(
      "collect", "Makes the tables and the page of a planned study, and tells what is missing");
  add_planned_folder(collect, study_);
  add_quiet(collect, study_.quiet);
  on(collect, [this] { study_collect_command(study_); });
}

}  // namespace gnomon::app
