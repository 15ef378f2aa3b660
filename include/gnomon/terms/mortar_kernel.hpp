// Segment-based mortar integrals of one facet of a slave and one of a master: the part of the slave
// facet that the master facet covers (docs/two_bodies.md).
//
// With the shape functions phi_a of the slave facet, N_b of the master facet, the slave's
// interpolated normal n (out of the slave), its undeformed measure dS and the projection
// x^2 of its points x^1 on the master facet:
//
//   mass_ab     = int phi_a phi_b dS
//   coupling_ab = int phi_a N_b dS
//   gap_a       = int phi_a (x^2 - x^1) . n dS
//   shared_ab   = int I(phi_a N_b) dS
//
// I interpolates linearly between the ends of the covered part in 2D, and is the identity in 3D.
// The row sums of `shared` are those of `coupling`, on flat interfaces the column sums, too;
// between equal meshes it is diagonal, like the nodal quadrature of contact with a rigid body
// (docs/two_bodies.md).
//
// The dual basis of the covered part of the slave facet, psi_a = sum_c A_ac phi_c with
// A = diag(sum_b mass_ab) mass^-1 of the masses summed over all masters, gives D, M and g of the
// mortar method from these (mortar_facet.hpp).
#pragma once

#include <gnomon/mesh/section.hpp>

namespace gnomon {

/// A value for each node of a facet.
template <int dim, class Scalar = double>
using FacetNodal = Eigen::Matrix<Scalar, Mesh<dim>::facet_nodes, dim, Eigen::RowMajor>;

/// What the integrals depend on; nodes in cyclic order, such that slave and master have their
/// outward normals on the side on which the facets of a Mesh have it.
template <int dim, class Scalar = double>
struct FacetPair {
  FacetNodal<dim, Scalar> X;  ///< undeformed positions of the slave's nodes [length]
  FacetNodal<dim, Scalar> x;  ///< their current positions [length]
  FacetNodal<dim, Scalar> n;  ///< their normals: unit, out of the slave
  FacetNodal<dim, Scalar> y;  ///< current positions of the master's nodes [length]
};

template <int dim, class Scalar = double>
struct CoveredPart {
  using Square = Eigen::Matrix<Scalar, Mesh<dim>::facet_nodes, Mesh<dim>::facet_nodes>;
  Square mass = Square::Zero();      ///< [area]
  Square coupling = Square::Zero();  ///< [area]
  Square shared = Square::Zero();    ///< [area]
  Eigen::Matrix<Scalar, Mesh<dim>::facet_nodes, 1> gap =
      Eigen::Matrix<Scalar, Mesh<dim>::facet_nodes, 1>::Zero();  ///< [area length]
};

/// The derivatives of the entries of a CoveredPart, one row for each: mass, coupling, shared
/// (column by column), gap; a column for each entry of X, x, n and y of the pair (row by row).
template <int dim>
struct CoveredPartTangent {
  static constexpr int n = Mesh<dim>::facet_nodes, values = 3 * n * n + n, inputs = 4 * n * dim;
  CoveredPart<dim> part;
  Eigen::Matrix<double, values, inputs> by_input = Eigen::Matrix<double, values, inputs>::Zero();
};

/// Empty where the master facet covers nothing of the slave facet, does not face it, or is farther
/// away than `reach`. dS is that of the whole circumference in a body of revolution.
CoveredPart<2> covered_part(const FacetPair<2>& pair, Section section, double reach);
CoveredPart<3> covered_part(const FacetPair<3>& pair, Section section, double reach);
CoveredPartTangent<2> covered_part_tangent(const FacetPair<2>& pair, Section section, double reach);
CoveredPartTangent<3> covered_part_tangent(const FacetPair<3>& pair, Section section, double reach);

}  // namespace gnomon
