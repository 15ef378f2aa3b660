// Gather and scatter of the contact nodes: rows of u (contact force), lambda (eq. 26), d (eq. 14),
// w (balance of forces on the counter-body) and, in the multiplier form, the reaction mu in the
// auxiliary equilibrium (eq. 29).
#pragma once

#include <gnomon/fields/unknowns.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

namespace gnomon {

template <int dim>
class ContactAssembly {
public:
  /// References must outlive the object.
  ContactAssembly(const WornBody<dim>& body, const Unknowns<dim>& unknowns);

  void add_to_pattern(PatternBuilder& builder) const;
  /// Computes the scatter map; call once, after the pattern is built.
  void map_to(const SparsePattern& pattern);

  /// `ydot` may be empty when no contact shape is unknown. `piece` as in Point.
  void add_residual(const NodalState<dim>& state, std::span<const double> ydot,
                    const ActiveSet* piece, std::span<double> F) const;
  void add_jacobian(const NodalState<dim>& state, double alpha, const ActiveSet* piece,
                    std::span<double> values) const;

  /// The contact law at contact node c, on a piece as in Point.
  ContactNode<dim> node(const NodalState<dim>& state, int c,
                        const ActiveSet* piece = nullptr) const;

private:
  // Local rows: u | lambda | d (wear) | w | auxiliary equilibrium; columns: lambda | w | mu | u of
  // patch | d of patch.
  static constexpr int rows = 3 * dim + 2;
  static constexpr int u_0 = 0, lambda_0 = dim, wear_0 = dim + 1, w_0 = 2 * dim + 1,
                       auxiliary_0 = 2 * dim + 2;
  static constexpr int w_column = 1, mu_column = 2, patch_column = dim + 2;
  using Local = Eigen::Matrix<double, rows, Eigen::Dynamic, 0, rows,
                              patch_column + 2 * dim * max_patch_nodes>;

  std::vector<int> row_numbers(int c) const;
  std::vector<int> column_numbers(int c) const;
  ContactInput<dim> gather(const NodalState<dim>& state, int c) const;
  Local tangent(const NodalState<dim>& state, double alpha, const ActiveSet* piece, int c) const;
  bool augmented(int c) const;
  double weight(int c) const { return body_.wear_weight.empty() ? 1 : body_.wear_weight[c]; }

  const WornBody<dim>& body_;
  const Unknowns<dim>& unknowns_;
  std::vector<char> owns_;             // 1 where a contact node carries its shape unknowns itself
  std::vector<std::vector<int>> map_;  // a contact node: positions, column by column; -1: none
};

}  // namespace gnomon
