// The memory that the process uses.
#pragma once

#include <fstream>
#include <string>

namespace gnomon::bench {

/// Peak resident memory of the process [MB].
inline double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  return 0;
}

}  // namespace gnomon::bench
