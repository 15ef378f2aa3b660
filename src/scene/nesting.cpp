#include "scene/nesting.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon {

namespace {

class NestingScan {
public:
  explicit NestingScan(std::string_view text) : text_(text) {}

  std::optional<DeepNesting> operator()() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '"' || c == '\'')
        skip_string(c);
      else if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        step(c);
      if (parts_ > max_nesting)
        return found(fmt::format("a key of more than {} parts", max_nesting));
      if (depth_ > max_nesting)
        return found(fmt::format("arrays or tables nested more than {} deep", max_nesting));
    }
    return std::nullopt;
  }

private:
  void step(char c) {
    ++at_;
    if (c == '[' || c == '{') ++depth_;
    if (c == ']' || c == '}') depth_ = std::max(0, depth_ - 1);
    if (c == '\n') ++line_;
    if (c == '.')
      ++parts_;
    else if (std::string_view("[]{},=\n").find(c) != std::string_view::npos)
      parts_ = 1;
  }

  /// Moves past the string that begins here. A string in single quotes has no escapes; a string
  /// that is not closed ends with its line, or with the text if it may span lines.
  void skip_string(char quote) {
    const std::string fence(3, quote);
    const bool spans_lines = text_.substr(at_, 3) == fence;
    at_ += spans_lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') {
        if (!spans_lines) return;
        ++line_;
      } else if (text_[at_] == '\\' && quote == '"') {
        if (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      } else if (text_[at_] == quote && (!spans_lines || text_.substr(at_, 3) == fence)) {
        close_string(quote, spans_lines);
        return;
      }
    }
  }

  /// A string that may span lines can end in up to two quotes of its own before the closing three.
  void close_string(char quote, bool spans_lines) {
    at_ += spans_lines ? 3 : 1;
    for (int own = 0; spans_lines && own < 2 && at_ < text_.size() && text_[at_] == quote; ++own)
      ++at_;
  }

  DeepNesting found(const std::string& what) const {
    return {line_, fmt::format("{}, expected at most {}", what, max_nesting)};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  int parts_ = 1;  // of the key that is being read, dots plus one
  int depth_ = 0;  // of brackets and braces that are open
};

}  // namespace

std::optional<DeepNesting> find_deep_nesting(std::string_view text) {
  return NestingScan(text)();
}

}  // namespace gnomon
