// Rigid bodies on elastic foundations that move as in a viscous fluid, so that they come to rest
// where they are stable.
#pragma once

#include <string>
#include <vector>

#include "model/foundation.hpp"

namespace gnomon {

template <int dim>
class Settling {
public:
  /// `x`: of the nodes, in space. The referenced objects must outlive it.
  Settling(const AssemblyParts<dim>& parts, const std::vector<Vector<dim>>& x,
           const std::vector<BodyPlace<dim>>& places);

  /// Bodies that may only be shifted in one direction are where they touch; over a cycle in any.
  bool is_free(bool over_cycle) const;
  /// Whether one that may move has places over the cycle: what supports leave free turns with them.
  bool frees_placed() const;
  /// Whether loads act along what is free, beyond rounding errors.
  bool is_driven() const;
  double size() const { return size_; }
  double facet_size() const { return foundation_.facet_size(); }
  const std::vector<RigidPart<dim>>& rigid() const { return rigid_; }
  Vector<dim> place(std::size_t part, int node) const {
    return poses_[part] * foundation_.place(node);
  }

  void begin_again();
  /// Rests with about this overlap. Returns false where the bodies do not come to rest.
  bool settle(double depth, double pressure, LoadTime at);
  /// Whether bodies without loads stay in each other, as a ring that was pressed on a shaft.
  bool is_wedged();
  /// How the loads at the start press all parts further into their foundations, the fastest node
  /// with 1: what another body presses goes along.
  std::vector<NodalField<dim>> pressing();

  /// At the start: the motion with the least stiffness, as a part of that of the load on a pendulum
  /// as long as the bodies.
  struct Softest {
    double stiffness;
    std::string motion;
  };
  Softest softest_motion(double depth);
  /// The last motion of bodies that did not come to rest.
  std::string last_motion() const { return described(last_); }

private:
  // Of the depth. Facets at the edges do not count one by one where bodies are moved so far.
  static constexpr double smoothing = 0.25, far = 0.5;

  /// Along what is free.
  double load(LoadTime at) const { return along_free(foundation_.loads(poses_, at)).norm(); }
  Eigen::VectorXd along_free(const std::vector<Twist<dim>>& forces) const;
  Eigen::VectorXd resultant(const FoundationLaw& law, LoadTime at);
  /// Of all parts.
  std::vector<Twist<dim>> twists(const Eigen::VectorXd& by) const;
  void move(const Eigen::VectorXd& by);
  /// -dR/dz, by central differences of motions h.
  Eigen::MatrixXd stiffness(const Eigen::VectorXd& R, const FoundationLaw& law, double h,
                            LoadTime at);
  /// What supports leave free at another place turns with it: a pivot stays where it is held.
  void turn_directions();
  bool rest(double depth, LoadTime at, double force);
  std::string described(const std::vector<Twist<dim>>& motion) const;

  const AssemblyParts<dim>& parts_;
  SpringsHold springs_;
  std::vector<RigidPart<dim>> rigid_;
  Foundation<dim> foundation_;
  std::vector<Pose<dim>> poses_;
  Eigen::Index unknowns_ = 0;
  std::vector<Twist<dim>> last_;
  double size_ = 0, stiffness_ = 1, depth_ = 1;
};

}  // namespace gnomon
