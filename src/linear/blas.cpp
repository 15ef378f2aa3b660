#include "linear/blas.hpp"

#include <dlfcn.h>

#include <filesystem>

// Only OpenBLAS has these functions; they are resolved when the program is loaded.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));
extern "C" char* openblas_get_config() __attribute__((weak));

namespace gnomon {

namespace {

/// The file that contains dgemm, with links resolved, because Debian uses links to choose one of
/// several BLAS.
std::filesystem::path blas_file() {
  void* dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
  Dl_info info{};
  if (!dgemm || !dladdr(dgemm, &info) || !info.dli_fname) return "unknown";
  std::error_code none;
  const std::filesystem::path resolved = std::filesystem::canonical(info.dli_fname, none);
  return none ? std::filesystem::path(info.dli_fname) : resolved;
}

bool is_openblas(const std::filesystem::path& file) {
  return file.string().find("openblas") != std::string::npos;
}

}  // namespace

void use_blas_threads(int count) {
  if (openblas_set_num_threads) openblas_set_num_threads(count);
}

std::string blas_name() {
  const std::filesystem::path file = blas_file();
  if (!is_openblas(file) || !openblas_get_config) return file.filename().string();
  const std::string config = openblas_get_config();  // name, version, options
  return config.substr(0, config.find(' ', config.find(' ') + 1));
}

bool is_reference_blas() {
  // Netlib's library has a plain name and is in a folder that does not name another library.
  const std::filesystem::path file = blas_file();
  return !is_openblas(file) && file.filename().string().starts_with("libblas.so") &&
         file.string().find("atlas") == std::string::npos &&
         file.string().find("blis") == std::string::npos;
}

}  // namespace gnomon
