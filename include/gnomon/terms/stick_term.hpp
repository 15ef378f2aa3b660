// Contact with friction that may stick, in one phase of a path or in steady rolling, node by node
// (docs/fretting.md, docs/rolling.md): rows of u, lambda, lambda_T, q and the share of wear in the
// rows of the shape, as ContactTerm; the last phase of a path has the rows of the memory s beside,
//
//   sdot - (r - s) / period = 0
//
// so that s, the place at the end of a cycle, is that before the first phase of the next one
// (slip_memory.hpp). In rolling there may be the row of the mean of q.
#pragma once

#include <gnomon/terms/contact_nodes.hpp>
#include <gnomon/terms/contact_state.hpp>
#include <gnomon/terms/places_on_partner.hpp>
#include <gnomon/terms/stick_node.hpp>

namespace gnomon {

/// The same of a rigid partner. What `contact` refers to must outlive the term.
template <int dim>
struct StickState : StickingFriction<dim> {
  ContactState<dim> contact;
  PathOfPartner<dim> path{};
  /// q of the phase before, where there is one: else r before is s.
  std::optional<FieldId> q_before{};
  std::optional<Rolling<dim>> rolling{};
};

template <int dim>
class StickTerm : public ContactNodes<dim>, public PlacesOnPartner<dim> {
public:
  StickTerm(const StickState<dim>& state, FieldId d, const Numbering& numbering);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  /// For every contact node lambda + rho g and |T^| - r [stress], then the kinks of the wear law.
  void switching(const Evaluation<dim>& at, std::span<double> values) const override;
  std::vector<ContactNode<dim>> nodes(const Evaluation<dim>& at) const override;
  NodalField<dim> places(const Evaluation<dim>& at) const override;

private:
  int count() const { return static_cast<int>(state_.contact.patches.size()); }
  std::vector<int> row_numbers(int c) const;
  std::vector<int> column_numbers(int c) const;
  std::vector<int> memory_rows(int c) const;
  std::vector<int> memory_columns(int c) const;
  template <class Scalar>
  StickInput<dim, Scalar> gather(const Evaluation<dim>& at, int c) const;
  StickBranch branch(const Evaluation<dim>& at, int c) const;
  StickNode<dim> node(const Evaluation<dim>& at, int c) const;
  /// Rows and columns as their numbers, by automatic differentiation; those of r below, for s.
  Eigen::MatrixXd tangent(const Evaluation<dim>& at, int c) const;
  void add_memory(const Evaluation<dim>& at, int c, double rate_weight,
                  const Eigen::MatrixXd& place_by, std::span<double> values) const;
  double weight(int c) const;
  const StickParameters<dim>& parameters(int c) const {
    return surfaces_[state_.contact.surface_of[c]];
  }
  template <class T>
  std::span<T> own(std::span<T> switching, int c) const {
    return switching.subspan(first_switch_[c], first_switch_[c + 1] - first_switch_[c]);
  }

  StickState<dim> state_;
  MotionOfPartner<dim> motion_;
  FieldId d_;
  std::vector<StickParameters<dim>> surfaces_;  // of each wearing surface
  NodalNumbers<dim> u_numbers_, d_numbers_, traction_numbers_, memory_numbers_;
  std::vector<std::vector<int>> before_numbers_;  // of each contact node
  std::vector<int> lambda_numbers_, lambda_before_numbers_, q_numbers_, q_before_numbers_;
  std::vector<int> mean_number_;                 // of q over the contact; empty: no law reads it
  std::vector<std::size_t> first_switch_ = {0};  // of each node; last: their number
  std::vector<std::vector<int>> map_, memory_map_;
};

}  // namespace gnomon
