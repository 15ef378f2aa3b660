// The errors of gnomon/results/surface_error.hpp between result files.
#pragma once

#include <filesystem>
#include <gnomon/results/results.hpp>
#include <string>

namespace gnomon::app {

/// As texts: numbers, or why there are none.
struct ResultError {
  std::string shape;     ///< the paper's error [length]; "other mesh", "other time"
  std::string pressure;  ///< largest difference of a nodal contact pressure [stress]; "-" for none
};

/// Errors of the last stored states of results against that of a reference.
class ResultErrors {
public:
  explicit ResultErrors(const std::filesystem::path& reference);
  /// The errors of `result`, read from `file`.
  ResultError against(const std::filesystem::path& file, const ResultReader& result) const;

private:
  std::filesystem::path file_;
  ContactSurface reference_;
  double time_ = 0;
};

}  // namespace gnomon::app
