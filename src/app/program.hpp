// The program: command line in, exit code out. Only src/app prints.
#pragma once

namespace gnomon::app {

/// Exit codes of the program (`gnomon help exit-codes`).
enum ExitCode : int { success = 0, other_failure = 1, bad_input = 2, solution_failed = 3 };

/// Parses the command line, runs the command, and maps exceptions to exit codes.
int program(int argc, char** argv);

}  // namespace gnomon::app
