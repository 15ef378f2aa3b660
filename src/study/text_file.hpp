// Reading a whole file, as text or as JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace gnomon::study {

/// The text of a file; empty if there is none.
std::string read_text(const std::filesystem::path& file);
/// The same; throws InputError if it cannot be read.
std::string text_of(const std::filesystem::path& file);

using Json = nlohmann::ordered_json;
/// The object in a file; an empty one if the file is missing or truncated.
Json read_json(const std::filesystem::path& file);

}  // namespace gnomon::study
