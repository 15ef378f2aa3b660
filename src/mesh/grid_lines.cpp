#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/grid_lines.hpp>
#include <limits>

namespace gnomon {

namespace {

constexpr int most_elements = 100'000;

/// q + q^2 + ... + q^elements.
double geometric_sum(double q, int elements) {
  double sum = 0;
  for (int k = 0; k < elements; ++k) sum = (sum + 1) * q;
  return sum;
}

/// The ratio q > 0 at which that sum is `sum`; it is unique because the sum increases with q.
double ratio(double sum, int elements) {
  double low = 0, high = 1;
  while (geometric_sum(high, elements) < sum) high *= 2;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (geometric_sum(middle, elements) < sum ? low : high) = middle;
  }
  return high;
}

struct FineEnd {
  int elements;
  double size;
};

FineEnd fine_end(double size, double fine, double end) {
  if (!(size > 0 && fine >= 0 && end > 0 && fine <= end))
    throw InputError(fmt::format(
        "graded mesh: element size {}, fine length {} and length {} do not fit", size, fine, end));
  constexpr double least = std::numeric_limits<double>::min();  // no quotient below overflows
  if (!(size >= least * end && fine / size < most_elements))
    throw InputError(fmt::format("graded mesh: elements of {} are too small for a length of {}",
                                 size, fine > 0 ? fine : end));
  const int elements = static_cast<int>(std::lround(fine / size));
  if (fine > 0 && elements == 0) return {1, fine};
  return {elements, elements > 0 ? fine / elements : size};
}

}  // namespace

std::vector<double> graded_grid_lines(double size, double fine, double end, int elements) {
  const FineEnd zone = fine_end(size, fine, end);
  const int growing = elements - zone.elements;
  if (growing < 0 || (growing == 0) != (fine == end))
    throw InputError(
        fmt::format("graded mesh: {} elements do not fit a fine length of {} in elements of {} and "
                    "a length of {}",
                    elements, fine, zone.size, end));
  std::vector<double> lines;
  for (int k = 0; k < zone.elements; ++k) lines.push_back(fine * k / zone.elements);
  lines.push_back(fine);
  if (growing == 0) return lines;
  const double q = ratio((end - fine) / zone.size, growing);
  double sum = 0;  // geometric_sum(q, k)
  for (int k = 1; k < growing; ++k) {
    sum = (sum + 1) * q;
    lines.push_back(fine + zone.size * sum);
  }
  lines.push_back(end);
  return lines;
}

std::vector<double> graded_grid_lines_by_growth(double size, double fine, double end,
                                                double growth) {
  if (!(growth > 1)) throw InputError(fmt::format("graded mesh: growth {} is not above 1", growth));
  const FineEnd zone = fine_end(size, fine, end);
  const double needed = (1 - 1e-12) * (end - fine) / zone.size;
  int growing = 0;
  double sum = 0;
  while (sum < needed) {
    sum = (sum + 1) * growth;
    if (++growing > most_elements)
      throw InputError(
          fmt::format("graded mesh: growth {} from elements of {} to a length of {} takes more "
                      "than {} elements",
                      growth, zone.size, end, most_elements));
  }
  return graded_grid_lines(size, fine, end, zone.elements + growing);
}

std::vector<double> two_sided_grid_lines(const std::vector<double>& left,
                                         const std::vector<double>& right) {
  std::vector<double> result;
  for (std::size_t k = left.size(); k-- > 1;) result.push_back(-left[k]);
  result.insert(result.end(), right.begin(), right.end());
  return result;
}

}  // namespace gnomon
