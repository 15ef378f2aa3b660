// Where the files are that belong to this copy of gnomon: scenes, the plotting program, modules.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// A file or folder of this installation; `part` is relative to its prefix
/// ("share/gnomon/problems"). The prefix is the environment variable GNOMON_PREFIX, or otherwise
/// the nearest folder above the library (above the program, if it is linked statically) that has a
/// folder share/gnomon: an installation may be moved as a whole. Throws Error, with the path that
/// was expected, if there is no prefix or no such file.
std::filesystem::path installed(const std::string& part);

}  // namespace gnomon
