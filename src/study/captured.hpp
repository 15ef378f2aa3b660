// A program that is called for what it prints.
#pragma once

#include <string>
#include <vector>

namespace gnomon::study {

struct Captured {
  int exit_code = 0;  ///< -1: it has none; 127: there is no such program
  int signal = 0;     ///< that ended it
  std::string out, err;
};

/// Waits for a program, which is looked for in PATH. Throws Error if no process can be started.
Captured run_captured(const std::vector<std::string>& arguments);

}  // namespace gnomon::study
