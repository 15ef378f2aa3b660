# Every external library, found once and bundled in one interface target.
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS kinsol ida)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(BLAS REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)

find_path(UMFPACK_INCLUDE umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
find_path(METIS_INCLUDE metis.h REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)

add_library(gnomon_dependencies INTERFACE)
target_link_libraries(gnomon_dependencies INTERFACE
  SUNDIALS::kinsol SUNDIALS::ida Eigen3::Eigen tomlplusplus::tomlplusplus CLI11::CLI11 fmt::fmt
  nlohmann_json::nlohmann_json PkgConfig::HDF5 ${UMFPACK_LIBRARY} ${METIS_LIBRARY} BLAS::BLAS)
target_include_directories(gnomon_dependencies SYSTEM INTERFACE ${UMFPACK_INCLUDE} ${METIS_INCLUDE})
