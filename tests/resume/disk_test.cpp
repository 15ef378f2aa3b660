// A disk that becomes full or is read-only: a clear error, and no loss of existing data. The test
// uses a small tmpfs, which only root may mount.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>

#include "app/child.hpp"
#include "resume/runs.hpp"

namespace gnomon::disk_test {
namespace {

using ::testing::HasSubstr;

class Disk : public test::ProgramTest {
protected:
  void SetUp() override {
    std::filesystem::create_directories(disk());
    if (::mount("tmpfs", disk().c_str(), "tmpfs", 0, "size=200k") != 0)
      GTEST_SKIP() << "a tmpfs cannot be mounted: " << std::strerror(errno);
    mounted_ = true;
  }
  void TearDown() override {
    if (mounted_) ::umount(disk().c_str());
  }

  std::filesystem::path disk() const { return folder() / "disk"; }
  void remount(unsigned long flags, const char* size) const {
    ASSERT_EQ(::mount("tmpfs", disk().c_str(), "tmpfs", MS_REMOUNT | flags, size), 0);
  }
  test::Outcome run_into(const std::string& name) const {
    return gnomon({"run", test::pin, "--integrator", "backward-euler", "--set", "integrator.step=5",
                   "--set", "mesh.elements=[8,6]", "--set", "time.end=200", "--set",
                   "output.every=1", "--set", "output.checkpoint_seconds=1e-9", "-o",
                   name + "/r.h5", "--quiet"});
  }
  test::Outcome resume() const { return gnomon({"resume", "disk/r.h5", "--quiet"}); }

private:
  bool mounted_ = false;
};

TEST_F(Disk, FullEndsTheRunAndResumingGoesOnWhenThereIsSpace) {
  std::filesystem::create_directories(folder() / "whole");
  ASSERT_EQ(run_into("whole").exit_code, 0);
  const test::Outcome full = run_into("disk");
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  const auto file = disk() / "r.h5";
  EXPECT_GT(ResultReader(file).history().size(), 2u);
  EXPECT_FALSE(ResultReader(file).checkpoints().empty());

  const std::string before = test::bytes_of(file);
  const test::Outcome again = resume();  // there is no space for a second file beside it
  EXPECT_NE(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("No space left on device"));
  EXPECT_TRUE(test::bytes_of(file) == before);

  remount(0, "size=20m");
  const test::Outcome done = resume();
  ASSERT_EQ(done.exit_code, 0) << done.err;
  test::expect_same_steps(file, folder() / "whole/r.h5");
}

TEST_F(Disk, ReadOnlyIsRefusedAndTheEarlierFileStays) {
  ASSERT_EQ(run_into("disk").exit_code, 1);
  const auto file = disk() / "r.h5";
  const std::string before = test::bytes_of(file);
  remount(MS_RDONLY, "size=20m");
  for (const test::Outcome& refused : {resume(), run_into("disk")}) {
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("disk/r.h5"));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
  EXPECT_THAT(resume().err, HasSubstr("Read-only file system"));
  EXPECT_TRUE(test::bytes_of(file) == before);
}

}  // namespace
}  // namespace gnomon::disk_test
