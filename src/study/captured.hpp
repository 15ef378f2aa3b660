// A program that is called for what it prints.
#pragma once

#include <string>
#include <vector>

namespace gnomon::study {

struct Captured {
  int exit_code = 0;
  std::string out, err;
};

/// Waits for a program, which is looked for in PATH. Throws Error if it cannot be started.
Captured run_captured(const std::vector<std::string>& arguments);

}  // namespace gnomon::study
