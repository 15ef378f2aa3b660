#include "study/text_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <gnomon/base/error.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

namespace gnomon::study {

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream.is_open() || stream.bad())
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  return text.str();
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Json json = Json::parse(stream, nullptr, false);
  return json.is_object() ? json : Json::object();
}

}  // namespace gnomon::study
