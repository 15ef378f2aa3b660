// The data of a run in a checkpoint, without rounding: state, the stepper's memory, the chattering
// counts.
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

/// A state as numbers.
std::vector<double> packed(const State& state, const Structure& structure);
/// Throws InputError if the numbers do not belong to a system with this structure.
State unpacked_state(const std::vector<double>& numbers, const Structure& structure);

/// The data as numbers, whose count is the same at every checkpoint of an epoch.
std::vector<double> packed(const RunMemory& memory, const Structure& structure);
/// Throws InputError if the numbers do not belong to a system with this structure.
RunMemory unpacked(const std::vector<double>& numbers, const Structure& structure);

}  // namespace gnomon
