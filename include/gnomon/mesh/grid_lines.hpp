// Graded positions of grid lines: fine and uniform at the start, then with geometrically growing
// distances.
#pragma once

#include <vector>

namespace gnomon {

/// 0 = x_0 < x_1 < ... < x_elements = `end` [length]: elements of size h = fine / round(fine /
/// size) up to `fine`, then elements h q, h q^2, ... with the ratio q that makes them end there.
/// `fine` may be 0 (geometric throughout, h = size) or `end` (uniform throughout; then the number
/// of elements must be that of the fine ones). Throws InputError if this is impossible.
std::vector<double> graded_grid_lines(double size, double fine, double end, int elements);

/// The same with as few elements as a ratio of at most `growth` > 1 allows.
std::vector<double> graded_grid_lines_by_growth(double size, double fine, double end,
                                                double growth);

/// -left reversed, then right: both start at 0, which appears once.
std::vector<double> two_sided_grid_lines(const std::vector<double>& left,
                                         const std::vector<double>& right);

}  // namespace gnomon
