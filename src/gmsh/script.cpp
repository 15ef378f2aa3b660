#include "gmsh/script.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "gmsh/model_mesh.hpp"

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

/// "17, 18": the numbers of a list that are not among the tags.
std::string absent_in(const std::string& list, const std::vector<int>& tags) {
  std::string absent, word;
  std::istringstream words(list);
  while (std::getline(words, word, ',')) {
    const int tag = std::abs(std::atoi(word.c_str()));  // negative where it is turned round
    if (std::ranges::find(tags, tag) == tags.end())
      absent += (absent.empty() ? "" : ", ") + std::to_string(tag);
  }
  return absent;
}

}  // namespace

Script::Script(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream whole;
  whole << stream.rdbuf();
  text_ = without_comments(whole.str());
}

std::vector<std::string> Script::absent_members() const {
  static const std::regex group(
      R"re(Physical\s+(Point|Curve|Line|Surface|Volume)\s*\(\s*("[^"]*"|\d+)[^)]{0,40}\)\s*\+?=\s*\{)re");
  std::vector<std::string> sentences;
  for (std::sregex_iterator found(text_.begin(), text_.end(), group), end; found != end; ++found) {
    const auto first = static_cast<std::size_t>(found->position() + found->length());
    const std::size_t last = text_.find_first_not_of("-0123456789, \t\r\n", first);
    if (last == text_.npos || text_[last] != '}') continue;  // not a list of plain numbers
    std::string kind = (*found)[1];
    const std::string list = text_.substr(first, last - first);
    const std::string absent = absent_in(list, entities_of(dimension_named(kind)));
    if (absent.empty()) continue;
    for (char& letter : kind) letter = static_cast<char>(std::tolower(letter));
    std::ostringstream sentence;
    sentence << "group " << (*found)[2] << " names " << kind << " " << absent
             << ", which the geometry does not have";
    sentences.push_back(sentence.str());
  }
  return sentences;
}

/// The fourth entry of a point is its size.
bool Script::gives_sizes() const {
  static const std::regex words(
      R"re(Mesh\s*\.|MeshSize|Characteristic|Field|Transfinite|Layers|Include|\bMesh\s+\d)re"
      R"re(|Merge\s+"[^"]*\.(geo|msh|pos)")re");
  static const std::regex point(
      R"re((Physical\s+)?\bPoint\s*\([^=;]{0,80}\)\s*=\s*\{([^;]{0,400})\}\s*;)re");
  if (std::regex_search(text_, words)) return true;
  constexpr int coordinates = 3;
  for (std::sregex_iterator found(text_.begin(), text_.end(), point), end; found != end; ++found) {
    if ((*found)[1].matched) continue;
    int depth = 0, entries = 1;
    for (const char letter : found->str(2)) {
      if (letter == '(' || letter == '{' || letter == '[') ++depth;
      if (letter == ')' || letter == '}' || letter == ']') --depth;
      if (letter == ',' && depth == 0) ++entries;
    }
    if (entries > coordinates) return true;
  }
  return false;
}

}  // namespace gnomon::gmsh_reader
