// Reading a whole file, as text or as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gnomon::study {

/// Throws InputError if it cannot be read.
std::string text_of(const std::filesystem::path& file);

using Json = nlohmann::ordered_json;
/// The object in a file; an empty one if the file is missing or truncated.
Json read_json(const std::filesystem::path& file);

}  // namespace gnomon::study
