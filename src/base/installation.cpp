#include <dlfcn.h>
#include <errno.h>

#include <cstdlib>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>

namespace gnomon {

namespace {

namespace fs = std::filesystem;

/// The file that contains this function: the library, or the program that it is linked into.
fs::path own_file() {
  Dl_info found{};
  const bool known = dladdr(reinterpret_cast<const void*>(&installed), &found) && found.dli_fname;
  const fs::path file = known ? found.dli_fname : "";
  // Of the program itself only the words of its command line are known.
  const bool is_program = !known || file == program_invocation_name || !file.is_absolute();
  std::error_code error;
  const fs::path real = fs::canonical(is_program ? fs::path("/proc/self/exe") : file, error);
  return error ? file : real;
}

/// A library is in lib/ARCHITECTURE, a program in bin; tests of the build are two folders deep.
fs::path folder_with_data(fs::path folder) {
  constexpr int levels = 4;
  for (int level = 0; level < levels && !folder.empty(); ++level, folder = folder.parent_path()) {
    std::error_code error;
    if (fs::is_directory(folder / "share/gnomon", error)) return folder;
  }
  return {};
}

fs::path prefix() {
  const char* given = std::getenv("GNOMON_PREFIX");
  if (given && *given) return given;
  static const fs::path found = folder_with_data(own_file().parent_path());
  if (found.empty())
    throw Error("the files of gnomon are not found: there is no share/gnomon above " +
                own_file().parent_path().string() + " (GNOMON_PREFIX can name the folder)");
  return found;
}

}  // namespace

fs::path installed(const std::string& part) {
  const fs::path path = prefix() / part;
  std::error_code error;
  const fs::path real = fs::canonical(path, error);
  if (error) throw Error("the installation is not complete: there is no " + path.string());
  return real;
}

}  // namespace gnomon
