// The result remains readable if its writer is killed at any point, or if the disk is full. A plain
// HDF5 reader opens it and finds every step whose call had returned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <functional>
#include <random>

#include "results/synthetic.hpp"

namespace {

// Every write to a result goes through pwrite; with this one, which is linked before that of the C
// library, a test can act after each write, or refuse it.
std::function<bool()> on_write;  // returns false to refuse: no space left

}  // namespace

extern "C" ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  if (on_write && !on_write()) {
    errno = ENOSPC;
    return -1;
  }
  return syscall(SYS_pwrite64, descriptor, bytes, size, offset);
}

namespace gnomon::crash_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int kStoreEvery = 3;

// Progress of a writer: number of calls that have returned.
struct Progress {
  int appended = 0;
  int stored = 0;
  int checkpoints = 0;
};

// Several pages long, all numbers different.
Checkpoint checkpoint(int step) {
  Checkpoint result{step, step + 1, step / kStoreEvery + 1, std::vector<double>(1500)};
  for (std::size_t i = 0; i < result.numbers.size(); ++i)
    result.numbers[i] = step + 1e-3 * static_cast<double>(i);
  return result;
}

void write_step(ResultWriter& writer, const Grid& grid, int step, Progress& progress) {
  writer.append(synthetic::row(step));
  progress.appended = step + 1;
  if (step % kStoreEvery == 0) {
    writer.store(step, synthetic::fields(grid, step), synthetic::contact(step),
                 synthetic::counter_body(step / 2));
    progress.stored = step / kStoreEvery + 1;
  }
  writer.checkpoint(checkpoint(step));
  progress.checkpoints = step + 1;
}

void expect_holds_a_checkpoint(const ResultReader& reader, int done) {
  const auto checkpoints = reader.checkpoints();
  if (done == 0) return;
  ASSERT_FALSE(checkpoints.empty());
  const Checkpoint& last = checkpoints.back();
  ASSERT_GE(last.number, done - 1);
  ASSERT_LE(last.number, done);
  const Checkpoint expected = checkpoint(static_cast<int>(last.number));
  ASSERT_EQ(last.rows, expected.rows);
  ASSERT_EQ(last.stored, expected.stored);
  ASSERT_EQ(last.numbers, expected.numbers);
}

// Opens the file as any HDF5 program would and reads every dataset in it.
herr_t read_all(hid_t file, const char* name, const H5L_info_t* /*link*/, void* /*unused*/) {
  const hid_t dataset = H5Oopen(file, name, H5P_DEFAULT);
  if (dataset < 0) return -1;
  if (H5Iget_type(dataset) != H5I_DATASET) return H5Oclose(dataset);
  const hid_t type = H5Dget_type(dataset);
  const hid_t space = H5Dget_space(dataset);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0 || type < 0) return -1;
  std::vector<char> bytes(static_cast<std::size_t>(count) * H5Tget_size(type) + 1);
  const herr_t result = H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
  H5Sclose(space);
  H5Tclose(type);
  H5Oclose(dataset);
  return result;
}

void expect_whole_for_plain_hdf5(const std::filesystem::path& file) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(id, 0) << file;
  EXPECT_GE(H5Lvisit(id, H5_INDEX_NAME, H5_ITER_INC, read_all, nullptr), 0) << file;
  H5Fclose(id);
}

// Everything up to `done` is present and right; in addition at most the data of the current call.
void expect_holds(const std::filesystem::path& file, const Progress& done, const Grid& grid) {
  expect_whole_for_plain_hdf5(file);
  const ResultReader reader(file);
  const auto history = reader.history();
  const auto times = reader.stored_times();
  const auto rows = static_cast<int>(history.size());
  const auto stored = static_cast<int>(times.size());
  ASSERT_GE(rows, done.appended);
  ASSERT_LE(rows, done.appended + 1);
  ASSERT_GE(stored, done.stored);
  ASSERT_LE(stored, done.stored + 1);
  for (int i = 0; i < rows; ++i) {
    const HistoryRow& row = history[static_cast<std::size_t>(i)];
    ASSERT_EQ(row.t, synthetic::row(i).t);
    ASSERT_EQ(row.counters.linear_solves, synthetic::row(i).counters.linear_solves);
    ASSERT_EQ(row.scalars.at(0).value, synthetic::row(i).scalars[0].value);
  }
  ASSERT_NO_FATAL_FAILURE(expect_holds_a_checkpoint(reader, done.checkpoints));
  for (int i = 0; i < stored; ++i) ASSERT_EQ(times[static_cast<std::size_t>(i)], i * kStoreEvery);
  if (stored == 0) return;
  for (const GridField& expected : synthetic::fields(grid, times.back())) {
    ASSERT_EQ(reader.field(times.size() - 1, expected.name).values, expected.values);
  }
  ASSERT_EQ(reader.contact({}).pressure, synthetic::contact(times.back()).pressure);
}

// A copy of the file after each write of the given steps, as a kill between two writes would leave
// it.
void check_after_every_write(const std::string& name, int first, int last,
                             const Grid& grid = synthetic::grid(4, 3)) {
  const auto folder = synthetic::folder(name);
  ResultWriter writer(folder / "r.h5", synthetic::header(), grid);
  Progress progress;
  for (int step = 0; step < first; ++step) write_step(writer, grid, step, progress);
  std::vector<Progress> snapshots;
  const auto copy = [&](std::size_t i) { return folder / ("after_" + std::to_string(i) + ".h5"); };
  on_write = [&] {
    std::filesystem::copy_file(folder / "r.h5", copy(snapshots.size()));
    snapshots.push_back(progress);
    return true;
  };
  for (int step = first; step < last; ++step) write_step(writer, grid, step, progress);
  on_write = nullptr;
  EXPECT_GT(snapshots.size(), static_cast<std::size_t>(3 * (last - first)));
  for (std::size_t i = 0; i < snapshots.size(); ++i) {
    SCOPED_TRACE("before write " + std::to_string(i));
    ASSERT_NO_FATAL_FAILURE(expect_holds(copy(i), snapshots[i], grid));
  }
}

TEST(Crash, FirstStepsAreWholeAfterEveryWrite) {
  check_after_every_write("first", 0, 7);
}

TEST(Crash, CompressedStepsAreWholeAfterEveryWrite) {
  check_after_every_write("compressed", 0, 7, synthetic::grid(40, 30));
}

TEST(Crash, NewGroupOfStepsIsWholeAfterEveryWrite) {
  const int hundredth = 100 * kStoreEvery;
  check_after_every_write("hundred", hundredth - 2, hundredth + 2);
}

TEST(Crash, NewChunkOfHistoryIsWholeAfterEveryWrite) {
  check_after_every_write("chunk", 254, 258);
}

TEST(Crash, SplitOfTheChunkIndexIsWholeAfterEveryWrite) {
  const auto folder = synthetic::folder("split");
  ResultWriter writer(folder / "r.h5", synthetic::header(), std::nullopt);
  // HDF5's index of chunks is a tree whose nodes take 64: its root splits at the 65th chunk, and
  // the leaf on its right some 60 chunks later.
  const auto watched = [](int chunk) { return chunk == 64 || (chunk > 114 && chunk < 126); };
  constexpr int kChunk = 256;
  int copies = 0;
  for (int step = 0; step < 126 * kChunk; ++step) {
    if (step % kChunk == 0 && watched(step / kChunk)) {
      on_write = [&] {
        const auto copy = folder / std::to_string(copies++);
        std::filesystem::copy_file(folder / "r.h5", copy);
        return true;
      };
    }
    writer.append(synthetic::row(step));
    on_write = nullptr;
    for (; copies > 0; --copies) {
      const auto copy = folder / std::to_string(copies - 1);
      const auto history = ResultReader(copy).history();
      ASSERT_GE(static_cast<int>(history.size()), step);
      for (std::size_t k = 0; k < history.size(); ++k) {
        ASSERT_EQ(history[k].t, static_cast<double>(k) / 4) << "before write " << copies - 1;
      }
      std::filesystem::remove(copy);
    }
  }
}

// A writer in a process of its own, killed after `delay` microseconds of steps without pause.
Progress kill_a_writer(const std::filesystem::path& file, const Grid& grid, int delay) {
  void* memory =
      mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* progress = new (memory) Progress;
  int ready[2];
  if (pipe(ready) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    ResultWriter writer(file, synthetic::header(), grid);
    if (write(ready[1], "", 1) != 1) _exit(1);
    for (int step = 0;; ++step) write_step(writer, grid, step, *progress);
  }
  char byte = 0;
  EXPECT_EQ(read(ready[0], &byte, 1), 1);
  usleep(static_cast<useconds_t>(delay));
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  close(ready[0]);
  close(ready[1]);
  const Progress reached = *progress;
  munmap(memory, sizeof(Progress));
  return reached;
}

TEST(Crash, KilledAtRandomInstantsLosesNothing) {
  const auto file = synthetic::folder("kill") / "r.h5";
  const Grid grid = synthetic::grid(4, 3);
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  for (int i = 0; i < 100; ++i) {
    const int delay = std::uniform_int_distribution<int>(0, 60000)(random);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", kill " + std::to_string(i));
    std::filesystem::remove(file);  // of the one before
    std::filesystem::remove(sidecar_of(file));
    const Progress reached = kill_a_writer(file, grid, delay);
    ASSERT_NO_FATAL_FAILURE(expect_holds(file, reached, grid));
    EXPECT_EQ(ResultReader(file).status(), "running or crashed");
  }
}

/// Refuses each write of a run in turn: either this write and all later ones, or only this one, as
/// if existing pages of the file could still be written.
void expect_refused_writes_to_lose_nothing(bool alone) {
  const Grid grid = synthetic::grid(4, 3);
  int refused = 0;
  for (bool ended = false; !ended; ++refused) {
    const auto file = synthetic::folder("full") / "r.h5";
    ResultWriter writer(file, synthetic::header(), grid);
    Progress progress;
    int writes = 0;
    on_write = [&] { return alone ? writes++ != refused : writes++ < refused; };
    try {
      for (int step = 0; step < 4; ++step) write_step(writer, grid, step, progress);
      ended = true;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("No space left on device"));
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
      EXPECT_THAT(error.what(), HasSubstr(progress.appended > 0 ? "up to the previous step"
                                                                : "the result holds no step"));
      EXPECT_THAT([&] { writer.close("failed", 1); },
                  ThrowsMessage<Error>(HasSubstr("an earlier write failed")));
    }
    on_write = nullptr;
    SCOPED_TRACE("refused write " + std::to_string(refused));
    ASSERT_NO_FATAL_FAILURE(expect_holds(file, progress, grid));
  }
  EXPECT_GT(refused, 20);
}

TEST(Crash, FullDiskIsAnErrorThatLosesNothing) {
  expect_refused_writes_to_lose_nothing(false);
}

TEST(Crash, OneWriteThatFailsIsAnErrorThatLosesNothing) {
  expect_refused_writes_to_lose_nothing(true);
}

}  // namespace
}  // namespace gnomon::crash_test
