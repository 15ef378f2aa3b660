// Pieces of HTML.
#pragma once

#include <string>
#include <vector>

namespace gnomon::study {

/// The text with the characters that have a meaning in HTML escaped; control characters become
/// spaces.
std::string escaped(const std::string& text);

/// An SVG document as an element of a page: no prologue, no metadata (which holds links), and its
/// identifiers begin with `prefix`, so that several fit into one page. Empty if it is no SVG.
std::string inline_svg(const std::string& document, const std::string& prefix);

/// The part of a page that holds the figures (texts of SVG files), or a note if there are none.
std::string figure_part(const std::vector<std::string>& figures, const std::string& note);

}  // namespace gnomon::study
