// The worn surface and the contact multipliers of a coupled Jacobian, eliminated node by node.
#pragma once

#include <Eigen/Core>
#include <array>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system/system.hpp>
#include <span>
#include <vector>

#include "linear/factored_block.hpp"
#include "linear/low_rank_update.hpp"

namespace gnomon {

/// With r and z right side and solution, and B, C the columns and rows of the multipliers l at the
/// displacements of their nodes:
///
///   row of c   dd_c = J_cc^-1 (r_c - J_cu du - J_cl dl)
///   row of l   C du - D dl = r_l,   C = J_lu - a J_cu,  D = a J_cl - J_ll,  a = J_lc J_cc^-1
///   row of u   K_uu du + B dl = r_u
///
/// so that K_uu + B D^-1 C, K_uu with springs, remains. In a only a node's own entries of J_cc
/// count. D is diagonal where every node has a worn surface of its own, and kept from vanishing.
/// Nodes that share one (the line of a groove) wear together: there D is diagonal but for a matrix
/// of rank one, and so is the change that it brings to K_uu with the springs of the diagonal.
class ContactElimination {
public:
  /// `structure` must outlive the object. `has_terms`: whether the solver of K_uu takes changes of
  /// low rank. Factors do, for many columns share the way through them; a cycle of multigrid costs
  /// as much for each, and there nodes count as if each wore alone, at springs of the last set-up.
  ContactElimination(const Structure& structure, bool has_terms);

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J);

  /// Adds the springs to K_uu, as (C.B / D) along C, and remembers them.
  void add_springs(const SymmetricPart& part, std::vector<double>& values);
  /// What K_uu with the springs of add_springs() lacks: those that have moved since by more than
  /// preconditioning bears, and common wear. None without `has_terms`.
  std::vector<RankOneTerm> terms(const SymmetricPart& part) const;

  /// Turns the right side into that of K_uu with springs; s_l and s_c are kept for recover().
  void condense(std::span<double> s);
  /// z_l and z_c from z_u; s as condense() left it, changed.
  void recover(std::span<double> s, std::span<double> z);

private:
  static constexpr int most = 3;   // components of a node
  using Values = Eigen::Vector3d;  // of components that a node lacks: zero
  using Square = Eigen::Matrix3d;
  struct Numbers {
    std::array<int, most> data{};
    int size = 0;
    int operator[](int k) const { return data[k]; }
    void add(int number);
  };
  /// Unknowns of the worn surface with one number of `group`, and their block of J, inverted.
  struct SurfaceNode {
    Numbers unknowns;
    Square inverse = Square::Zero();
    std::vector<int> closed;  ///< in contact_
    double gamma = 0;         ///< 1 / (1 + epsilon D^-1 alpha) over them
  };
  struct ContactNode {
    int multiplier = 0;
    std::vector<int> candidates;  ///< in surface_, of the pattern of its row
    int surface = -1;             ///< the one that its gap contains, -1: none
    Numbers u;
    Values B = Values::Zero(), C = Values::Zero(), a = Values::Zero();
    Values e = Values::Zero();      ///< J_cl
    double CB = 0;                  ///< C.B; zero: open
    double D = 1;                   ///< its diagonal
    double alpha = 0, epsilon = 0;  ///< of a shared surface: D contains alpha_i epsilon_j
    double stiffness = 0;           ///< of the node itself along C
    double spring = 0, spring_set = 0;
    Values direction = Values::Zero();  ///< of spring_set
    bool followed = false;
  };

  double entry(int row, int column) const;
  void update_surface(SurfaceNode& node) const;
  Values surface_row(int multiplier, int surface) const;
  void update_contact(ContactNode& node) const;
  void share_surfaces();
  void update_spring(ContactNode& node) const;
  void update_line(SurfaceNode& surface) const;
  void follow_moved_springs();
  void divide_by_D(std::vector<double>& r) const;

  const Structure& structure_;
  const bool has_terms_;
  std::span<const double> J_;
  std::vector<SurfaceNode> surface_;
  std::vector<ContactNode> contact_;
  std::vector<int> followed_;  // in contact_
  JacobianBlock wear_row_;
  FactoredBlock wear_block_;
  std::vector<double> work_;  // of contact_
};

}  // namespace gnomon
