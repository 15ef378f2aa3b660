// The connected parts of a mesh as rigid bodies: what supports leave free of their motions.
#pragma once

#include <gnomon/model/assembly.hpp>

namespace gnomon {

/// Translations, then rotations, of a rigid body.
inline constexpr int rigid_motions_of(int dim) {
  return dim == 2 ? 3 : 6;
}
/// Velocities along the directions, then of rotation times a length; or forces, then torques
/// divided by it.
template <int dim>
using Twist = Eigen::Matrix<double, rigid_motions_of(dim), 1>;

/// A velocity of x, by those of a rigid body whose rotations are about `centre`, times `size`.
template <int dim>
Eigen::Matrix<double, dim, rigid_motions_of(dim)> rigid_velocities(const Vector<dim>& x,
                                                                   const Vector<dim>& centre,
                                                                   double size);
/// A place that has moved for a unit of time with a constant twist.
template <int dim>
Eigen::Transform<double, dim, Eigen::Affine> moved_by(const Twist<dim>& twist,
                                                      const Vector<dim>& centre, double size);

/// A connected part of a mesh.
template <int dim>
struct RigidPart {
  int number = 0;          ///< connected_parts()
  std::vector<int> nodes;  ///< of the mesh, ascending
  Vector<dim> centre;      ///< mean of them [length]
  double size = 0;         ///< of the farthest from there [length]
  Eigen::MatrixXd loose;   ///< in the columns: twists that no support holds, nor a spring

  bool has(int node) const { return std::ranges::binary_search(nodes, node); }
};

/// Whether springs hold what they are on, or let it move as loads do.
enum class SpringsHold : bool { no, yes };
/// Springs whose other ends move press like loads.
template <int dim>
SpringsHold springs_hold(const AssemblyParts<dim>& parts);

/// Of all parts; the nodes are at `x`.
template <int dim>
std::vector<RigidPart<dim>> rigid_parts(const AssemblyParts<dim>& parts,
                                        const std::vector<Vector<dim>>& x,
                                        SpringsHold springs = SpringsHold::yes);
/// What supports, and springs, resist of the twists of a part, of which each held direction of a
/// node adds one: symmetric, positive.
template <int dim>
Eigen::MatrixXd resisted(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                         const std::vector<Vector<dim>>& x, SpringsHold springs = SpringsHold::yes);
/// The `count` twists in which supports resist least, where the nodes have moved.
template <int dim>
Eigen::MatrixXd loose_twists(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                             const std::vector<Vector<dim>>& x, Eigen::Index count,
                             SpringsHold springs);

/// A body that has cells in the part.
template <int dim>
const Body& body_of_part(const AssemblyParts<dim>& parts, const RigidPart<dim>& part);

/// "move along x", or "turn about (1, 2)".
template <int dim>
std::string description_of(const Twist<dim>& twist, const RigidPart<dim>& part, Section section);
/// The rotation that is free, without any translation that is free, too: "turn about (1, 2)";
/// empty: none is. In space one of them.
template <int dim>
std::string free_rotation_of(const RigidPart<dim>& part, Section section);
/// All that is free, "move along x and turn".
template <int dim>
std::string free_motions_of(const RigidPart<dim>& part, Section section);

}  // namespace gnomon
