// Versions of the program and of the libraries in this build.
#pragma once

#include <map>
#include <string>

namespace gnomon {

/// "gnomon", "SUNDIALS", "Eigen", "UMFPACK", "METIS", "HDF5", "compiler", ... and their versions.
std::map<std::string, std::string> library_versions();

}  // namespace gnomon
