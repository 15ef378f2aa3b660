// Mortar sums of one slave facet over all masters that cover it (mortar_kernel.hpp), with the dual
// basis psi of its covered part; the phi of corners that have hardly any of it are added to those
// of their neighbours:
//
//   D_a = int psi_a dS = int phi_a dS,   g_a = int psi_a (x^2 - x^1) . n dS
//   M_ab = int psi_a N_b dS,             W_ab = int I(phi_a N_b) dS
#pragma once

#include <gnomon/terms/mortar_kernel.hpp>
#include <vector>

namespace gnomon {

template <int dim>
struct MortarFacet {
  static constexpr int n = Mesh<dim>::facet_nodes;
  using Square = Eigen::Matrix<double, n, n>;
  using Nodal = Eigen::Matrix<double, n, 1>;

  struct Master {
    int facet = 0;  ///< as given to the constructor
    Square M, W;    ///< [area]
  };
  Nodal D = Nodal::Zero();    ///< [area]
  Nodal gap = Nodal::Zero();  ///< [area length]
  std::vector<Master> masters;

  /// `pair`: of the slave facet; `y` and `facets`: of each candidate its positions and its number.
  MortarFacet(FacetPair<dim> pair, const std::vector<FacetNodal<dim>>& y,
              const std::vector<int>& facets, Section section, double reach);
};

/// With its derivatives: a row for each entry of D, gap, and for each master M, W (column by
/// column); a column for each entry of X, x, n of the slave facet (row by row) and of the y of each
/// covering master.
template <int dim>
struct MortarFacetTangent {
  using Square = typename MortarFacet<dim>::Square;
  static constexpr int n = MortarFacet<dim>::n, own = 3 * n * dim, each = n * dim;
  MortarFacet<dim> facet;
  Eigen::MatrixXd by_input;

  MortarFacetTangent(FacetPair<dim> pair, const std::vector<FacetNodal<dim>>& y,
                     const std::vector<int>& facets, Section section, double reach);
  static constexpr int row_of_gap = n, row_of_masters = 2 * n, rows_of_master = 2 * n * n;
  static constexpr int row_of_M(int master, int a, int b) {
    return row_of_masters + master * rows_of_master + n * b + a;
  }
};

}  // namespace gnomon
