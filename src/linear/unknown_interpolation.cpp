#include "linear/unknown_interpolation.hpp"

namespace gnomon {

namespace {

/// Number of each component of the nodes of a level, -1: held.
using Numbers = std::vector<std::array<int, 3>>;

Numbers numbers_of(const StiffnessLayout& layout) {
  Numbers numbers(layout.position.size(), {-1, -1, -1});
  for (std::size_t k = 0; k < layout.group.size(); ++k)
    numbers[layout.group[k]][layout.component[k]] = static_cast<int>(k);
  return numbers;
}

Numbers coarse_numbers(const Numbers& fine, const NodeInterpolation& nodes, int& count) {
  Numbers coarse(nodes.kept.size(), {-1, -1, -1});
  count = 0;
  for (std::size_t k = 0; k < coarse.size(); ++k)
    for (int i = 0; i < 3; ++i)
      if (fine[nodes.kept[k]][i] >= 0) coarse[k][i] = count++;
  return coarse;
}

SparseRows interpolation(const Numbers& fine, int fine_count, const Numbers& coarse,
                         int coarse_count, const NodeInterpolation& nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t node = 0; node + 1 < nodes.start.size(); ++node)
    for (int entry = nodes.start[node]; entry < nodes.start[node + 1]; ++entry)
      for (int i = 0; i < 3; ++i) {
        const int row = fine[node][i], column = coarse[nodes.coarse[entry]][i];
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, nodes.weight[entry]);
      }
  SparseRows rows(fine_count, coarse_count);
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

}  // namespace

std::vector<SparseRows> unknown_interpolations(const StiffnessLayout& layout) {
  std::vector<SparseRows> result;
  if (!layout.coarsening) return result;
  Numbers fine = numbers_of(layout);
  int fine_count = static_cast<int>(layout.group.size());
  for (const NodeInterpolation& nodes : *layout.coarsening) {
    int count = 0;
    Numbers coarse = coarse_numbers(fine, nodes, count);
    if (count == 0) break;
    if (count < fine_count) {
      result.push_back(interpolation(fine, fine_count, coarse, count, nodes));
      fine_count = count;
    } else {
      for (std::size_t k = 0; k < coarse.size(); ++k) coarse[k] = fine[nodes.kept[k]];
    }
    fine = std::move(coarse);
  }
  return result;
}

}  // namespace gnomon
