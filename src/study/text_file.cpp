#include "study/text_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <gnomon/base/error.hpp>
#include <iterator>
#include <nlohmann/json.hpp>

namespace gnomon::study {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string text_of(const std::filesystem::path& file) {
  if (!std::ifstream(file)) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return read_text(file);
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Json json = Json::parse(stream, nullptr, false);
  return json.is_object() ? json : Json::object();
}

}  // namespace gnomon::study
