// Files that are missing, foreign, cut or damaged, and targets that cannot be written: one line of
// InputError, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "results/synthetic.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace gnomon::faults_test {
namespace {

// HDF5 itself leaks memory when it refuses a damaged structure: while this object exists, leaks are
// not reported.
struct LeaksOfHdf5 {
#ifdef __SANITIZE_ADDRESS__
  __lsan::ScopedDisabler disabler;
#endif
};

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::Throws;
using ::testing::ThrowsMessage;

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

/// Changes the value of an attribute of an object without gnomon.
void put_attribute(const std::filesystem::path& file, const char* object, const char* name,
                   hid_t type, const void* value) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);  // allows large attributes
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, access);
  const hid_t owner = H5Oopen(opened, object, H5P_DEFAULT), space = H5Screate(H5S_SCALAR);
  H5Adelete(owner, name);
  const hid_t attribute = H5Acreate2(owner, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, type, value), 0);
  H5Aclose(attribute);
  H5Sclose(space);
  H5Oclose(owner);
  H5Fclose(opened);
  H5Pclose(access);
}

TEST(Reading, RefusesAContactSurfaceOfOtherDimensions) {
  const auto file = write(synthetic::folder("dimensions") / "r.h5");
  const double dim = 7;
  put_attribute(file, "gnomon/contact/0000/000000", "dim", H5T_NATIVE_DOUBLE, &dim);
  EXPECT_THAT([&] { ResultReader(file).contact({}); },
              ThrowsMessage<InputError>(one_line(file, "it has 7 dimensions")));
}

TEST(Reading, RefusesAnAttributeOfUnreasonableSize) {
  const auto file = write(synthetic::folder("attribute") / "r.h5");
  const hid_t type = H5Tcopy(H5T_C_S1);
  const std::string text(100'000, 'x');
  H5Tset_size(type, text.size());
  put_attribute(file, "gnomon", "status", type, text.c_str());
  H5Tclose(type);
  EXPECT_THAT([&] { ResultReader(file).status(); },
              ThrowsMessage<InputError>(one_line(file, "it is too large")));
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
  const auto create = [&] {
    ResultWriter(folder / "r.h5", synthetic::header(), std::nullopt, Earlier::replaced);
  };
  EXPECT_THAT(create, ThrowsMessage<InputError>(one_line(folder / "r.h5", "Permission denied")));
  EXPECT_EQ(bytes_of(folder / "r.h5"), "earlier");
}

TEST(Writing, KeepsAnEarlierFileWhenTheSidecarCannotBe) {
  const auto folder = synthetic::folder("sidecar");
  put(folder / "r.h5", "earlier");
  std::filesystem::create_directories(folder / "r.xdmf" / "in the way");
  ResultWriter writer(folder / "r.h5", synthetic::header(), synthetic::grid(4, 3),
                      Earlier::replaced);
  EXPECT_THAT([&] { writer.append(synthetic::row(0)); },
              ThrowsMessage<Error>(one_line(folder / "r.h5", "r.xdmf: Is a directory")));
  EXPECT_EQ(bytes_of(folder / "r.h5"), "earlier");
}

TEST(Writing, ReplacesAnEarlierResultAndFollowsALink) {
  const auto folder = synthetic::folder("replace");
  write(folder / "target.h5");
  std::filesystem::create_symlink("target.h5", folder / "link.h5");
  {
    ResultWriter writer(folder / "link.h5", synthetic::header(), std::nullopt, Earlier::replaced);
    EXPECT_EQ(ResultReader(folder / "target.h5").status(), "finished");
    writer.append(synthetic::row(0));
    writer.close("interrupted", 2);
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.h5"));
  EXPECT_EQ(ResultReader(folder / "target.h5").status(), "interrupted");
  EXPECT_FALSE(std::filesystem::exists(folder / "target.h5.part"));
}

TEST(Writing, RefusesAnEarlierFile) {
  const auto folder = synthetic::folder("refuse");
  const auto create = [&](const std::string& name) {
    ResultWriter(folder / name, synthetic::header(), synthetic::grid(4, 3));
  };
  put(folder / "a.h5", "earlier");
  put(folder / "b.xdmf", "earlier");
  EXPECT_THAT([&] { create("a.h5"); },
              ThrowsMessage<InputError>(one_line(folder / "a.h5", "it exists")));
  EXPECT_THAT([&] { create("b.h5"); },
              ThrowsMessage<InputError>(one_line(folder / "b.h5", "b.xdmf exists")));
  EXPECT_EQ(bytes_of(folder / "a.h5"), "earlier");
  EXPECT_EQ(bytes_of(folder / "b.xdmf"), "earlier");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.h5.part"));
}

TEST(Writing, KeepsAnEarlierFileWhenNothingIsAppended) {
  const auto folder = synthetic::folder("nothing");
  const std::string earlier = bytes_of(write(folder / "r.h5"));
  const std::string sidecar = bytes_of(folder / "r.xdmf");
  ResultWriter(folder / "r.h5", synthetic::header(), synthetic::grid(2, 2), Earlier::replaced)
      .close("failed: no equilibrium", 1);
  EXPECT_TRUE(bytes_of(folder / "r.h5") == earlier);
  EXPECT_EQ(bytes_of(folder / "r.xdmf"), sidecar);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.h5.part"));
}

// As if memory were exhausted before a resumed, finished result has gone beyond its end.
TEST(Writing, ReplacesAnEarlierFileByOneThatEndsThereUnlessAbandoned) {
  const auto folder = synthetic::folder("as-far");
  const std::string earlier = bytes_of(write(folder / "r.h5"));
  const auto write_as_far = [&](bool abandoned) {
    ResultWriter writer(folder / "r.h5", synthetic::header(), synthetic::grid(2, 2),
                        Earlier::replaced, synthetic::row(1).t);
    writer.append(synthetic::row(0));
    writer.append(synthetic::row(1));
    abandoned ? writer.abandon("failed: out of memory", 1) : writer.close("interrupted", 1);
  };
  write_as_far(true);
  EXPECT_TRUE(bytes_of(folder / "r.h5") == earlier);
  EXPECT_FALSE(std::filesystem::exists(folder / "r.h5.part"));
  write_as_far(false);
  EXPECT_EQ(ResultReader(folder / "r.h5").status(), "interrupted");
}

TEST(Writing, LeavesToAnotherWriterWhatItWrites) {
  const auto folder = synthetic::folder("two");
  const auto refused =
      ThrowsMessage<InputError>(one_line(folder / "r.h5", "another run is writing it"));
  const auto create = [&] {
    return std::make_unique<ResultWriter>(folder / "r.h5", synthetic::header(), std::nullopt,
                                          Earlier::replaced);
  };
  auto first = create();
  EXPECT_THAT([&] { create(); }, refused);
  first->append(synthetic::row(0));
  first.reset();
  auto second = create();  // waits in r.h5.part for its first row
  EXPECT_THAT([&] { create(); }, refused);
  second->append(synthetic::row(0));
  EXPECT_EQ(ResultReader(folder / "r.h5").history().size(), 1u);
}

TEST(Writing, TakesOverWhatADeadWriterLeft) {
  const std::string signature = "\x89HDF\r\n\x1a\n";
  for (const std::string& left :
       {std::string(), signature.substr(0, 3), signature + std::string(100000, 'x'),
        std::string(100000, '\0')}) {
    const auto folder = synthetic::folder("dead");
    put(folder / "r.h5.part", left);
    put(folder / "r.xdmf.part", "<?xml");
    write(folder / "r.h5");
    EXPECT_EQ(ResultReader(folder / "r.h5").status(), "finished");
    EXPECT_FALSE(std::filesystem::exists(folder / "r.h5.part"));
    EXPECT_FALSE(std::filesystem::exists(folder / "r.xdmf.part"));
  }
}

// A file that cannot come from a run belongs to someone: a download, another name of a file, the
// target of a link.
TEST(Writing, LeavesForeignPartsAlone) {
  for (const char* name : {"r.h5.part", "r.xdmf.part"}) {
    const auto folder = synthetic::folder("foreign");
    const auto refused = [&] {
      // It is refused before anything is solved.
      EXPECT_THAT([&] { write(folder / "r.h5"); }, Throws<InputError>());
      EXPECT_EQ(bytes_of(folder / "precious"), "precious");
    };
    put(folder / "precious", "precious");
    std::filesystem::copy_file(folder / "precious", folder / name);
    refused();
    EXPECT_EQ(bytes_of(folder / name), "precious");
    std::filesystem::remove(folder / name);
    std::filesystem::create_symlink("precious", folder / name);
    refused();
    std::filesystem::remove(folder / name);
    put(folder / "empty", "");
    std::filesystem::create_hard_link(folder / "empty", folder / name);
    refused();
    EXPECT_EQ(bytes_of(folder / "empty"), "");
  }
}

TEST(Reading, DoesNotWaitForAPipe) {
  const auto file = synthetic::folder("pipe") / "r.h5";
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT([&] { ResultReader reader(file); },
              ThrowsMessage<InputError>(one_line(file, "it is not a file")));
}

TEST(Writing, KnowsItsFiles) {
  const auto folder = synthetic::folder("kinds");
  write(folder / "r.h5");
  put(folder / "text.h5", "no HDF5 at all");
  put(folder / "other.xdmf", "<?xml version=\"1.0\" ?>\n<Xdmf/>\n");
  H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_TRUE(is_result(folder / "r.h5"));
  EXPECT_TRUE(is_sidecar(folder / "r.xdmf"));
  for (const char* name : {"text.h5", "other.h5", "r.xdmf", "none.h5"})
    EXPECT_FALSE(is_result(folder / name)) << name;
  for (const char* name : {"other.xdmf", "r.h5", "none.xdmf"})
    EXPECT_FALSE(is_sidecar(folder / name)) << name;
}

TEST(Writing, CutsALongStatus) {
  const auto file = synthetic::folder("status") / "r.h5";
  ResultWriter writer(file, synthetic::header(), std::nullopt);
  writer.append(synthetic::row(0));
  writer.close(std::string(5000, 'x'), 2);
  EXPECT_EQ(ResultReader(file).status(), std::string(1024, 'x'));
}

// A failed start must not be in the way of the next one.
TEST(Writing, LeavesNoFileWithoutARow) {
  const auto folder = synthetic::folder("nothing");
  ResultWriter(folder / "r.h5", synthetic::header(), synthetic::grid(4, 3)).close("failed: so", 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  ResultWriter(folder / "r.h5", synthetic::header(), synthetic::grid(4, 3)).abandon("so", 1);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Writing, TellsOfAFileThatHasGone) {
  const auto folder = synthetic::folder("gone");
  const auto gone = ThrowsMessage<Error>(one_line(folder / "r.h5", "deleted, moved or replaced"));
  for (const bool moved : {false, true}) {
    ResultWriter writer(folder / "r.h5", synthetic::header(), synthetic::grid(4, 3));
    writer.append(synthetic::row(0));
    if (moved)
      std::filesystem::rename(folder / "r.h5", folder / "other.h5");
    else
      std::filesystem::remove(folder / "r.h5");
    EXPECT_THAT([&] { writer.append(synthetic::row(1)); }, gone);
    EXPECT_FALSE(std::filesystem::exists(folder / "r.xdmf"));
    EXPECT_THROW(writer.close("finished", 1), Error);
  }
  EXPECT_EQ(ResultReader(folder / "other.h5").history().front().t, 0);
}

}  // namespace
}  // namespace gnomon::faults_test
