// Runs the targets of the fuzzers on their corpus, and on a limited number of mutations of it.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <algorithm>
#include <cfenv>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <optional>
#include <random>
#include <vector>

#include "fuzz/targets.hpp"

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace gnomon::corpus_test {
namespace {

struct Target {
  const char* name;
  void (*function)(std::string_view);
  int mutations;
  bool reads_hdf5 = false;
};

void PrintTo(const Target& target, std::ostream* stream) {
  *stream << target.name;
}

/// Changes such as editors, disks and users cause; they do not depend on the standard library.
class Mutator {
public:
  Mutator(const std::vector<std::string>& corpus, unsigned seed) : corpus_(corpus), random_(seed) {}

  std::string operator()() {
    std::string bytes = other();
    for (std::size_t left = 1 + below(4); left > 0; --left) change(bytes);
    return bytes;
  }

private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }
  const std::string& other() { return corpus_[below(corpus_.size())]; }

  /// Length of a run of bytes, usually short.
  std::string part_of(const std::string& bytes) {
    const std::size_t begin = below(bytes.size());
    return bytes.substr(begin, 1 + below(std::size_t{1} << below(8)));
  }

  void change(std::string& bytes) {
    static const std::vector<std::string> words = {
        "0",         "-1",         "nan",        "inf",    "1e400",  "1e308",
        "4e-324",    "2147483648", "[",          "]]",     "\"",     "\"\"\"",
        "{",         "=",          ".",          "\n",     "\xff",   "\x00",
        "[[sweep]]", "{ a = 1",    "1979-05-27", "true",   "[1, 2]", "9223372036854775807",
        "a.b.c.",    "mesh.",      "#--set ",    "\\u0000"};
    const std::size_t at = below(bytes.size() + 1);
    switch (below(6)) {
      case 0:
        bytes.insert(at, words[below(words.size())]);
        break;
      case 1:
        bytes.erase(at, part_of(bytes).size());
        break;
      case 2:
        bytes.insert(at, part_of(other()));
        break;
      case 3:
        bytes.replace(at, part_of(bytes).size(), words[below(words.size())]);
        break;
      case 4:
        bytes.resize(bytes.size() - below(1 + bytes.size() / 4));
        break;
      default:
        if (at < bytes.size()) bytes[at] = static_cast<char>(random_());
    }
  }

  const std::vector<std::string>& corpus_;
  std::mt19937 random_;
};

class Fuzz : public testing::TestWithParam<Target> {
protected:
  // Numbers of any size overflow somewhere, which must not trap here (GNOMON_TRAP).
  Fuzz() { std::feholdexcept(&before_); }
  ~Fuzz() override { std::fesetenv(&before_); }

  void SetUp() override {
    if (GetParam().name == std::string("mesh") && !reads_mesh_files())
      GTEST_SKIP() << "built without Gmsh's library";
    const std::filesystem::path folder =
        std::filesystem::path(GNOMON_SOURCE_DIR "/tests/fuzz/corpus") / GetParam().name;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names_.push_back(entry.path().filename());
    std::sort(names_.begin(), names_.end());
    for (const std::string& name : names_)
      corpus_.push_back(fuzz::read_file(std::string("corpus/") + GetParam().name + "/" + name));
  }

  /// Whether the target accepted the bytes; it may refuse them, but must not fail in another way.
  static bool accepts(const std::string& bytes) {
#ifdef __SANITIZE_ADDRESS__  // HDF5 itself leaks memory when it refuses a damaged structure
    std::optional<__lsan::ScopedDisabler> leaks_of_hdf5;
    if (GetParam().reads_hdf5) leaks_of_hdf5.emplace();
#endif
    testing::internal::CaptureStdout();
    bool accepted = true;
    std::string fault;  // reported when standard output is restored
    try {
      GetParam().function(bytes);
    } catch (const InputError& error) {
      accepted = false;
      const std::string message = error.what();
      if (message.find('\n') != message.npos) fault = "more than a line: " + message;
    } catch (const std::exception& error) {
      fault = error.what();
    }
    testing::internal::GetCapturedStdout();
    EXPECT_EQ(fault, "");
    return accepted;
  }

  std::vector<std::string> names_, corpus_;

private:
  std::fenv_t before_;
};

TEST_P(Fuzz, CorpusIsTakenOrRefused) {
  int accepted = 0;
  for (std::size_t i = 0; i < corpus_.size(); ++i) {
    SCOPED_TRACE(names_[i]);
    accepted += accepts(corpus_[i]);
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, std::ssize(corpus_));
}

TEST_P(Fuzz, MutationsAreTakenOrRefused) {
  Mutator mutate(corpus_, 1);
  int accepted = 0;
  for (int i = 0; i < GetParam().mutations; ++i) {
    SCOPED_TRACE("mutation " + std::to_string(i));
    accepted += accepts(mutate());
  }
  EXPECT_GT(accepted, 0);
  EXPECT_LT(accepted, GetParam().mutations);
#ifndef __SANITIZE_ADDRESS__
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 300'000) << "kB of memory for small inputs";
#endif
}

INSTANTIATE_TEST_SUITE_P(All, Fuzz,
                         testing::Values(Target{"scene", fuzz::scene, 1000},
                                         Target{"study", fuzz::study, 300},
                                         Target{"result", fuzz::result, 200, true},
                                         Target{"layout", fuzz::layout, 100, true},
                                         Target{"expression", fuzz::expression, 3000},
                                         Target{"mesh", fuzz::mesh, 50},
                                         Target{"body", fuzz::body, 5000}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace gnomon::corpus_test
