#include "study/markup.hpp"

#include <fmt/format.h>

namespace gnomon::study {

namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Removes every element `name` with its contents.
void remove_elements(std::string& text, const std::string& name) {
  const std::string end = "</" + name + ">";
  for (std::size_t at = text.find("<" + name); at != std::string::npos;
       at = text.find("<" + name, at)) {
    const std::size_t close = text.find(end, at);
    if (close == std::string::npos) return;
    text.erase(at, close + end.size() - at);
  }
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if ((static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f)
      result += ' ';
    else
      result += c;
  }
  return result;
}

std::string inline_svg(const std::string& document, const std::string& prefix) {
  const std::size_t begin = document.find("<svg"), end = document.rfind("</svg>");
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  std::string svg = document.substr(begin, end + 6 - begin);
  remove_elements(svg, "metadata");
  remove_elements(svg, "script");
  replace_all(svg, " id=\"", " id=\"" + prefix);
  replace_all(svg, "href=\"#", "href=\"#" + prefix);
  replace_all(svg, "url(#", "url(#" + prefix);
  return svg;
}

std::string figure_part(const std::vector<std::string>& figures, const std::string& note) {
  std::string text;
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (const std::string svg = inline_svg(figures[i], fmt::format("f{}-", i + 1)); !svg.empty())
      text += fmt::format("<figure>\n{}\n</figure>\n", svg);
  if (text.empty() && !note.empty())
    text = fmt::format("<p class=\"note\">{}</p>\n", escaped(note));
  return text.empty() ? "" : "<h2>Figures</h2>\n" + text;
}

}  // namespace gnomon::study
