// The displacements of contact nodes under unit forces at them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "linear/contact_entries.hpp"
#include "linear/stiffness_block.hpp"

namespace gnomon {

/// G = the part of K^-1 in rows and columns of the points' displacements, of which columns are
/// solved for when they are first needed, and kept until K is set up again.
class ContactCompliance {
public:
  /// `nodes`: of every point the numbers of its displacements in the block.
  explicit ContactCompliance(std::vector<NodeUnknowns> nodes) : nodes_(std::move(nodes)) {
    clear();
  }

  void clear() {
    first_column_.assign(nodes_.size(), -1);
    G_.resize(most_components * static_cast<long>(nodes_.size()), 0);
  }
  /// How many columns solve() would have to solve for.
  long missing(const std::vector<int>& nodes) const {
    return most_components *
           std::ranges::count_if(nodes, [this](int node) { return first_column_[node] < 0; });
  }

  /// Makes the columns of these nodes available.
  void solve(const std::vector<int>& nodes, StiffnessBlock& stiffness) {
    constexpr long together = 60;             // columns per solve
    std::vector<std::pair<int, long>> fresh;  // number in the block, and column
    long end = G_.cols();
    for (const int node : nodes) {
      if (first_column_[node] >= 0) continue;
      first_column_[node] = static_cast<int>(end);
      for (int i = 0; i < most_components; ++i)
        if (nodes_[node][i] >= 0) fresh.emplace_back(nodes_[node][i], end + i);
      end += most_components;
    }
    G_.conservativeResizeLike(Eigen::MatrixXd::Zero(G_.rows(), end));
    Eigen::MatrixXd forces, moved;
    for (auto rest = std::span(fresh); !rest.empty();) {
      const auto part = rest.first(std::min<std::size_t>(together, rest.size()));
      forces.setZero(stiffness.size(), std::ssize(part));
      moved.resizeLike(forces);
      for (long k = 0; k < std::ssize(part); ++k) forces(part[k].first, k) = 1;
      const auto entries = static_cast<std::size_t>(forces.size());
      stiffness.solver().apply({forces.data(), entries}, {moved.data(), entries});
      for (long k = 0; k < std::ssize(part); ++k)
        for (std::size_t node = 0; node < nodes_.size(); ++node)
          for (int i = 0; i < most_components; ++i)
            if (const int number = nodes_[node][i]; number >= 0)
              G_(most_components * static_cast<long>(node) + i, part[k].second) = moved(number, k);
      rest = rest.subspan(part.size());
    }
  }

  /// G of these nodes, whose columns are available.
  Eigen::MatrixXd among(const std::vector<int>& nodes) const {
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd result(most_components * count, most_components * count);
    for (Eigen::Index l = 0; l < count; ++l)
      for (Eigen::Index k = 0; k < count; ++k)
        result.block<most_components, most_components>(most_components * k, most_components * l) =
            G_.block<most_components, most_components>(most_components * long(nodes[k]),
                                                       first_column_[nodes[l]]);
    return result;
  }
  long columns() const { return G_.cols(); }

private:
  std::vector<NodeUnknowns> nodes_;
  std::vector<int> first_column_;  // in G_, of every node; -1: not available
  Eigen::MatrixXd G_;              // a row per component of every node
};

}  // namespace gnomon
