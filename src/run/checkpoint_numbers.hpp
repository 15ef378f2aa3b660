// What a checkpoint holds of a run: state, the stepper's memory, the chattering count; all of it
// exact.
#pragma once

#include <gnomon/model/model.hpp>
#include <vector>

#include "run/chattering.hpp"

namespace gnomon {

struct RunMemory {
  State state;
  std::vector<double> stepper;  ///< Stepper::memory()
  Chattering chattering;
};

/// As numbers whose count is the same at every checkpoint of a run.
std::vector<double> packed(const RunMemory& memory, const Structure& structure);
/// Throws InputError when they are not those of a system with this structure.
RunMemory unpacked(const std::vector<double>& numbers, const Structure& structure);

}  // namespace gnomon
