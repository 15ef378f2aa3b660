// Several mistakes in one input, reported at once.
#pragma once

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// More than one mistake in the input, each in a line of its own; what() is the first line.
struct InputErrors : InputError {
  explicit InputErrors(std::vector<std::string> all)
      : InputError(all.front()), lines(std::move(all)) {}
  std::vector<std::string> lines;
};

/// Continues after a mistake, so that the user learns of all of them at once.
class Mistakes {
public:
  /// Does it; an InputError that it throws is kept. Returns whether it threw none.
  template <class Action>
  bool collect(Action&& action) {
    try {
      action();
      return true;
    } catch (const InputErrors& errors) {
      for (const std::string& line : errors.lines) add(line);
    } catch (const InputError& error) {
      add(error.what());
    }
    return false;
  }
  /// Equal lines count once.
  void add(const std::string& line) {
    if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
  }
  bool empty() const { return lines_.empty(); }
  const std::vector<std::string>& lines() const { return lines_; }
  /// Throws InputError for one mistake, InputErrors for several.
  void require_none() const {
    if (lines_.size() == 1) throw InputError(lines_.front());
    if (!lines_.empty()) throw InputErrors(lines_);
  }

private:
  std::vector<std::string> lines_;
};

}  // namespace gnomon
