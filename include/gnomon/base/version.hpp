// The version of gnomon; CMakeLists.txt reads it from here.
#pragma once

namespace gnomon {

inline constexpr const char* version = "0.2.0";

}  // namespace gnomon
