// The paper's error: the distance of two worn shapes.
#pragma once

#include <filesystem>
#include <gnomon/results.hpp>
#include <string>

namespace gnomon::app {

/// Euclidean norm of the difference of the worn contact-node positions (sec. 4.1). Throws
/// InputError when the surfaces do not have the same nodes.
double shape_error(const ContactSurface& surface, const ContactSurface& reference);

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
