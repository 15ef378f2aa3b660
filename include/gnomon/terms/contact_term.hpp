// Contact of a deformed body with a rigid counter-body, node by node: rows of u (contact force),
// lambda (eq. 26), w (balance of forces on the counter-body), and the share of wear in the rows of
// the shape (eq. 14).
#pragma once

#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/shape_evolution.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// One contact state: its fields and constants. The referenced objects must outlive the term.
template <int dim>
struct ContactState {
  FieldId u = FieldId::none;       ///< displacement, at all nodes of the mesh
  FieldId lambda = FieldId::none;  ///< contact multiplier, at the contact nodes
  FieldId w = FieldId::none;  ///< rigid motion along `approach`, a single value; none: no motion
  const Mesh<dim>& mesh;
  ContactParameters<dim> parameters;  ///< those of all phases of a cycle but for the counter-body
  const std::vector<ContactPatch<dim>>& patches;
  /// Part of each contact node in the wear rate of its shape unknowns; empty: 1. With a section,
  /// the length that the node represents divided by the length of the path.
  const std::vector<double>& wear_weight;
  const std::vector<int>& surface_of;  ///< each contact node: whose law wears it
  std::vector<WearLaw> laws{};         ///< of the surfaces
  double part = 1;           ///< of the mean over a cycle: the weight of its phase
  double nominal_speed = 0;  ///< at which the bodies slide [length / time]
};

template <int dim>
class ContactTerm : public Term<dim> {
public:
  ContactTerm(const ContactState<dim>& state, const WornSurface<dim>& surface,
              const Numbering& numbering);

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
  // Local rows: u | lambda | d (wear) | w | reaction; columns: lambda | w | u of patch | d of
  // patch.
  static constexpr int rows = 3 * dim + 2;
  static constexpr int u_0 = 0, lambda_0 = dim, wear_0 = dim + 1, w_0 = 2 * dim + 1,
                       reaction_0 = 2 * dim + 2;
  static constexpr int w_column = 1, patch_column = 2;
  using Local = Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows,
                              patch_column + 2 * dim * max_patch_nodes>;

  int count() const { return static_cast<int>(state_.patches.size()); }
  std::vector<int> row_numbers(int c) const;
  std::vector<int> column_numbers(int c) const;
  /// Of the counter-body along `approach`: the unknown and the given part. In a load ramp it comes
  /// from where it would touch the body at rest.
  double motion(const Evaluation<dim>& at) const;
  ContactInput<dim> gather(const Evaluation<dim>& at, int c) const;
  NodeBranch branch(const Evaluation<dim>& at, int c) const;
  ContactNode<dim> node(const Evaluation<dim>& at, int c) const;
  Local tangent(const Evaluation<dim>& at, int c) const;
  double weight(int c) const {
    return state_.part * (state_.wear_weight.empty() ? 1 : state_.wear_weight[c]);
  }
  const ContactParameters<dim>& parameters(int c) const {
    return surfaces_[state_.surface_of[c]];
  }
  /// The part of the term's switching functions that belongs to a node.
  template <class T>
  std::span<T> own(std::span<T> switching, int c) const {
    return switching.subspan(first_switch_[c], first_switch_[c + 1] - first_switch_[c]);
  }

  ContactState<dim> state_;
  std::vector<ContactParameters<dim>> surfaces_;  // of each wearing surface
  FieldId d_;
  EvolutionRows<dim> evolution_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  std::vector<int> lambda_numbers_;
  int w_number_;
  std::vector<std::size_t> first_switch_ = {0};  // of each node; last: their number
  double overlap_ = 0;                 // of the body at rest, by the given motion at t = 0 [length]
  std::vector<std::vector<int>> map_;  // of each node: positions, column by column; -1: none
};

}  // namespace gnomon
