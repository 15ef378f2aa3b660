#include "results/epoch_groups.hpp"

#include <fmt/format.h>

#include "results/checkpoint_table.hpp"
#include "results/hdf5_values.hpp"
#include "results/layout.hpp"
#include "results/result_parts.hpp"
#include "results/stored_mesh.hpp"

namespace gnomon::layout {

using hdf5::Handle;
using hdf5::own;

namespace {

constexpr const char* kEpochs = "epochs";
constexpr const char* kWhole = "whole";

Handle open_epoch(hid_t gnomon, std::size_t epoch) {
  return own(H5Gopen2(gnomon, epoch_path(epoch).c_str(), H5P_DEFAULT), H5Gclose, "open an epoch");
}

long read_count(const Handle& group, const char* name) {
  return count_of(static_cast<std::int64_t>(hdf5::read_number_attribute(group.id(), name)),
                  "read the epochs");
}

}  // namespace

std::string epoch_path(std::size_t epoch) {
  return fmt::format("{}/{:04}", kEpochs, epoch);
}

Handle begin_epoch(hid_t gnomon, std::size_t epoch, const EpochStart& start,
                   const std::optional<Grid>& new_grid) {
  if (!hdf5::exists(gnomon, kEpochs)) create_group(gnomon, kEpochs, kStepsPerGroup);
  Handle group = create_group(gnomon, epoch_path(epoch), 3);
  hdf5::write_attribute(group.id(), "rows", static_cast<double>(start.rows));
  hdf5::write_attribute(group.id(), "stored", static_cast<double>(start.stored));
  hdf5::write_dataset(group.id(), "state", {start.numbers.size()}, start.numbers.data());
  if (new_grid) write_mesh(group.id(), *new_grid);
  return group;
}

void finish_epoch(const Handle& group) {
  hdf5::write_attribute(group.id(), kWhole, 1.0);
}

std::vector<EpochStart> read_epochs(hid_t gnomon) {
  std::vector<EpochStart> epochs;
  if (!hdf5::exists(gnomon, kEpochs)) return epochs;
  while (hdf5::exists(gnomon, epoch_path(epochs.size() + 1))) {
    const Handle group = open_epoch(gnomon, epochs.size() + 1);
    if (H5Aexists(group.id(), kWhole) <= 0) break;
    epochs.push_back({read_count(group, "rows"), read_count(group, "stored"),
                      hdf5::read_doubles(group.id(), "state").values});
  }
  return epochs;
}

std::vector<Checkpoint> read_last_checkpoints(hid_t gnomon) {
  for (std::size_t epoch = read_epochs(gnomon).size(); epoch > 0; --epoch) {
    auto checkpoints = read_checkpoints(open_epoch(gnomon, epoch).id());
    for (Checkpoint& checkpoint : checkpoints) checkpoint.epoch = static_cast<long>(epoch);
    if (!checkpoints.empty()) return checkpoints;
  }
  return read_checkpoints(gnomon);
}

std::optional<Grid> read_grid_of_epoch(hid_t file, hid_t gnomon, std::size_t epoch) {
  for (; epoch > 0; --epoch)
    if (hdf5::exists(gnomon, epoch_path(epoch) + "/mesh"))
      return read_grid(open_epoch(gnomon, epoch).id());
  return read_grid(file);
}

}  // namespace gnomon::layout
