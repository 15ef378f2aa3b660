// The dataset "gnomon/checkpoints": two places that checkpoints are written to in turn, so that one
// of them is whole whenever a run is killed. Which it is, a checksum tells.
#pragma once

#include <hdf5.h>

#include <gnomon/results/results.hpp>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::layout {

class CheckpointTable {
public:
  CheckpointTable() = default;
  /// Below the group "gnomon", for checkpoints of `count` numbers.
  static CheckpointTable create(hid_t gnomon, std::size_t count);

  /// Throws hdf5::Failure when the checkpoint has another count of numbers.
  void put(const Checkpoint& checkpoint);
  explicit operator bool() const { return static_cast<bool>(dataset_); }

private:
  hdf5::Handle dataset_;
  std::size_t count_ = 0;
};

/// Those that are whole, ascending by number; none when there is no table.
std::vector<Checkpoint> read_checkpoints(hid_t gnomon);

}  // namespace gnomon::layout
