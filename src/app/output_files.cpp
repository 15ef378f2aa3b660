#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/summary.hpp>
#include <system_error>

#include "app/commands.hpp"

namespace gnomon::app {

namespace fs = std::filesystem;

namespace {

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;  // a path that cannot be resolved is reported where it is opened
  const fs::path real_a = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  return real_a == fs::weakly_canonical(fs::absolute(b, ignored), ignored) && !real_a.empty();
}

void check_distinct(const fs::path& written, const std::string& what, const fs::path& other,
                    const std::string& other_what) {
  if (!written.empty() && !other.empty() && same_file(written, other))
    throw InputError(fmt::format("{}: expected {} and {} in different files", written.string(),
                                 what, other_what));
}

void check_writable(const fs::path& file) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("cannot write {}: {}", file.string(), why));
  };
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::error_code error;
  if (fs::is_directory(file, error)) fail("it is a folder");
  if (!fs::is_directory(folder, error)) fail("there is no folder " + folder.string());
  const fs::path target = fs::exists(file, error) ? file : folder;
  if (access(target.c_str(), W_OK) != 0) fail(std::strerror(errno));
  const long longest = pathconf(folder.c_str(), _PC_NAME_MAX);
  const std::size_t needed = file.filename().string().size() + std::strlen(".part");
  if (longest > 0 && needed > static_cast<std::size_t>(longest)) fail("the name is too long");
}

/// A terminal, a pipe, /dev/null: a file without contents that could be lost.
bool is_stream(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// A kind of file that runs write.
struct Kind {
  const char* option;  ///< the option that names the file
  const char* name;
  bool (*made)(const fs::path&);  ///< whether a run can have made the file
};

void check_earlier(const fs::path& file, const Kind& kind, bool force) {
  if (!is_taken(file)) return;
  if (!force)
    throw InputError(fmt::format("{} exists; give another name with {}, or --force to replace it",
                                 file.string(), kind.option));
  if (!kind.made(file))
    throw InputError(
        fmt::format("{} exists and is not {} of gnomon, so --force does not replace it",
                    file.string(), kind.name));
}

}  // namespace

void check_outputs(const RunOptions& options) {
  const fs::path sidecar = sidecar_of(options.result);
  const bool printed = options.summary.empty() || options.summary == "-";
  const fs::path summary = printed ? fs::path() : options.summary;
  if (options.result.extension() != ".h5")
    throw InputError(
        fmt::format("cannot write {}: expected a name that ends in .h5", options.result.string()));
  check_distinct(options.result, "the result", options.scene, "the scene");
  check_distinct(sidecar, "the result's sidecar", options.scene, "the scene");
  check_distinct(summary, "the summary", options.scene, "the scene");
  check_distinct(summary, "the summary", options.result, "the result");
  check_distinct(summary, "the summary", sidecar, "the result's sidecar");

  check_earlier(options.result, {"-o", "a result", is_result}, options.force);
  check_earlier(sidecar, {"-o", "a sidecar", is_sidecar}, options.force);
  check_writable(options.result);
  if (printed) return;
  check_writable(summary);
  if (!is_stream(summary) && !is_summary_without_start(summary))  // nothing to lose
    check_earlier(summary, {"--summary", "a summary", is_summary}, options.force);
}

void write_summary(const RunOptions& options, const std::string& text, bool started) {
  const fs::path& file = options.summary;
  if (file.empty()) return;
  if (file == "-") {
    fmt::print("{}", text);
  } else if (is_stream(file)) {
    std::ofstream stream(file, std::ios::binary);
    stream << text << std::flush;
    if (!stream) throw Error(fmt::format("cannot write {}", file.string()));
  } else if (const bool worthless = is_summary_without_start(file);
             started || worthless || !is_taken(file)) {
    // A link is followed, so that it stays one.
    write_file(is_taken(file) ? fs::canonical(file) : file, text,
               options.force || worthless ? Earlier::replaced : Earlier::refused);
  }
}

}  // namespace gnomon::app
