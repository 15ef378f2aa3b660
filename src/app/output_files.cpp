#include "app/output_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/error.hpp>
#include <system_error>

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
}

}  // namespace

fs::path default_result(const fs::path& scene, const std::string& integrator) {
  return scene.stem().string() + "-" + integrator + ".h5";
}

fs::path sidecar_of(const fs::path& result) {
  return fs::path(result).replace_extension(".xdmf");
}

void check_outputs(const RunOptions& options) {
  const fs::path sidecar = sidecar_of(options.result);
  check_distinct(options.result, "the result", options.scene, "the scene");
  check_distinct(sidecar, "the result's sidecar", options.scene, "the scene");
  check_distinct(options.summary, "the summary", options.scene, "the scene");
  check_distinct(options.summary, "the summary", options.result, "the result");
  check_distinct(options.summary, "the summary", sidecar, "the result's sidecar");
  if (!options.summary.empty()) check_writable(options.summary);
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text << std::flush;
  if (!stream) throw Error(fmt::format("cannot write {}", file.string()));
}

}  // namespace gnomon::app
