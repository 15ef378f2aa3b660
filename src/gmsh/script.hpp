// What the text of a script of Gmsh (.geo) says, and Gmsh does not tell.
#pragma once

#include <string>
#include <vector>

namespace gnomon::gmsh_reader {

class Script {
public:
  explicit Script(const std::string& file);

  /// Gmsh leaves out, without a word, curves and surfaces of a physical group that do not exist.
  /// Returns a sentence for each group that is a list of plain numbers, some of which the current
  /// model does not have.
  std::vector<std::string> absent_members() const;

  /// Whether it may say how large elements are: at points, by options, fields or numbers.
  bool gives_sizes() const;

private:
  std::string text_;  // without comments
};

}  // namespace gnomon::gmsh_reader
