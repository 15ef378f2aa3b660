#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/number_text.hpp>
#include <set>
#include <sstream>

#include "study/run_files.hpp"

namespace gnomon::study {

namespace {

std::size_t number_of(const std::string& text, const std::string& whole, std::size_t count) {
  const auto number = parsed_number<std::size_t>(text);
  if (!number || *number < 1 || *number > count)
    throw InputError(
        fmt::format("runs `{}`: expected numbers from 1 to {}, as 3, 3-7 or 3,5,9-12, got `{}`",
                    whole, count, text));
  return *number;
}

}  // namespace

std::vector<std::size_t> runs_numbered(const std::string& text, std::size_t count) {
  std::set<std::size_t> runs;
  std::istringstream parts(text + ",");
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t dash = part.find('-');
    const std::size_t first = number_of(part.substr(0, dash), text, count);
    const std::size_t last =
        dash == std::string::npos ? first : number_of(part.substr(dash + 1), text, count);
    if (last < first)
      throw InputError(fmt::format(
          "runs `{}`: expected ranges from a smaller number to a larger one, as 3-7, got `{}`",
          text, part));
    for (std::size_t number = first; number <= last; ++number) runs.insert(number - 1);
  }
  return {runs.begin(), runs.end()};
}

std::string numbers_of(std::vector<std::size_t> runs) {
  std::sort(runs.begin(), runs.end());
  std::string text;
  for (std::size_t i = 0; i < runs.size();) {
    std::size_t last = i;
    while (last + 1 < runs.size() && runs[last + 1] == runs[last] + 1) ++last;
    text += text.empty() ? "" : ",";
    text += last == i ? fmt::format("{}", runs[i] + 1)
                      : fmt::format("{}-{}", runs[i] + 1, runs[last] + 1);
    i = last + 1;
  }
  return text;
}

}  // namespace gnomon::study
