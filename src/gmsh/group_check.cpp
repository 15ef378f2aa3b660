#include "gmsh/group_check.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace gnomon::gmsh_reader {

namespace {

std::string without_comments(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (text.compare(at, 2, "//") == 0) {
      at = std::min(text.find('\n', at), text.size());
    } else if (text.compare(at, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", at + 2);
      at = end == text.npos ? text.size() : end + 2;
    } else {
      result += text[at++];
    }
  }
  return result;
}

int dimension_named(const std::string& kind) {
  if (kind == "Point") return 0;
  if (kind == "Curve" || kind == "Line") return 1;
  return kind == "Surface" ? 2 : 3;
}

std::set<int> tags_of(int dimension) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dimension);
  std::set<int> tags;
  for (const auto& pair : pairs) tags.insert(pair.second);
  return tags;
}

/// "17, 18": the numbers of a list that are not among the tags.
std::string absent_in(const std::string& list, const std::set<int>& tags) {
  std::string absent, word;
  std::istringstream words(list);
  while (std::getline(words, word, ',')) {
    const int tag = std::abs(std::atoi(word.c_str()));  // negative where it is turned round
    if (!tags.contains(tag)) absent += (absent.empty() ? "" : ", ") + std::to_string(tag);
  }
  return absent;
}

}  // namespace

std::vector<std::string> absent_members(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream whole;
  whole << stream.rdbuf();
  const std::string text = without_comments(whole.str());
  static const std::regex group(
      R"re(Physical\s+(Point|Curve|Line|Surface|Volume)\s*\(\s*("[^"]*"|\d+)[^)]{0,40}\)\s*\+?=\s*\{)re");
  std::vector<std::string> sentences;
  for (std::sregex_iterator found(text.begin(), text.end(), group), end; found != end; ++found) {
    const auto first = static_cast<std::size_t>(found->position() + found->length());
    const std::size_t last = text.find_first_not_of("-0123456789, \t\r\n", first);
    if (last == text.npos || text[last] != '}') continue;  // not a list of plain numbers
    std::string kind = (*found)[1];
    const std::string list = text.substr(first, last - first);
    const std::string absent = absent_in(list, tags_of(dimension_named(kind)));
    if (absent.empty()) continue;
    for (char& letter : kind) letter = static_cast<char>(std::tolower(letter));
    sentences.push_back("group " + std::string((*found)[2]) + " names " + kind + " " + absent +
                        ", which the geometry does not have");
  }
  return sentences;
}

}  // namespace gnomon::gmsh_reader
