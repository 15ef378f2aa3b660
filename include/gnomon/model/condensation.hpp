// Elasticity condensed to the contact nodes. With small strains and wear as a gap the stiffness K
// of the bodies is constant, so that the other displacements are eliminated once and for all:
//
//   S = K_cc - K_ci K_ii^-1 K_ic          c: unknown displacements of contact nodes
//   g = f_c  - K_ci K_ii^-1 f_i           i: all other unknown displacements
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <gnomon/fields/nodal.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/model/cyclic_phases.hpp>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

template <int dim>
struct AssemblyParts;

/// Forces at nodes that do not follow the deformation.
template <int dim>
struct DeadForces {
  NodalField<dim> forces;  ///< at factor one, nodes x dim [force]
  LoadHistory history{};
  bool presses = false;  ///< Load::presses
  /// In a phase.
  std::function<double(const Phase<dim>&)> factor = [](const Phase<dim>&) { return 1.0; };
};

/// S of the contact nodes of a connected part of the mesh.
struct CondensedPart {
  Eigen::MatrixXd stiffness;              ///< [force / length]
  std::vector<std::pair<int, int>> kept;  ///< node and direction of each row
};

/// What would make the stiffness constant: a gap instead of a mesh that moves, small strains, no
/// pressures that follow the surface. Empty where it is constant.
template <int dim>
std::string varying_stiffness(const AssemblyParts<dim>& parts);

template <int dim>
class Condensation {
public:
  /// `nodes`: of contact, ascending. Throws InputError for a varying_stiffness(), and Error where
  /// the other nodes have no unique displacement.
  Condensation(const AssemblyParts<dim>& parts, const std::vector<int>& nodes);

  /// Whether it is that of these nodes.
  bool keeps(const std::vector<int>& nodes) const { return nodes == nodes_; }
  const std::vector<CondensedPart>& parts() const { return parts_; }
  /// 1 where u is not kept, by node of the mesh.
  const NodalFlags<dim>& left_out() const { return left_out_; }
  /// g of all dead forces, of what moved supports and springs exert among them.
  const std::vector<DeadForces<dim>>& loads() const { return condensed_; }
  /// All of u at time t, from that of the kept unknowns and of moved supports, in equilibrium
  /// with the loads in a phase.
  NodalField<dim> whole(const NodalField<dim>& u, double t, const Phase<dim>& phase) const;

private:
  using Sparse = Eigen::SparseMatrix<double>;
  void number(const AssemblyParts<dim>& parts);
  void condense_stiffness(CondensedPart& part) const;
  void add_loads(const AssemblyParts<dim>& parts);
  NodalField<dim> condensed(const NodalField<dim>& forces) const;
  /// K u, nodes x dim.
  NodalField<dim> resistance(const NodalField<dim>& u) const;

  std::vector<int> nodes_;
  Sparse K_;  // of all displacements, also the held ones
  Sparse K_ii_, K_ci_;
  std::vector<std::pair<int, int>> kept_, inner_;  // c and i: node, direction
  NodalFlags<dim> left_out_;
  std::vector<DeadForces<dim>> loads_, condensed_;
  std::vector<CondensedPart> parts_;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solve_inner_;  // K_ii^-1, column by column
};

}  // namespace gnomon
