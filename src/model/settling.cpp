#include "model/settling.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <iterator>

namespace gnomon {

template <int dim>
Settling<dim>::Settling(const AssemblyParts<dim>& parts, const std::vector<Vector<dim>>& x,
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

template <int dim>
bool Settling<dim>::is_free(bool over_cycle) const {
  constexpr double rounding = 1e-6;
  return std::ranges::any_of(rigid_, [&](const RigidPart<dim>& part) {
    const auto rotations = part.loose.bottomRows(rigid_motions_of(dim) - dim);
    return (part.loose.cols() > 1 && !over_cycle) || rotations.norm() > rounding;
  });
}

template <int dim>
bool Settling<dim>::frees_placed() const {
  return std::ranges::any_of(rigid_, [&](const RigidPart<dim>& part) {
    const auto number =
        static_cast<std::size_t>(&body_of_part(parts_, part) - parts_.bodies.data());
    return part.loose.cols() > 0 && (!parts_.cycle || parts_.cycle->motion.bodies[number].moves());
  });
}

template <int dim>
bool Settling<dim>::is_driven() const {
  return load({}) > rounding_of_loads * foundation_.largest_load();
}

template <int dim>
void Settling<dim>::begin_again() {
  poses_.assign(rigid_.size(), Pose<dim>::Identity());
  turn_directions();
}

template <int dim>
Eigen::VectorXd Settling<dim>::along_free(const std::vector<Twist<dim>>& forces) const {
  Eigen::VectorXd result(unknowns_);
  Eigen::Index first = 0;
  for (std::size_t k = 0; k < rigid_.size(); ++k) {
    const Eigen::Index count = rigid_[k].loose.cols();
    result.segment(first, count) = rigid_[k].loose.transpose() * forces[k];
    first += count;
  }
  return result;
}

template <int dim>
Eigen::VectorXd Settling<dim>::resultant(const FoundationLaw& law, LoadTime at) {
  std::vector<Twist<dim>> forces = foundation_.loads(poses_, at);
  foundation_.add_contact(poses_, law, forces);
  return along_free(forces);
}

template <int dim>
std::vector<Twist<dim>> Settling<dim>::twists(const Eigen::VectorXd& by) const {
  std::vector<Twist<dim>> result;
  Eigen::Index first = 0;
  for (const RigidPart<dim>& part : rigid_) {
    result.push_back(part.loose * by.segment(first, part.loose.cols()));
    first += part.loose.cols();
  }
  return result;
}

template <int dim>
void Settling<dim>::move(const Eigen::VectorXd& by) {
  const std::vector<Twist<dim>> twist = twists(by);
  for (std::size_t k = 0; k < rigid_.size(); ++k)
    if (rigid_[k].loose.cols() > 0)
      poses_[k] = moved_by<dim>(twist[k], rigid_[k].centre, rigid_[k].size) * poses_[k];
}

template <int dim>
Eigen::MatrixXd Settling<dim>::stiffness(const Eigen::VectorXd& R, const FoundationLaw& law,
                                         double h, LoadTime at) {
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

template <int dim>
void Settling<dim>::turn_directions() {
  std::vector<Vector<dim>> now(parts_.mesh.nodes.size());
  for (std::size_t k = 0; k < rigid_.size(); ++k)
    for (const int node : rigid_[k].nodes) now[static_cast<std::size_t>(node)] = place(k, node);
  for (RigidPart<dim>& part : rigid_)
    if (const Eigen::Index count = part.loose.cols(); count > 0)
      part.loose = loose_twists(parts_, part, now, count, springs_);
}

template <int dim>
bool Settling<dim>::rest(double depth, LoadTime at, double force) {
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

template <int dim>
bool Settling<dim>::settle(double depth, double pressure, LoadTime at) {
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

template <int dim>
bool Settling<dim>::is_wedged() {
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

template <int dim>
std::vector<NodalField<dim>> Settling<dim>::pressing() {
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

template <int dim>
typename Settling<dim>::Softest Settling<dim>::softest_motion(double depth) {
  const FoundationLaw law{stiffness_, smoothing * depth};
  const Eigen::MatrixXd K = stiffness(resultant(law, {}), law, far * depth, {});
  const Eigen::EigenSolver<Eigen::MatrixXd> modes(K);  // friction: it is not symmetric
  Eigen::Index least = 0;
  modes.eigenvalues().real().minCoeff(&least);
  return {modes.eigenvalues()[least].real() * size_ / load({}),
          described(twists(modes.eigenvectors().col(least).real()))};
}

template <int dim>
std::string Settling<dim>::described(const std::vector<Twist<dim>>& motion) const {
  const auto most = static_cast<std::size_t>(
      std::ranges::max_element(motion, {}, [](const auto& twist) { return twist.norm(); }) -
      motion.begin());
  return fmt::format("\"{}\" can {}", body_of_part(parts_, rigid_[most]).name,
                     description_of<dim>(motion[most], rigid_[most], parts_.section()));
}

template class Settling<2>;
template class Settling<3>;

}  // namespace gnomon
