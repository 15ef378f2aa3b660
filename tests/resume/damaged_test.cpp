// How the commands treat results that are truncated, damaged or foreign: one line, never a crash.
// Intact parts are read or resumed as usual.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <random>

#include "app/child.hpp"
#include "resume/runs.hpp"

namespace gnomon::damaged_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Damaged : public test::FolderTest {
protected:
  /// A run that was interrupted two steps before its end.
  void SetUp() override {
    test::run_scene("pin_on_flat/small_deformation.toml",
                    {"mesh.elements=[4,3]", "time.end=30", "integrator.name=backward-euler",
                     "integrator.step=5", "output.checkpoint_seconds=1e-9"},
                    file("whole"), 4);
    whole_ = test::bytes_of(file("whole"));
  }

  void put(const std::string& bytes) const {
    std::ofstream(file("r"), std::ios::binary) << bytes;
    std::filesystem::remove(sidecar_of(file("r")));
  }

  /// Returns whether the command refused the file, in one line that names it.
  bool refused(const std::function<void()>& command) const {
    testing::internal::CaptureStdout();
    bool thrown = false;
    try {
      command();
    } catch (const InputError& error) {
      thrown = true;
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    } catch (const SolutionError&) {  // the damage is in numbers: a different but valid problem
    }
    testing::internal::GetCapturedStdout();
    return thrown;
  }

  /// info, compare and resume; returns how many refused.
  int refusals() const {
    return refused([&] { app::info_command(file("r")); }) + refused([&] {
             app::compare_command({file("r"), file("whole")}, {});
           }) +
           refused([&] { test::resume(file("r")); });
  }

  std::string whole_;
};

TEST_F(Damaged, CutShortAnywhereIsRefused) {
  for (std::size_t size = 0; size < whole_.size(); size += whole_.size() / 60) {
    put(whole_.substr(0, size));
    EXPECT_EQ(refusals(), 3) << "cut to " << size << " of " << whole_.size() << " bytes";
    EXPECT_EQ(test::bytes_of(file("r")).size(), size) << "a refused file is left as it is";
  }
}

TEST_F(Damaged, FlippedBytesNeverCrash) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < whole_.size(); ++i)
    if (whole_[i] != 0) used.push_back(i);
  std::mt19937 random(7);
  int refusing = 0;
  for (int i = 0; i < 150; ++i) {
    std::string damaged = whole_;
    for (int k = 0; k <= i % 3; ++k) damaged[used[random() % used.size()]] = char(random());
    put(damaged);
    SCOPED_TRACE("damage " + std::to_string(i));
    refusing += refusals() > 0;
  }
  EXPECT_GT(refusing, 20);
}

using DamagedFor = test::ProgramTest;

TEST_F(DamagedFor, EveryCommandIsOneLineAndExitCode2) {
  std::ofstream(folder() / "text.h5") << "no HDF5";
  H5Fclose(H5Fcreate((folder() / "foreign.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  for (const char* command : {"info", "contact", "compare", "plot", "resume"})
    for (const char* file : {"none.h5", "text.h5", "foreign.h5"}) {
      const test::Outcome outcome = gnomon({command, file});
      EXPECT_EQ(outcome.exit_code, 2) << command << " " << file;
      EXPECT_THAT(outcome.err, HasSubstr(file)) << command;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
}

}  // namespace
}  // namespace gnomon::damaged_test
