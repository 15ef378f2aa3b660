// A folder with a fast scene and studies of it.
#pragma once

#include <gnomon/results/results.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "app/child.hpp"

namespace gnomon::test {

using Row = std::map<std::string, std::string>;

/// Rows of a CSV text by column name; fields may be quoted, with doubled quotes in them, but hold
/// no line breaks.
inline std::vector<Row> parse_csv(const std::string& text) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    char before = ',';
    for (const char c : line) {
      if (c == '"') {
        quoted = !quoted;
        if (quoted && before == '"') cells.back() += c;
      } else if (c == ',' && !quoted) {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
      before = c;
    }
    return cells;
  };
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  const auto names = split(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    const auto cells = split(line);
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) rows.back()[names[i]] = cells.at(i);
  }
  return rows;
}

class StudyTest : public ProgramTest {
protected:
  StudyTest() { write("scene.toml", read_text(pin)); }

  /// The head of a study of the coarse pin over 100 s.
  static std::string head() {
    return "scene = \"scene.toml\"\n[set]\nmesh.elements = [8, 8]\ntime.end = 100.0\n";
  }
  static std::string method(const std::string& integrator, const std::string& ladder,
                            const std::string& further = "") {
    return "[[method]]\nintegrator = \"" + integrator + "\"\n" + ladder + "\n" + further + "\n";
  }

  Outcome study(const std::vector<std::string>& further = {}) const {
    std::vector<std::string> arguments = {"study", "study.toml", "-o", "out", "--jobs", "2"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return gnomon(arguments);
  }
  std::vector<Row> rows() const { return parse_csv(read_text(folder() / "out/study.csv")); }
  nlohmann::json json() const {
    return nlohmann::json::parse(read_text(folder() / "out/study.json"));
  }
};

}  // namespace gnomon::test
