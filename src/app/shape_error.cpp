#include "app/shape_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <gnomon/error.hpp>

namespace gnomon::app {

double shape_error(const ContactSurface& surface, const ContactSurface& reference) {
  if (surface.initial != reference.initial)
    throw InputError("contact surfaces of different meshes cannot be compared");
  double sum = 0;
  for (std::size_t i = 0; i < surface.worn.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::pow(surface.worn[i][k] - reference.worn[i][k], 2);
  return std::sqrt(sum);
}

ShapeErrors::ShapeErrors(const std::filesystem::path& file) : file_(file) {
  const ResultReader result(file);
  reference_ = result.contact(std::nullopt);
  time_ = result.stored_times().back();
}

std::string ShapeErrors::against(const std::filesystem::path& file,
                                 const ResultReader& result) const {
  if (std::filesystem::equivalent(file, file_)) return "reference";
  if (result.stored_times().empty()) return "nothing stored";
  const ContactSurface surface = result.contact(std::nullopt);
  if (surface.initial != reference_.initial) return "other mesh";
  if (std::abs(result.stored_times().back() - time_) > 1e-9 * std::abs(time_)) return "other time";
  return fmt::format("{:.3e}", shape_error(surface, reference_));
}

}  // namespace gnomon::app
