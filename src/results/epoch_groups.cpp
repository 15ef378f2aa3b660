#include "results/epoch_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "results/hdf5_values.hpp"
#include "results/layout.hpp"
#include "results/stored_mesh.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;

namespace {

constexpr const char* kEpochs = "epochs";
constexpr const char* kWhole = "whole";
constexpr const char* kCheckpoints = "checkpoints";
constexpr hsize_t kPlaces = 2;
constexpr std::size_t kHead = 4;  // checksum, number, rows, stored

Handle open_epoch(hid_t gnomon, std::size_t epoch) {
  return hdf5::open_group(gnomon, epoch_path(epoch), "open an epoch");
}

long read_count(const Handle& group, const char* name) {
  return count_of(static_cast<std::int64_t>(hdf5::read_number_attribute(group.id(), name)),
                  "read the epochs");
}

/// FNV-1a over all numbers except the first, with as many bits as a double represents exactly.
double checksum(const std::vector<double>& row) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t i = 1; i < row.size(); ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(row[i]);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> 8 * byte & 0xff)) * 0x100000001b3;
  }
  return static_cast<double>(hash >> 11);
}

bool is_count(double value) {
  return value >= 0 && value < 9e15 && value == std::floor(value);
}

/// The complete checkpoints, ascending by number; none if there is no table.
std::vector<Checkpoint> read_checkpoints(hid_t group) {
  if (!hdf5::exists(group, kCheckpoints)) return {};
  const auto [extents, values] = hdf5::read_numbers<double>(group, kCheckpoints);
  if (extents.size() != 2 || extents[0] != kPlaces || extents[1] < kHead)
    throw Failure("cannot read the checkpoints: their extents are wrong");
  std::vector<Checkpoint> checkpoints;
  for (std::size_t place = 0; place < kPlaces; ++place) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(place * extents[1]);
    const std::vector<double> row(begin, begin + static_cast<std::ptrdiff_t>(extents[1]));
    if (row[0] != checksum(row) || row[2] == 0) continue;  // incomplete, or not written yet
    if (!(is_count(row[1]) && is_count(row[2]) && is_count(row[3])))
      throw Failure("cannot read the checkpoints: their positions in the result are not numbers");
    checkpoints.push_back(
        {long(row[1]), long(row[2]), long(row[3]), {row.begin() + kHead, row.end()}});
  }
  std::sort(checkpoints.begin(), checkpoints.end(),
            [](const Checkpoint& a, const Checkpoint& b) { return a.number < b.number; });
  return checkpoints;
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
  hdf5::write_dataset(group.id(), "state", H5T_NATIVE_DOUBLE, {start.numbers.size()},
                      start.numbers.data());
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
                      hdf5::read_numbers<double>(group.id(), "state").values});
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

Handle create_checkpoints(hid_t group, std::size_t count) {
  const std::vector<double> empty(kPlaces * (kHead + count));
  return hdf5::write_dataset(group, kCheckpoints, H5T_NATIVE_DOUBLE, {kPlaces, kHead + count},
                             empty.data());
}

void write_checkpoint(const Handle& dataset, const Checkpoint& checkpoint) {
  std::vector<double> row = {0, double(checkpoint.number), double(checkpoint.rows),
                             double(checkpoint.stored)};
  row.insert(row.end(), checkpoint.numbers.begin(), checkpoint.numbers.end());
  row[0] = checksum(row);
  if (hdf5::extents_of(dataset.id()).back() != row.size())
    throw Failure("cannot write a checkpoint: its length differs from that of the first");
  hdf5::write_part(dataset.id(), H5T_NATIVE_DOUBLE, {hsize_t(checkpoint.number) % kPlaces, 0},
                   {1, row.size()}, row.data());
}

}  // namespace gnomon::layout
