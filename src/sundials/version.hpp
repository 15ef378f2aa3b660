// The version of the SUNDIALS in use.
#pragma once

#include <string>

namespace gnomon::sundials {

/// As "6.4.1"; of the library that is loaded, not of the headers.
std::string version();

}  // namespace gnomon::sundials
