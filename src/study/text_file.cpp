#include "study/text_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <gnomon/base/error.hpp>
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

}  // namespace gnomon::study
