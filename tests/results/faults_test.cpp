// Files that are missing, foreign, cut or damaged, and targets that cannot be written: one line of
// InputError, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "results/synthetic.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace gnomon {
namespace {

// HDF5 itself leaks memory when it refuses a damaged structure: not looked for where this lives.
struct LeaksOfHdf5 {
#ifdef __SANITIZE_ADDRESS__
  __lsan::ScopedDisabler disabler;
#endif
};

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using testing::ThrowsMessage;

auto one_line(const std::filesystem::path& file, const std::string& reason) {
  return AllOf(HasSubstr(file.string()), HasSubstr(reason), Not(HasSubstr("\n")));
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void put(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::filesystem::path write(const std::filesystem::path& file) {
  const Grid grid = synthetic::grid(4, 3);
  ResultWriter writer(file, synthetic::header(), grid);
  for (int i = 0; i < 5; ++i) writer.append(synthetic::row(i));
  writer.store(0, synthetic::fields(grid, 0), synthetic::contact(0));
  writer.close("finished", 1);
  return file;
}

void read_everything(const std::filesystem::path& file) {
  const ResultReader reader(file);
  reader.status();
  reader.history();
  reader.grid();
  for (const std::string& name : reader.field_names()) reader.field(0, name);
  reader.contact({});
}

TEST(Reading, NamesWhatIsWrongWithAFile) {
  const auto folder = synthetic::folder("reading");
  EXPECT_THAT([&] { ResultReader(folder / "none.h5"); },
              ThrowsMessage<InputError>(one_line(folder / "none.h5", "there is no such file")));
  EXPECT_THAT([&] { ResultReader{folder}; },
              ThrowsMessage<InputError>(one_line(folder, "it is not a file")));
  put(folder / "empty.h5", "");
  put(folder / "text.h5", "problem = \"pin_on_flat\"\n");
  for (const char* name : {"empty.h5", "text.h5"}) {
    EXPECT_THAT([&] { ResultReader(folder / name); },
                ThrowsMessage<InputError>(one_line(folder / name, "it is not an HDF5 file")));
  }
  H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_THAT(
      [&] { ResultReader(folder / "other.h5"); },
      ThrowsMessage<InputError>(one_line(folder / "other.h5", "it is not a gnomon result")));
}

TEST(Reading, RefusesATruncatedFile) {
  [[maybe_unused]] const LeaksOfHdf5 ignored;
  const auto folder = synthetic::folder("truncated");
  const std::string whole = bytes_of(write(folder / "whole.h5"));
  for (std::size_t size = 1; size < whole.size(); size += 997) {
    put(folder / "cut.h5", whole.substr(0, size));
    EXPECT_THAT([&] { read_everything(folder / "cut.h5"); },
                ThrowsMessage<InputError>(one_line(folder / "cut.h5", "cannot read")))
        << size;
  }
}

TEST(Reading, SurvivesDamagedFiles) {
  [[maybe_unused]] const LeaksOfHdf5 ignored;
  const auto folder = synthetic::folder("damaged");
  const std::string whole = bytes_of(write(folder / "whole.h5"));
  std::vector<std::size_t> used;  // not the empty rows of the tables
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] != 0) used.push_back(i);
  }
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 600; ++i) {
    std::string damaged = whole;
    for (int k = 0; k <= i % 4; ++k) {
      damaged[used[random() % used.size()]] = static_cast<char>(random());
    }
    put(folder / "damaged.h5", damaged);
    try {
      read_everything(folder / "damaged.h5");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), one_line(folder / "damaged.h5", "cannot read"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Writing, RefusesATargetThatCannotBe) {
  const auto folder = synthetic::folder("target");
  const auto create = [](const std::filesystem::path& file) {
    ResultWriter(file, synthetic::header(), synthetic::grid(4, 3));
  };
  EXPECT_THAT(
      [&] { create(folder / "none" / "r.h5"); },
      ThrowsMessage<InputError>(one_line(folder / "none" / "r.h5", "No such file or directory")));
  EXPECT_THAT([&] { create(folder); },
              ThrowsMessage<InputError>(one_line(folder, "it is not a regular file")));
  EXPECT_THAT([&] { create("/dev/null"); },
              ThrowsMessage<InputError>(one_line("/dev/null", "it is not a regular file")));
  EXPECT_THAT([&] { create(folder / "r.xdmf"); },
              ThrowsMessage<InputError>(one_line(folder / "r.xdmf", "the suffix .xdmf")));
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Writing, KeepsAnEarlierFileThatItMayNotReplace) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anything";
  const auto folder = synthetic::folder("readonly");
  put(folder / "r.h5", "earlier");
  std::filesystem::permissions(folder / "r.h5", std::filesystem::perms::owner_read);
  EXPECT_THAT([&] { ResultWriter(folder / "r.h5", synthetic::header(), std::nullopt); },
              ThrowsMessage<InputError>(one_line(folder / "r.h5", "Permission denied")));
  EXPECT_EQ(bytes_of(folder / "r.h5"), "earlier");
}

TEST(Writing, KeepsAnEarlierFileWhenTheSidecarCannotBe) {
  const auto folder = synthetic::folder("sidecar");
  put(folder / "r.h5", "earlier");
  std::filesystem::create_directories(folder / "r.xdmf" / "in the way");
  EXPECT_THAT([&] { write(folder / "r.h5"); },
              ThrowsMessage<InputError>(one_line(folder / "r.h5", "r.xdmf: Is a directory")));
  EXPECT_EQ(bytes_of(folder / "r.h5"), "earlier");
  EXPECT_FALSE(std::filesystem::exists(folder / "r.h5.part"));
}

TEST(Writing, ReplacesAnEarlierResultAndFollowsALink) {
  const auto folder = synthetic::folder("replace");
  write(folder / "target.h5");
  std::filesystem::create_symlink("target.h5", folder / "link.h5");
  ResultWriter(folder / "link.h5", synthetic::header(), std::nullopt).close("interrupted", 2);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.h5"));
  EXPECT_EQ(ResultReader(folder / "target.h5").status(), "interrupted");
  EXPECT_FALSE(std::filesystem::exists(folder / "target.h5.part"));
}

TEST(Writing, CutsALongStatus) {
  const auto file = synthetic::folder("status") / "r.h5";
  ResultWriter(file, synthetic::header(), std::nullopt).close(std::string(5000, 'x'), 2);
  EXPECT_EQ(ResultReader(file).status(), std::string(1024, 'x'));
}

}  // namespace
}  // namespace gnomon
