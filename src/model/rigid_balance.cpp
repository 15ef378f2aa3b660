#include "model/rigid_balance.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "model/bring_together.hpp"
#include "model/foundation.hpp"

namespace gnomon {

namespace {

/// Rigid bodies move as in a viscous fluid, so that they come to rest where they are stable.
template <int dim>
class Settling {
public:
  /// `x`: of the nodes, in space.
  Settling(const AssemblyParts<dim>& parts, const std::vector<Vector<dim>>& x,
           const std::vector<BodyPlace<dim>>& places)
      : parts_(parts),
        springs_(springs_hold(parts)),
        rigid_(rigid_parts(parts, x, springs_)),
        foundation_(parts, rigid_, x, places) {
    for (std::size_t k = 0; k < rigid_.size(); ++k) {
      if (!foundation_.touches(k)) rigid_[k].loose.resize(rigid_motions_of(dim), 0);
      unknowns_ += rigid_[k].loose.cols();
      if (rigid_[k].loose.cols() > 0) size_ = std::max(size_, rigid_[k].size);
    }
    poses_.assign(rigid_.size(), Pose<dim>::Identity());
  }

  /// Bodies that may only be shifted in one direction are where they touch; over a cycle in any.
  bool is_free(bool over_cycle) const {
    constexpr double rounding = 1e-6;
    return std::ranges::any_of(rigid_, [&](const RigidPart<dim>& part) {
      const auto rotations = part.loose.bottomRows(rigid_motions_of(dim) - dim);
      return (part.loose.cols() > 1 && !over_cycle) || rotations.norm() > rounding;
    });
  }
  /// Whether one that may move has places over the cycle: what supports leave free turns with them.
  bool frees_placed() const {
    return std::ranges::any_of(rigid_, [&](const RigidPart<dim>& part) {
      const auto number =
          static_cast<std::size_t>(&body_of_part(parts_, part) - parts_.bodies.data());
      return part.loose.cols() > 0 &&
             (!parts_.cycle || parts_.cycle->motion.bodies[number].moves());
    });
  }
  /// Whether loads act along what is free, beyond rounding errors.
  bool is_driven() const { return load({}) > rounding_of_loads * foundation_.largest_load(); }
  double size() const { return size_; }
  double facet_size() const { return foundation_.facet_size(); }
  void begin_again() {
    poses_.assign(rigid_.size(), Pose<dim>::Identity());
    turn_directions();
  }
  /// Along what is free.
  double load(LoadTime at) const { return along_free(foundation_.loads(poses_, at)).norm(); }
  Vector<dim> place(std::size_t part, int node) const {
    return poses_[part] * foundation_.place(node);
  }
  const std::vector<RigidPart<dim>>& rigid() const { return rigid_; }
  /// How the loads at the start press all parts further into their foundations, the fastest node
  /// with 1: what another body presses goes along.
  std::vector<NodalField<dim>> pressing() {
    const Eigen::VectorXd loads = along_free(foundation_.loads(poses_, {}));
    const FoundationLaw law{stiffness_, smoothing * depth_};
    Eigen::VectorXd by =
        stiffness(resultant(law, {}), law, far * depth_, {}).partialPivLu().solve(loads);
    if (!by.allFinite()) by = loads;
    const std::vector<Twist<dim>> twist = twists(by);
    std::vector<NodalField<dim>> result;
    double fastest = 0;
    for (std::size_t k = 0; k < rigid_.size(); ++k) {
      const RigidPart<dim>& part = rigid_[k];
      result.push_back(NodalField<dim>::Zero(std::ssize(part.nodes), dim));
      for (Eigen::Index n = 0; n < result[k].rows(); ++n)
        result[k].row(n) =
            rigid_velocities<dim>(place(k, part.nodes[std::size_t(n)]), part.centre, part.size) *
            twist[k];
      fastest = std::max(fastest, result[k].rowwise().norm().maxCoeff());
    }
    for (NodalField<dim>& each : result) each /= fastest > 0 ? fastest : 1;
    return result;
  }

  /// Whether bodies without loads stay in each other, as a ring that was pressed on a shaft.
  bool is_wedged() {
    constexpr double kept = 0.3;  // at rest forces are small, which go with the cube of the depth
    resultant({}, {});
    const double depth = foundation_.deepest();
    if (!(depth > 0)) return false;
    stiffness_ = 1;
    const FoundationLaw law{stiffness_, smoothing * depth};
    rest(depth, {}, resultant(law, {}).norm());
    resultant(law, {});
    return foundation_.deepest() > kept * depth;
  }

  /// Rests with about this overlap. Returns false where the bodies do not come to rest.
  bool settle(double depth, double pressure, LoadTime at) {
    constexpr int most_changes = 8;
    constexpr double stiffer = 10, change = 4;  // pressures are uneven; deep edges fall over
    stiffness_ = stiffer * pressure / depth;
    depth_ = depth;
    if (!rest(depth, at, load(at))) return false;
    for (int k = 0; k < most_changes; ++k) {
      const double ratio = foundation_.deepest() / depth;
      if (ratio > 0.5 && ratio < 2) break;
      const std::vector<Pose<dim>> here = poses_;
      const double stiffness = stiffness_;
      stiffness_ *= std::clamp(ratio, 1 / change, change);
      if (rest(depth, at, load(at))) continue;
      poses_ = here;
      stiffness_ = stiffness;
      turn_directions();
      break;
    }
    return true;
  }

  /// At the start: the motion with the least stiffness, as a part of that of the load on a pendulum
  /// as long as the bodies.
  struct Softest {
    double stiffness;
    std::string motion;
  };
  Softest softest_motion(double depth) {
    const FoundationLaw law{stiffness_, smoothing * depth};
    const Eigen::MatrixXd K = stiffness(resultant(law, {}), law, far * depth, {});
    const Eigen::EigenSolver<Eigen::MatrixXd> modes(K);  // friction: it is not symmetric
    Eigen::Index least = 0;
    modes.eigenvalues().real().minCoeff(&least);
    return {modes.eigenvalues()[least].real() * size_ / load({}),
            described(twists(modes.eigenvectors().col(least).real()))};
  }
  /// The last motion of bodies that did not come to rest.
  std::string last_motion() const { return described(last_); }

private:
  // Of the depth. Facets at the edges do not count one by one where bodies are moved so far.
  static constexpr double smoothing = 0.25, far = 0.5;

  Eigen::VectorXd along_free(const std::vector<Twist<dim>>& forces) const {
    Eigen::VectorXd result(unknowns_);
    Eigen::Index first = 0;
    for (std::size_t k = 0; k < rigid_.size(); ++k) {
      const Eigen::Index count = rigid_[k].loose.cols();
      result.segment(first, count) = rigid_[k].loose.transpose() * forces[k];
      first += count;
    }
    return result;
  }

  Eigen::VectorXd resultant(const FoundationLaw& law, LoadTime at) {
    std::vector<Twist<dim>> forces = foundation_.loads(poses_, at);
    foundation_.add_contact(poses_, law, forces);
    return along_free(forces);
  }

  /// Of all parts.
  std::vector<Twist<dim>> twists(const Eigen::VectorXd& by) const {
    std::vector<Twist<dim>> result;
    Eigen::Index first = 0;
    for (const RigidPart<dim>& part : rigid_) {
      result.push_back(part.loose * by.segment(first, part.loose.cols()));
      first += part.loose.cols();
    }
    return result;
  }

  void move(const Eigen::VectorXd& by) {
    const std::vector<Twist<dim>> twist = twists(by);
    for (std::size_t k = 0; k < rigid_.size(); ++k)
      if (rigid_[k].loose.cols() > 0)
        poses_[k] = moved_by<dim>(twist[k], rigid_[k].centre, rigid_[k].size) * poses_[k];
  }

  /// -dR/dz, by central differences of motions h.
  Eigen::MatrixXd stiffness(const Eigen::VectorXd& R, const FoundationLaw& law, double h,
                            LoadTime at) {
    Eigen::MatrixXd K(R.size(), R.size());
    const std::vector<Pose<dim>> here = poses_;
    for (Eigen::Index k = 0; k < R.size(); ++k) {
      move(h * Eigen::VectorXd::Unit(R.size(), k));
      const Eigen::VectorXd ahead = resultant(law, at);
      poses_ = here;
      move(-h * Eigen::VectorXd::Unit(R.size(), k));
      K.col(k) = (resultant(law, at) - ahead) / (2 * h);
      poses_ = here;
    }
    return K;
  }

  /// What supports leave free at another place turns with it: a pivot stays where it is held.
  void turn_directions() {
    std::vector<Vector<dim>> now(parts_.mesh.nodes.size());
    for (std::size_t k = 0; k < rigid_.size(); ++k)
      for (const int node : rigid_[k].nodes) now[static_cast<std::size_t>(node)] = place(k, node);
    for (RigidPart<dim>& part : rigid_)
      if (const Eigen::Index count = part.loose.cols(); count > 0)
        part.loose = loose_twists(parts_, part, now, count, springs_);
  }

  bool rest(double depth, LoadTime at, double force) {
    constexpr int most_steps = 300;
    constexpr double at_rest = 5e-3, largest_step = 0.05, farthest = 4, described_path = 0.3;
    const FoundationLaw law{stiffness_, smoothing * depth};
    double time = 1, path = 0;  // time: in that of a path of one depth under the whole load
    Eigen::VectorXd R = resultant(law, at), before = 0 * R;  // the last step
    for (int step = 0; step < most_steps && path < farthest * size_; ++step) {
      if (R.norm() <= at_rest * force) return true;
      Eigen::MatrixXd K = stiffness(R, law, 1e-3 * depth, at);
      K.diagonal().array() += force / depth / time;
      Eigen::VectorXd by = K.partialPivLu().solve(R);
      if (!by.allFinite()) by = R;
      if (path <= described_path * size_) last_ = twists(by);
      by *= std::min(1.0, largest_step * size_ / by.norm());
      const std::vector<Pose<dim>> here = poses_;
      move(by);
      const Eigen::VectorXd next = resultant(law, at);
      // Steps that Newton's method has made longer than contact follows; slow motions go on.
      const bool through_a_stop = next.dot(R) < 0 && next.norm() > 0.5 * R.norm() && time > 1e-3,
                 too_far = next.norm() > 1.5 * R.norm() && time > 1,
                 to_and_fro = by.dot(before) < -0.5 * by.norm() * before.norm() &&
                              next.norm() > 0.5 * R.norm() && time > 1;
      if (through_a_stop || too_far || to_and_fro) {
        poses_ = here;
        time /= 8;
        continue;
      }
      before = by;
      time *= next.norm() < R.norm() ? 4 : 1.5;
      path += by.norm();
      turn_directions();
      R = resultant(law, at);
    }
    return false;
  }

  std::string described(const std::vector<Twist<dim>>& motion) const {
    const auto most = static_cast<std::size_t>(
        std::ranges::max_element(motion, {}, [](const auto& twist) { return twist.norm(); }) -
        motion.begin());
    return fmt::format("\"{}\" can {}", body_of_part(parts_, rigid_[most]).name,
                       description_of<dim>(motion[most], rigid_[most], parts_.section()));
  }

  const AssemblyParts<dim>& parts_;
  SpringsHold springs_;
  std::vector<RigidPart<dim>> rigid_;
  Foundation<dim> foundation_;
  std::vector<Pose<dim>> poses_;
  Eigen::Index unknowns_ = 0;
  std::vector<Twist<dim>> last_;
  double size_ = 0, stiffness_ = 1, depth_ = 1;
};

}  // namespace

template <int dim>
bool supports_press(const AssemblyParts<dim>& parts) {
  return !parts.supports.moved.empty() || springs_hold(parts) == SpringsHold::no;
}

template <int dim>
bool wedged(const AssemblyParts<dim>& parts) {
  AssemblyParts<dim> left_alone = parts;  // friction would drag them
  left_alone.loads.clear();
  for (SpringSupport<dim>& springs : left_alone.supports.springs) springs.displacement.setZero();
  for (MortarPair<dim>& pair : left_alone.pairs) pair.friction = 0;
  return Settling<dim>(left_alone, parts.mesh.nodes, {}).is_wedged();
}

namespace {

/// Brings bodies to rest at the start, on softer foundations first: deep contact is wide on any
/// mesh, and says what rolls, whatever the foundation is; but what stands on a narrow surface may
/// fall over, and stands on stiffer ones. Returns the motion that nothing determines, or nothing,
/// and the depth of the softest foundation.
template <int dim>
std::pair<std::string, double> start(Settling<dim>& settling, const Scales& scales) {
  // As a load on a pendulum far longer than the bodies; what a foundation adds that is 4 times as
  // stiff, and facets of what rolls do not.
  constexpr double nearly = 0.03, firmer = 0.3;
  const double size = settling.size(), mesh = settling.facet_size();
  // Facets that are deep in each other do not face each other.
  const double least = std::min(scales.displacement, 2e-3 * size);
  double depth =
      std::max(least, std::min(0.1 * size, std::max(0.02 * size, 8 * mesh * mesh / size)));
  std::optional<double> before;  // stiffness of what is not yet determined
  for (double softest = 0;; depth = std::max(least, depth / 4)) {
    const bool last = depth <= least;
    if (!settling.settle(depth, scales.stress, {})) {
      if (softest > 0 || last) return {settling.last_motion(), softest};
      settling.begin_again();
      before.reset();
      continue;
    }
    if (softest == 0) {
      const auto [stiffness, motion] = settling.softest_motion(depth);
      const bool grows = !before || stiffness > *before + firmer;
      if (grows && stiffness > nearly)
        softest = depth;
      else if (last || !grows)
        return {motion, softest};
      before = stiffness;
    }
    if (last) return {"", softest};
  }
}

}  // namespace

template <int dim>
RigidBalance<dim>::RigidBalance(const AssemblyParts<dim>& parts,
                                const std::vector<BodyPlace<dim>>& places,
                                const std::vector<LoadTime>& times)
    : x(parts.mesh.nodes) {
  const Touching<dim> touching(parts, places);
  displacement = touching.displacement;
  direction = touching.direction;
  for (std::size_t node = 0; node < x.size(); ++node)
    x[node] += displacement.row(static_cast<Eigen::Index>(node)).transpose();
  if (parts.pairs.empty()) return;
  Settling<dim> settling(parts, in_space(parts.pairs, places, x), places);
  if (!settling.is_free(!places.empty()) || (!places.empty() && settling.frees_placed()) ||
      !settling.is_driven() || !parts.supports.moved.empty() ||
      (places.empty() && supports_press(parts)))
    return;
  double softest = 0;
  std::tie(doubt, softest) = start(settling, parts.scales);
  if (springs_hold(parts) == SpringsHold::no && !doubt.empty()) {
    doubt.clear();  // elastic bodies rest where the springs press them
    return;
  }
  if (!doubt.empty()) return;
  const std::vector<RigidPart<dim>>& rigid = settling.rigid();
  settled = true;
  const std::vector<NodalField<dim>> pressing = settling.pressing();
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    if (rigid[k].loose.cols() == 0) continue;
    for (std::size_t n = 0; n < rigid[k].nodes.size(); ++n) {
      const int node = rigid[k].nodes[n];
      const Vector<dim> moved = settling.place(k, node);
      for (int i = 0; i < dim; ++i)
        if (!parts.supports.held(node, i)) {
          x[node][i] = moved[i];
          displacement(node, i) = moved[i] - parts.mesh.nodes[node][i];
          direction(node, i) = pressing[k](static_cast<Eigen::Index>(n), i);
        }
    }
  }
  for (const LoadTime& at : times)
    if (!settling.settle(softest, parts.scales.stress, at)) {
      doubt = fmt::format("at t = {:g} s {}", at.t, settling.last_motion());
      return;
    }
}

template bool supports_press(const AssemblyParts<2>&);
template bool supports_press(const AssemblyParts<3>&);
template bool wedged(const AssemblyParts<2>&);
template bool wedged(const AssemblyParts<3>&);
template struct RigidBalance<2>;
template struct RigidBalance<3>;

}  // namespace gnomon
