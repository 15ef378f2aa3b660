#include "app/result_errors.hpp"

#include <fmt/format.h>

#include <gnomon/base/same_time.hpp>
#include <gnomon/results/surface_error.hpp>

namespace gnomon::app {

ResultErrors::ResultErrors(const std::filesystem::path& file) : file_(file) {
  const ResultReader result(file);
  reference_ = result.contact(std::nullopt);
  time_ = result.stored_times().back();
}

ResultError ResultErrors::against(const std::filesystem::path& file,
                                  const ResultReader& result) const {
  if (std::filesystem::equivalent(file, file_)) return {"reference", "-"};
  if (result.stored_times().empty()) return {"nothing stored", "-"};
  const ContactSurface surface = result.contact(std::nullopt);
  if (surface.initial != reference_.initial) return {"other mesh", "-"};
  if (!same_time(result.stored_times().back(), time_)) return {"other time", "-"};
  return {fmt::format("{:.3e}", shape_error(surface, reference_)),
          fmt::format("{:.3e}", pressure_error(surface, reference_))};
}

}  // namespace gnomon::app
