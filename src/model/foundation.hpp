// Rigid parts that touch each other through elastic foundations: the pressure at a node is a
// stiffness times its overlap, along the traction of the pair with its friction.
#pragma once

#include "model/rigid_parts.hpp"

namespace gnomon {

/// Where a part is, from where it was at first.
template <int dim>
using Pose = Eigen::Transform<double, dim, Eigen::Affine>;

/// A time of load histories, on the straight lines that are valid immediately after `within`: just
/// before a jump, for example.
struct LoadTime {
  double t = 0, within = 0;
};

/// pressure = stiffness smooth log(1 + exp(overlap / smooth)), twice differentiable.
struct FoundationLaw {
  double stiffness = 1;  ///< [stress / length]
  double smooth = 1;     ///< [length]

  double pressure(double overlap) const;
};

/// Loads along free motions that are smaller, relative to all loads, are rounding errors.
inline constexpr double rounding_of_loads = 1e-6;

template <int dim>
class Foundation {
public:
  /// `x`: where the nodes are at first, in space; `places`: of the bodies in a phase of a cycle.
  /// The referenced objects must outlive it.
  Foundation(const AssemblyParts<dim>& parts, const std::vector<RigidPart<dim>>& rigid,
             std::vector<Vector<dim>> x, const std::vector<BodyPlace<dim>>& places);

  /// Of the loads at a time, and of springs that press like them, on each part.
  std::vector<Twist<dim>> loads(const std::vector<Pose<dim>>& poses, LoadTime at) const;
  /// Adds what contact does to it. Finds again which facets may meet where parts have moved.
  void add_contact(const std::vector<Pose<dim>>& poses, const FoundationLaw& law,
                   std::vector<Twist<dim>>& forces);
  /// All of these at their largest factors, without regard to their directions [force].
  double largest_load() const { return largest_load_; }
  /// The largest overlap that the last call of it met [length].
  double deepest() const { return deepest_; }
  /// Of the facets that may touch [length].
  double facet_size() const { return facet_size_; }
  /// Whether a pair touches a part.
  bool touches(std::size_t part) const { return touches_[part]; }
  /// Where a node is at first.
  const Vector<dim>& place(int node) const { return x_[static_cast<std::size_t>(node)]; }

private:
  struct Side {
    std::size_t part, other;  ///< its own, and that of the other side
    std::vector<ContactPatch<dim>> patches;
    std::vector<typename Mesh<dim>::Facet> targets;
    std::map<int, Vector<dim>> normals;  ///< of the nodes of these, at first
    std::vector<std::vector<int>> near;  ///< by patch: targets that its normal may meet
    std::vector<Vector<dim>> middles{};  ///< of the targets
    std::vector<double>
        reaches{};              ///< how far from it a line passes a target without weight [length]
    RigidMotion<dim> motion{};  ///< of the master's material relative to the slave's
    double friction = 0;
    bool slave = true;
  };
  /// What a node meets along its normal. Beyond the edge of the other surface the weight falls from
  /// one to zero within half of a facet, so that forces do not jump.
  struct Opposite {
    double weight = 0;
    double distance = 0;                       ///< negative: overlap [length]
    Vector<dim> normal = Vector<dim>::Zero();  ///< of the other surface
  };
  Opposite opposite(const Side& side, std::size_t p, const Vector<dim>& n,
                    const Tensor<dim>& rotation) const;
  void find_near(const std::vector<Pose<dim>>& poses);
  void find_middles(Side& side) const;
  bool has_moved(const std::vector<Pose<dim>>& poses) const;
  void add_side(const Side& side, const std::vector<Pose<dim>>& poses, const FoundationLaw& law,
                std::vector<Twist<dim>>& forces);
  void add_springs(const std::vector<Pose<dim>>& poses, LoadTime at,
                   std::vector<Twist<dim>>& forces) const;
  void add_force(std::size_t part, const Vector<dim>& x, const Vector<dim>& force,
                 std::vector<Twist<dim>>& forces) const;

  const AssemblyParts<dim>& parts_;
  const std::vector<RigidPart<dim>>& rigid_;
  std::vector<Vector<dim>> x_, now_;
  std::vector<std::size_t> part_of_;  // by node
  std::vector<Side> sides_;
  std::vector<char> touches_;
  std::vector<std::vector<ContactPatch<dim>>> pressed_;  // by load: patches of its pressure
  std::vector<std::vector<ContactPatch<dim>>> sprung_;   // by springs; empty: they hold
  std::vector<Pose<dim>> found_at_;
  double margin_ = 0, deepest_ = 0, facet_size_ = 0, largest_facet_ = 0, largest_load_ = 0;
};

}  // namespace gnomon
