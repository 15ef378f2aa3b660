# Every external library, found once; the targets are listed in gnomon_dependencies. Programs that link gnomon
# statically find them by this file too (gnomonConfig.cmake).
# Missing libraries are collected, so that one run names everything that has to be installed.
set(gnomon_missing "")
set(gnomon_missing_packages "")

# Notes NAME as missing, with the Debian package PACKAGE that contains it, unless FOUND is true.
function(gnomon_need name package found)
  if(NOT found)
    list(APPEND gnomon_missing "${name} (${package})")
    list(APPEND gnomon_missing_packages ${package})
    set(gnomon_missing "${gnomon_missing}" PARENT_SCOPE)
    set(gnomon_missing_packages "${gnomon_missing_packages}" PARENT_SCOPE)
  endif()
endfunction()

# Finds a library that ships neither a CMake nor a pkg-config file, as the imported target gnomon::NAME.
macro(gnomon_find_plain name title package)
  find_path(${name}_INCLUDE_DIR ${name}.h PATH_SUFFIXES suitesparse)
  find_library(${name}_LIBRARY ${name})
  mark_as_advanced(${name}_INCLUDE_DIR ${name}_LIBRARY)
  if(${name}_INCLUDE_DIR AND ${name}_LIBRARY)
    add_library(gnomon::${name} UNKNOWN IMPORTED)
    set_target_properties(gnomon::${name} PROPERTIES
      IMPORTED_LOCATION ${${name}_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${${name}_INCLUDE_DIR})
    gnomon_need(${title} ${package} TRUE)
  else()
    gnomon_need(${title} ${package} FALSE)
  endif()
endmacro()

# Packages with a CMake configuration of their own.
find_package(SUNDIALS 6.4 QUIET CONFIG COMPONENTS kinsol idas arkode sunlinsolspfgmr)
gnomon_need("SUNDIALS 6.4 with KINSOL, IDAS and ARKODE" libsundials-dev "${SUNDIALS_FOUND}")
find_package(Eigen3 3.4 QUIET CONFIG)
gnomon_need("Eigen 3.4" libeigen3-dev "${Eigen3_FOUND}")
find_package(Spectra 1.0 QUIET CONFIG)
gnomon_need("Spectra 1.0" libspectra-dev "${Spectra_FOUND}")
find_package(tomlplusplus QUIET CONFIG)
gnomon_need("toml++" libtomlplusplus-dev "${tomlplusplus_FOUND}")
find_package(CLI11 QUIET CONFIG)
gnomon_need("CLI11" libcli11-dev "${CLI11_FOUND}")
find_package(OpenMP QUIET COMPONENTS CXX)
gnomon_need("OpenMP" g++ "${OpenMP_CXX_FOUND}")
find_package(fmt QUIET CONFIG)
gnomon_need("fmt" libfmt-dev "${fmt_FOUND}")
find_package(nlohmann_json QUIET CONFIG)
gnomon_need("nlohmann-json" nlohmann-json3-dev "${nlohmann_json_FOUND}")
if(GNOMON_TESTS)
  find_package(GTest QUIET)
  gnomon_need("GoogleTest and GoogleMock" "libgtest-dev libgmock-dev" "${GTest_FOUND}")
endif()
if(GNOMON_BENCHMARKS)
  find_package(benchmark QUIET CONFIG)
  gnomon_need("Google Benchmark" libbenchmark-dev "${benchmark_FOUND}")
endif()

# HDF5: Debian installs serial and MPI variants side by side; gnomon needs the serial one.
find_package(PkgConfig QUIET)
gnomon_need("pkg-config" pkg-config "${PKG_CONFIG_FOUND}")
if(PKG_CONFIG_FOUND)
  pkg_search_module(HDF5 QUIET IMPORTED_TARGET hdf5-serial hdf5)
  gnomon_need("HDF5, serial" libhdf5-dev "${HDF5_FOUND}")
endif()

# SuiteSparse and METIS; KLU serves the benchmarks only.
gnomon_find_plain(umfpack UMFPACK libsuitesparse-dev)
gnomon_find_plain(cholmod CHOLMOD libsuitesparse-dev)
gnomon_find_plain(metis METIS libmetis-dev)
if(GNOMON_BENCHMARKS)
  gnomon_find_plain(klu KLU libsuitesparse-dev)
endif()

# PETSc, with the MPI that its headers need, only for multigrid: a module that is loaded on first use.
if(GNOMON_MULTIGRID AND PKG_CONFIG_FOUND)
  pkg_search_module(PETSC QUIET IMPORTED_TARGET PETSc petsc)
  find_package(MPI QUIET COMPONENTS CXX)
  if(NOT (PETSC_FOUND AND MPI_CXX_FOUND))
    message(WARNING "No multigrid: PETSc or its MPI is missing (Debian: petsc-dev; "
                    "-DGNOMON_MULTIGRID=OFF builds without).")
    set(GNOMON_MULTIGRID OFF)
  endif()
endif()

# Gmsh's library, for meshes and geometries of users alone: a program of its own that is started on first use.
if(GNOMON_GMSH)
  find_path(gmsh_INCLUDE_DIR gmsh.h)
  find_library(gmsh_LIBRARY gmsh)
  mark_as_advanced(gmsh_INCLUDE_DIR gmsh_LIBRARY)
  if(gmsh_INCLUDE_DIR AND gmsh_LIBRARY)
    add_library(gnomon::gmsh UNKNOWN IMPORTED)
    set_target_properties(gnomon::gmsh PROPERTIES
      IMPORTED_LOCATION ${gmsh_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${gmsh_INCLUDE_DIR})
  else()
    message(WARNING "No meshes from files: Gmsh's library is missing (Debian: libgmsh-dev; "
                    "-DGNOMON_GMSH=OFF builds without).")
    set(GNOMON_GMSH OFF)
  endif()
endif()

# Python and pybind11, for the Python package alone; the package needs the shared library.
if(GNOMON_PYTHON)
  set(PYBIND11_FINDPYTHON ON)
  # A Python in PATH without numpy (of a version manager, for example) would be of no use.
  foreach(candidate python3 /usr/bin/python3)
    execute_process(COMMAND ${candidate} -c "import numpy" RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
    if(code EQUAL 0 AND NOT Python_EXECUTABLE)
      find_program(Python_EXECUTABLE ${candidate})
    endif()
  endforeach()
  find_package(Python 3.11 QUIET COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 QUIET CONFIG)
  if(NOT (Python_FOUND AND pybind11_FOUND AND BUILD_SHARED_LIBS))
    message(WARNING "No Python package: it needs Python 3.11, pybind11 (Debian: python3-dev pybind11-dev) and "
                    "BUILD_SHARED_LIBS; -DGNOMON_PYTHON=OFF builds without.")
    set(GNOMON_PYTHON OFF)
  endif()
endif()

# BLAS: OpenBLAS if it exists, otherwise any other; -DBLA_VENDOR=... chooses another one.
if(NOT BLA_VENDOR)
  set(BLA_VENDOR OpenBLAS)
  find_package(BLAS QUIET)
  unset(BLA_VENDOR)
endif()
if(NOT BLAS_FOUND)
  find_package(BLAS QUIET)
endif()
gnomon_need(BLAS libopenblas-pthread-dev "${BLAS_FOUND}")

# UMFPACK loads its BLAS by the name libblas.so.3, behind which Debian puts one of several.
find_library(GNOMON_RUNTIME_BLAS NAMES libblas.so.3)
mark_as_advanced(GNOMON_RUNTIME_BLAS)
if(GNOMON_RUNTIME_BLAS)
  file(REAL_PATH "${GNOMON_RUNTIME_BLAS}" gnomon_blas)
  message(STATUS "BLAS at run time: ${gnomon_blas}")
  if(gnomon_blas MATCHES "/libblas\\.so\\.3\\.[0-9.]+$")
    message(WARNING "UMFPACK runs with the reference BLAS: factorisations take 4 to 6 times as long as "
                    "with OpenBLAS (Debian: libopenblas-pthread-dev).")
  endif()
endif()

if(gnomon_missing)
  list(JOIN gnomon_missing ", " gnomon_missing)
  list(REMOVE_DUPLICATES gnomon_missing_packages)
  list(JOIN gnomon_missing_packages " " gnomon_missing_packages)
  if(CMAKE_FIND_PACKAGE_NAME)
    set(${CMAKE_FIND_PACKAGE_NAME}_FOUND FALSE)
    set(${CMAKE_FIND_PACKAGE_NAME}_NOT_FOUND_MESSAGE
        "gnomon is a static library here, and needs: ${gnomon_missing}")
    return()
  endif()
  message(FATAL_ERROR "Missing: ${gnomon_missing}.\n"
                      "On Debian run scripts/setup, or: apt-get install ${gnomon_missing_packages}")
endif()

set(gnomon_dependencies
  SUNDIALS::kinsol SUNDIALS::idas SUNDIALS::arkode SUNDIALS::sunlinsolspfgmr BLAS::BLAS gnomon::umfpack
  gnomon::cholmod gnomon::metis Eigen3::Eigen Spectra::Spectra PkgConfig::HDF5 tomlplusplus::tomlplusplus
  CLI11::CLI11 fmt::fmt nlohmann_json::nlohmann_json)
