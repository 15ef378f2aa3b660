#include "app/study_flags.hpp"

#include <thread>

namespace gnomon::app {

void add_jobs(CLI::App* command, int& jobs) {
  command
      ->add_option("--jobs", jobs, "Number of runs at the same time; default: the number of cores")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
}

StudyOptions options_of_runs(int jobs, bool resume) {
  StudyOptions options;
  options.program = std::filesystem::read_symlink("/proc/self/exe");
  options.jobs = jobs > 0 ? jobs : std::max(1, int(std::thread::hardware_concurrency()));
  options.resume = resume;
  return options;
}

void add_flags_of_studies(CLI::App* command, bool& resume, bool& quiet) {
  command->add_flag("--resume", resume, "Continues in an existing folder and keeps finished runs");
  command->add_flag("--quiet", quiet, "Prints nothing but errors");
}

}  // namespace gnomon::app
