// Reading a whole file as text.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::study {

/// Throws InputError if it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace gnomon::study
