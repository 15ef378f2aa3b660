// Numbers and values at one node, by component.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

namespace gnomon {

constexpr int most_components = 3;
/// Numbers of unknowns; -1 for components that the node lacks.
using NodeUnknowns = std::array<int, most_components>;
/// Zero for components that the node lacks.
using NodeValues = Eigen::Vector3d;
using NodeSquare = Eigen::Matrix3d;

inline NodeValues values_at(const NodeUnknowns& unknowns, std::span<const double> x) {
  NodeValues values = NodeValues::Zero();
  for (int k = 0; k < most_components; ++k)
    if (unknowns[k] >= 0) values[k] = x[unknowns[k]];
  return values;
}

}  // namespace gnomon
