// The paper's error (gnomon/surface_error.hpp) between result files.
#pragma once

#include <filesystem>
#include <gnomon/results/results.hpp>
#include <string>

namespace gnomon::app {

/// Errors of the last stored states of results against that of a reference.
class ShapeErrors {
public:
  explicit ShapeErrors(const std::filesystem::path& reference);
  /// The error of `result`, read from `file`, as text; "other mesh" or "other time" where the two
  /// cannot be compared.
  std::string against(const std::filesystem::path& file, const ResultReader& result) const;

private:
  std::filesystem::path file_;
  ContactSurface reference_;
  double time_ = 0;
};

}  // namespace gnomon::app
