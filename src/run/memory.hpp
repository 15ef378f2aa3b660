// What a run remembers: its data in a checkpoint, without rounding (state, the stepper's memory,
// the chattering counts), and its models, one for each epoch.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "run/guards.hpp"

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

class Epochs {
public:
  /// `first`: the model of the first epoch; it outlives this object.
  explicit Epochs(const Model& first) : first_(first) {}

  /// The model of the present epoch.
  const Model& model() const { return successor_ ? *successor_ : first_; }
  /// Null while the first is the present one.
  const std::shared_ptr<const Model>& successor() const { return successor_; }
  long number() const { return number_; }

  /// Asks the model after an accepted step whether another one follows; then that is the present
  /// one, and `state` becomes its state. The model before lives as long as the returned value.
  struct Change {
    std::shared_ptr<const Model> before;  ///< null: the first
    EpochStart start;                     ///< without its place in the result
    bool same_unknowns;
  };
  std::optional<Change> succeed(State& state);
  /// At the start: the model that should have been there from the beginning, with the same unknowns
  /// and without an epoch. Whether there is one.
  bool replace_overdue(State& state);
  /// Makes the models again that followed at these states. Throws InputError where none follows.
  void repeat(std::span<const EpochStart> starts);

private:
  const Model& first_;
  std::shared_ptr<const Model> successor_;
  long number_ = 0;
};

}  // namespace gnomon
