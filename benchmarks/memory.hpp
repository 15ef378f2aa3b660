// What the process takes of the machine's memory.
#pragma once

#include <fstream>
#include <string>

namespace gnomon::bench {

/// Largest memory that the process ever had in RAM [MB].
inline double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  return 0;
}

}  // namespace gnomon::bench
