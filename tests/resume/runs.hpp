// Runs of shipped scenes that write result files, some of them interrupted, and the comparison of
// two results.
#pragma once

#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace gnomon::test {

/// Before HDF5 is first used, as gnomon itself does (hdf5_handles.cpp).
inline const herr_t no_clean_up_at_exit = H5dont_atexit();

using Overrides = std::vector<std::string>;

/// An empty folder for this test; inside it another for each name.
class FolderTest : public testing::Test {
protected:
  FolderTest() { std::filesystem::create_directories(root_); }
  ~FolderTest() override { std::filesystem::remove_all(root_); }

  /// The file r.h5 in a folder of this name: the sidecar names the file, so equal results must.
  std::filesystem::path file(const std::string& name) const {
    std::filesystem::create_directories(root_ / name);
    return root_ / name / "r.h5";
  }

private:
  std::filesystem::path root_ =
      std::filesystem::temp_directory_path() /
      ("gnomon-resume-" +
       std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "-" +
       std::to_string(getpid()));
};

/// How a run ends that is not to reach its end.
enum class Cut {
  interrupted,  ///< as by Ctrl-C
  killed        ///< as by a kill, between a step and its checkpoint
};

/// Runs a scene, in problems/ if its path is relative, for a limited number of steps.
inline RunOutcome run_scene(const std::filesystem::path& scene, const Overrides& overrides,
                            const std::filesystem::path& file,
                            long most_steps = std::numeric_limits<long>::max(),
                            Cut cut = Cut::interrupted) {
  const Setup setup =
      set_up(std::filesystem::path(GNOMON_SOURCE_DIR "/problems") / scene, overrides);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  ResultWriter writer(file, run_header(setup), setup.model->grid, Earlier::replaced);
  struct Killed : std::exception {};
  long steps = 0;
  RunHooks hooks{.on_step = [&](const HistoryRow& row) {
    steps = row.counters.steps;
    if (steps >= most_steps && cut == Cut::killed) throw Killed();
  }};
  hooks.interrupted = [&] { return steps >= most_steps; };
  try {
    return run(*setup.model, chosen_integrator(setup.scene), settings, store_policy(setup.scene),
               &writer, hooks);
  } catch (const Killed&) {
    return {};
  }
}

inline int resume(const std::filesystem::path& file, const Overrides& overrides = {},
                  std::optional<double> end = {}) {
  app::RunOptions options;
  options.result = file;
  options.overrides = overrides;
  options.end = end;
  options.quiet = true;
  return app::resume_command(options);
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Changes an attribute of a result without gnomon.
inline void write_attribute(const std::filesystem::path& file, const char* name, hid_t type,
                            const void* value) {
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t group = H5Gopen2(id, "gnomon", H5P_DEFAULT);
  const hid_t attribute = H5Aopen(group, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, type, value), 0) << file;
  H5Aclose(attribute);
  H5Gclose(group);
  H5Fclose(id);
}

/// The bytes of a result without its only time stamp.
inline std::string timeless_bytes(const std::filesystem::path& file) {
  const std::filesystem::path copy = file.parent_path() / "timeless.h5";
  std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
  const double zero = 0;
  write_attribute(copy, "wall_seconds", H5T_NATIVE_DOUBLE, &zero);
  const std::string bytes = bytes_of(copy);
  std::filesystem::remove(copy);
  return bytes;
}

/// Result and sidecar are the same, byte by byte.
inline void expect_same(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::string one = timeless_bytes(a), other = timeless_bytes(b);
  EXPECT_EQ(one.size(), other.size());
  EXPECT_TRUE(one == other) << a << " and " << b << " differ";
  EXPECT_EQ(bytes_of(sidecar_of(a)), bytes_of(sidecar_of(b)));
}

/// The steps of a run whose equations are solved to rounding are those of the other to rounding.
inline void expect_same_steps(const std::filesystem::path& a, const std::filesystem::path& b,
                              double tolerance = 1e-6) {
  const std::vector<HistoryRow> rows = ResultReader(a).history(),
                                expected = ResultReader(b).history();
  ASSERT_EQ(rows.size(), expected.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].t, expected[i].t, tolerance * expected.back().t) << "row " << i;
    for (std::size_t k = 0; k < rows[i].scalars.size(); ++k) {
      const Scalar& scalar = expected[i].scalars[k];
      EXPECT_NEAR(rows[i].scalars[k].value, scalar.value,
                  tolerance * std::abs(scalar.value) + 1e-10)
          << scalar.name << " in row " << i;
    }
  }
  EXPECT_EQ(ResultReader(a).status(), ResultReader(b).status());
}

}  // namespace gnomon::test
