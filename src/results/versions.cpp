#include <fmt/format.h>
#include <hdf5.h>
#include <metis.h>
#include <toml++/toml.h>
#include <umfpack.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <gnomon/base/version.hpp>
#include <gnomon/results/versions.hpp>
#include <nlohmann/json.hpp>

#include "linear/blas.hpp"
#include "sundials/version.hpp"

namespace gnomon {

namespace {

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

std::string dotted(int major, int minor, int patch) {
  return fmt::format("{}.{}.{}", major, minor, patch);
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

std::map<std::string, std::string> library_versions() {
  return {
      {"gnomon", version},
      {"BLAS", blas_name()},
      {"CLI11", CLI11_VERSION},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"HDF5", hdf5_version()},
      {"METIS", dotted(METIS_VER_MAJOR, METIS_VER_MINOR, METIS_VER_SUBMINOR)},
      {"nlohmann/json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                               NLOHMANN_JSON_VERSION_PATCH)},
      {"SUNDIALS", sundials::version()},
      {"toml++", dotted(TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"UMFPACK", dotted(UMFPACK_MAIN_VERSION, UMFPACK_SUB_VERSION, UMFPACK_SUBSUB_VERSION)},
      {"compiler", compiler()},
  };
}

}  // namespace gnomon
