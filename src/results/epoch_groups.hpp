// The groups "gnomon/epochs/0001", ...: the beginnings of epochs, and what only an epoch has: its
// mesh, unless it is that of the epoch before, and its checkpoints. These are the dataset
// "checkpoints" of "gnomon", or of an epoch: two rows to which checkpoints are written in turn, so
// that one of them is complete whenever a run is killed. A checksum shows which one.
#pragma once

#include <hdf5.h>

#include <gnomon/results/results.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::layout {

/// "epochs/0001" in the group "gnomon".
std::string epoch_path(std::size_t epoch);

/// Creates the group of an epoch; returns it. It counts when finish_epoch() has been called and
/// both have been flushed, in this order.
hdf5::Handle begin_epoch(hid_t gnomon, std::size_t epoch, const EpochStart& start,
                         const std::optional<Grid>& new_grid);
void finish_epoch(const hdf5::Handle& group);

/// The beginnings of all whole epochs after the first.
std::vector<EpochStart> read_epochs(hid_t gnomon);
/// The checkpoints of the last epoch that has one.
std::vector<Checkpoint> read_last_checkpoints(hid_t gnomon);
/// The mesh of an epoch; 0 is the first, whose mesh is that of `file`.
std::optional<Grid> read_grid_of_epoch(hid_t file, hid_t gnomon, std::size_t epoch);

/// A dataset in a group, for checkpoints of `count` numbers.
hdf5::Handle create_checkpoints(hid_t group, std::size_t count);
/// Throws hdf5::Failure if the checkpoint has a different count of numbers.
void write_checkpoint(const hdf5::Handle& dataset, const Checkpoint& checkpoint);
}  // namespace gnomon::layout
