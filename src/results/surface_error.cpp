#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/results/results.hpp>

namespace gnomon {

namespace {

void check_same_nodes(const ContactSurface& a, const ContactSurface& b) {
  if (a.initial != b.initial)
    throw InputError("contact surfaces of different meshes cannot be compared");
}

}  // namespace

double shape_error(const ContactSurface& surface, const ContactSurface& reference) {
  check_same_nodes(surface, reference);
  double sum = 0;
  for (std::size_t i = 0; i < surface.worn.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::pow(surface.worn[i][k] - reference.worn[i][k], 2);
  return std::sqrt(sum);
}

double pressure_error(const ContactSurface& surface, const ContactSurface& reference) {
  check_same_nodes(surface, reference);
  double largest = 0;
  for (std::size_t i = 0; i < surface.pressure.size(); ++i) {
    const double difference = std::abs(surface.pressure[i] - reference.pressure[i]);
    if (std::isnan(difference)) return difference;
    largest = std::max(largest, difference);
  }
  return largest;
}

}  // namespace gnomon
