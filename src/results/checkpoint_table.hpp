// The dataset "checkpoints" of "gnomon", or of an epoch: two rows to which checkpoints are written
// in turn, so that one of them is complete whenever a run is killed. A checksum shows which one.
#pragma once

#include <hdf5.h>

#include <gnomon/results/results.hpp>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::layout {

class CheckpointTable {
public:
  CheckpointTable() = default;
  /// Creates the table in a group, for checkpoints of `count` numbers.
  static CheckpointTable create(hid_t group, std::size_t count);

  /// Throws hdf5::Failure if the checkpoint has a different count of numbers.
  void put(const Checkpoint& checkpoint);
  explicit operator bool() const { return static_cast<bool>(dataset_); }

private:
  hdf5::Handle dataset_;
  std::size_t count_ = 0;
};

/// The complete checkpoints, ascending by number; none if there is no table.
std::vector<Checkpoint> read_checkpoints(hid_t group);

}  // namespace gnomon::layout
