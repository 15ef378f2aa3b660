// The worn surface and the contact multipliers of a coupled Jacobian, eliminated node by node.
#pragma once

#include <Eigen/Core>
#include <array>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/system.hpp>
#include <span>
#include <vector>

#include "linear/factored_block.hpp"
#include "linear/spring_update.hpp"

namespace gnomon {

/// With r and z right side and solution, and B, C the columns and rows of a multiplier l at the
/// displacement of its node:
///
///   row of c   dd_c = J_cc^-1 (r_c - J_cu du - J_cl dl)
///   row of l   C du - D dl = r_l,   C = J_lu - a J_cu,  D = a J_cl - J_ll,  a = J_lc J_cc^-1
///   row of u   K_uu du + B dl = r_u
///
/// so that K_uu + B D^-1 C, K_uu with springs, remains. In a and D only a node's own entries of
/// J_cc count, and D is kept from vanishing.
class ContactElimination {
public:
  /// `structure` must outlive the object.
  explicit ContactElimination(const Structure& structure);

  /// Takes the values of J; the span must outlive their use.
  void update(std::span<const double> J);

  /// Adds the springs to K_uu, as (C.B / D) along C, and remembers them.
  void add_springs(const SymmetricPart& part, std::vector<double>& values);
  /// How many springs that are not followed have changed since by more than preconditioning bears.
  long moved_springs() const;
  /// Those; they are followed from now on until add_springs().
  std::vector<SpringDirection> follow_springs(const SymmetricPart& part);
  /// Changes of all springs that are followed, in their order.
  Eigen::VectorXd changes() const;

  /// Turns the right side into that of K_uu with springs; s_l and s_c are kept for recover().
  void condense(std::span<double> s) const;
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
  };
  struct ContactNode {
    int multiplier = 0;
    std::vector<int> candidates;  ///< in surface_, of the pattern of its row
    int surface = -1;             ///< the one that its gap contains, -1: none
    Numbers u;
    Values B = Values::Zero(), C = Values::Zero(), a = Values::Zero();
    double D = 1;
    double stiffness = 0;  ///< of the node itself along C
    double spring = 0, spring_set = 0;
    Values direction = Values::Zero();  ///< of spring_set
    bool followed = false;

    bool moved() const;
  };

  double entry(int row, int column) const;
  void update_surface(SurfaceNode& node) const;
  Values surface_row(int multiplier, int surface) const;
  void update_contact(ContactNode& node) const;

  const Structure& structure_;
  std::span<const double> J_;
  std::vector<SurfaceNode> surface_;
  std::vector<ContactNode> contact_;
  std::vector<int> followed_;  // in contact_
  JacobianBlock wear_row_;
  FactoredBlock wear_block_;
};

}  // namespace gnomon
