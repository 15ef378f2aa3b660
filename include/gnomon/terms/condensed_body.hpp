// Bodies whose stiffness is constant and condensed to some displacements: the rows of these.
#pragma once

#include <Eigen/Core>
#include <gnomon/terms/term.hpp>
#include <utility>
#include <vector>

namespace gnomon {

/// S u in the rows of u, over the displacements that S stands for.
template <int dim>
class CondensedBody : public Term<dim> {
public:
  /// `S` [force / length], square; `kept`: node and direction of each of its rows. Both must
  /// outlive the term.
  CondensedBody(const Eigen::MatrixXd& S, const std::vector<std::pair<int, int>>& kept,
                const Numbering& numbering, FieldId u)
      : S_(S), kept_(kept), u_(u) {
    for (const auto& [node, i] : kept) numbers_.push_back(numbering.number(u, node, i));
  }

  void declare(TermStructure& structure) const override {
    structure.pattern.add(numbers_, numbers_);
  }
  void map_to(const SparsePattern& pattern) override {
    map_ = pattern.positions(numbers_, numbers_);
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    const NodalField<dim>& u = at.values.vector(u_);
    Eigen::VectorXd kept(S_.cols());
    for (std::size_t k = 0; k < kept_.size(); ++k)
      kept[static_cast<Eigen::Index>(k)] = u(kept_[k].first, kept_[k].second);
    const Eigen::VectorXd force = S_ * kept;
    for (std::size_t k = 0; k < kept_.size(); ++k)
      if (numbers_[k] >= 0) F[numbers_[k]] += force[static_cast<Eigen::Index>(k)];
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const override {
    for (std::size_t k = 0; k < map_.size(); ++k)
      if (map_[k] >= 0) values[map_[k]] += S_.data()[k];
  }

private:
  const Eigen::MatrixXd& S_;
  const std::vector<std::pair<int, int>>& kept_;
  FieldId u_;
  std::vector<int> numbers_, map_;  // of the unknowns; positions of S in J, column by column
};

}  // namespace gnomon
