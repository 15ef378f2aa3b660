// Contact of a deformed body with its partner, node by node: rows of u (contact force), lambda (eq.
// 26), q (balance of forces on the partner), and the share of wear in the rows of the shape (eq.
// 14).
#pragma once

#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// One contact state: its fields and constants. The referenced objects must outlive the term.
template <int dim>
struct ContactState {
  FieldId u = FieldId::none;       ///< displacement, at all nodes of the mesh
  FieldId lambda = FieldId::none;  ///< contact multiplier, at the contact nodes
  FieldId q = FieldId::none;  ///< motion of the partner, at each of its guides; none: no motion
  const Mesh<dim>& mesh;
  ContactParameters<dim> parameters;  ///< those of all phases of a cycle but for the counter-body
  const std::vector<ContactPatch<dim>>& patches;
  /// Part of each contact node in the wear rate of its shape unknowns; empty: 1. With a section,
  /// the length that the node represents divided by the length of the path.
  const std::vector<double>& wear_weight;
  const std::vector<int>& surface_of;  ///< each contact node: whose law wears it
  std::vector<WearLaw> laws{};         ///< of the surfaces
  double part = 1;                     ///< of the mean over a cycle: the weight of its phase
  double nominal_speed = 0;            ///< at which the bodies slide [length / time]
};

template <int dim>
class ContactTerm : public Term<dim> {
public:
  ContactTerm(const ContactState<dim>& state, FieldId d, const Numbering& numbering);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  /// For every contact node lambda + rho g [stress], then the kinks of the wear law.
  void switching(const Evaluation<dim>& at, std::span<double> values) const override;

  /// The contact law at every contact node.
  std::vector<ContactNode<dim>> nodes(const Evaluation<dim>& at) const;

private:
  // Local rows: u | lambda | d (wear) | q; columns: lambda | q | u of patch | d of patch.
  static constexpr int u_0 = 0, lambda_0 = dim, wear_0 = dim + 1, q_0 = 2 * dim + 1;
  static constexpr int q_column = 1;
  static constexpr int most_rows = q_0 + most_partner_unknowns;
  using Local = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_rows,
                              q_column + most_partner_unknowns + 2 * dim * max_patch_nodes>;

  int count() const { return static_cast<int>(state_.patches.size()); }
  std::vector<int> row_numbers(int c) const;
  std::vector<int> column_numbers(int c) const;
  /// The row of d at a contact node, -1: its shape is held, or does not wear.
  int wear_row(int c, int i) const {
    const ContactPatch<dim>& patch = state_.patches[c];
    return patch.may_move() ? d_numbers_(patch.node, i) : -1;
  }
  int unknowns() const { return static_cast<int>(q_numbers_.size()); }
  /// Of the partner: the unknown and the given part. In a load ramp it comes from where it would
  /// touch the body at rest.
  PartnerMotion<> motion(const Evaluation<dim>& at) const;
  ContactInput<dim> gather(const Evaluation<dim>& at, int c) const;
  NodeBranch branch(const Evaluation<dim>& at, int c) const;
  ContactNode<dim> node(const Evaluation<dim>& at, int c) const;
  Local tangent(const Evaluation<dim>& at, int c) const;
  double weight(int c) const {
    return state_.part * (state_.wear_weight.empty() ? 1 : state_.wear_weight[c]);
  }
  const ContactParameters<dim>& parameters(int c) const { return surfaces_[state_.surface_of[c]]; }
  /// The part of the term's switching functions that belongs to a node.
  template <class T>
  std::span<T> own(std::span<T> switching, int c) const {
    return switching.subspan(first_switch_[c], first_switch_[c + 1] - first_switch_[c]);
  }

  ContactState<dim> state_;
  std::vector<ContactParameters<dim>> surfaces_;  // of each wearing surface
  FieldId d_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  std::vector<int> lambda_numbers_, q_numbers_;
  std::vector<std::size_t> first_switch_ = {0};  // of each node; last: their number
  double overlap_ = 0;                 // of the body at rest, by the given motion at t = 0 [length]
  std::vector<std::vector<int>> map_;  // of each node: positions, column by column; -1: none
};

}  // namespace gnomon
