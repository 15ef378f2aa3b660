#include "model/rigid_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/spectrum.hpp"
#include "model/connected_parts.hpp"

namespace gnomon {

template <int dim>
Eigen::Matrix<double, dim, rigid_motions_of(dim)> rigid_velocities(const Vector<dim>& x,
                                                                   const Vector<dim>& centre,
                                                                   double size) {
  Eigen::Matrix<double, dim, rigid_motions_of(dim)> velocities;
  velocities.setZero();
  velocities.template leftCols<dim>().setIdentity();
  const Vector<dim> arm = (x - centre) / size;
  if constexpr (dim == 2)
    velocities.col(2) << -arm[1], arm[0];
  else
    for (int axis = 0; axis < 3; ++axis)
      velocities.col(3 + axis) = Vector<3>::Unit(axis).cross(arm);
  return velocities;
}

template <int dim>
Eigen::Transform<double, dim, Eigen::Affine> moved_by(const Twist<dim>& twist,
                                                      const Vector<dim>& centre, double size) {
  // The exponential of the twist (Rodrigues' formula): a body that turns about a held point keeps
  // it.
  const Vector<dim> origin = rigid_velocities<dim>(Vector<dim>::Zero(), centre, size) * twist;
  Tensor<dim> spin;
  for (int i = 0; i < dim; ++i)
    spin.col(i) = rigid_velocities<dim>(Vector<dim>::Unit(i), centre, size) * twist - origin;
  const auto sinc = [](double angle) { return angle == 0 ? 1 : std::sin(angle) / angle; };
  const Tensor<dim> twice = spin * spin, one = Tensor<dim>::Identity();
  const double angle = spin.norm() / std::sqrt(2.0), half = sinc(angle / 2);
  const double third = angle < 1e-4 ? 1.0 / 6 : (1 - sinc(angle)) / (angle * angle);
  Eigen::Transform<double, dim, Eigen::Affine> moved;
  moved.linear() = one + sinc(angle) * spin + half * half / 2 * twice;
  moved.translation() = (one + half * half / 2 * spin + third * twice) * origin;
  moved.makeAffine();
  return moved;
}

template <int dim>
SpringsHold springs_hold(const AssemblyParts<dim>& parts) {
  return std::ranges::all_of(parts.supports.springs,
                             [](const auto& each) { return each.displacement.isZero(0); })
             ? SpringsHold::yes
             : SpringsHold::no;
}

template <int dim>
Eigen::MatrixXd resisted(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                         const std::vector<Vector<dim>>& x, SpringsHold springs) {
  constexpr int motions = rigid_motions_of(dim);
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(motions, motions);
  if (dim == 2 && parts.section() == Section::meridian)  // it moves along the axis alone
    held(0, 0) = held(motions - 1, motions - 1) = 1;
  const auto hold = [&](int node, int i) {
    const Eigen::VectorXd row =
        rigid_velocities<dim>(x[node], part.centre, part.size).row(i).transpose();
    held += row * row.transpose();
  };
  for (const int node : part.nodes)
    for (int i = 0; i < dim; ++i)
      if (parts.supports.held(node, i)) hold(node, i);
  if (springs == SpringsHold::no) return held;
  for (const SpringSupport<dim>& support : parts.supports.springs)
    for (const auto& facet : support.facets)
      for (const int node : facet)
        for (int i = 0; i < dim; ++i)
          if (part.has(node) && support.stiffness[i] > 0) hold(node, i);
  return held;
}

template <int dim>
Eigen::MatrixXd loose_twists(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                             const std::vector<Vector<dim>>& x, Eigen::Index count,
                             SpringsHold springs) {
  return spectrum_of(resisted(parts, part, x, springs)).vectors.leftCols(count);
}

template <int dim>
std::vector<RigidPart<dim>> rigid_parts(const AssemblyParts<dim>& parts,
                                        const std::vector<Vector<dim>>& x, SpringsHold springs) {
  constexpr double nothing = 1e-9;
  const std::vector<int> number = connected_parts(parts.mesh);
  std::vector<RigidPart<dim>> result;
  for (std::size_t node = 0; node < number.size(); ++node) {
    auto at = std::ranges::find(result, number[node], &RigidPart<dim>::number);
    if (at == result.end()) {
      at = result.emplace(result.end());
      at->number = number[node];
    }
    at->nodes.push_back(static_cast<int>(node));
  }
  for (RigidPart<dim>& part : result) {
    part.centre.setZero();
    for (const int node : part.nodes)
      part.centre += x[node] / static_cast<double>(part.nodes.size());
    for (const int node : part.nodes)
      part.size = std::max(part.size, (x[node] - part.centre).norm());
    const Spectrum spectrum = spectrum_of(resisted(parts, part, x, springs));
    const double most = std::max(1.0, spectrum.values.maxCoeff());
    part.loose = spectrum.vectors.leftCols((spectrum.values.array() <= nothing * most).count());
  }
  return result;
}

template <int dim>
const Body& body_of_part(const AssemblyParts<dim>& parts, const RigidPart<dim>& part) {
  const std::vector<int> body_of =
      body_of_nodes(parts.mesh, body_of_cells(parts.bodies, parts.mesh.cells.size()));
  const int body = body_of[static_cast<std::size_t>(part.nodes.front())];
  return parts.bodies[static_cast<std::size_t>(body)];
}

namespace {

/// A point to four digits, and not finer than a thousandth of the part.
template <int dim>
std::string rounded(const Vector<dim>& point, double size) {
  const double unit = std::pow(10, std::floor(std::log10(size)) - 3);
  std::vector<std::string> numbers;
  for (const double x : point)
    numbers.push_back(fmt::format("{:.4g}", std::round(x / unit) * unit + 0.0));
  return fmt::format("({})", fmt::join(numbers, ", "));
}

}  // namespace

template <int dim>
std::string description_of(const Twist<dim>& twist, const RigidPart<dim>& part, Section section) {
  constexpr double far = 3;  // in sizes: a rotation about a point farther away moves the body
  const Vector<dim> along = twist.template head<dim>();
  if (dim == 2 && section == Section::meridian) return "move along z";
  const auto direction = [](const Vector<dim>& e) {
    constexpr double oblique = 0.02;
    for (int i = 0; i < dim; ++i)
      if (std::abs(e[i]) > (1 - oblique * oblique) * e.norm()) return std::string(1, "xyz"[i]);
    const Vector<dim> unit = e.normalized();
    return dim == 2 ? fmt::format("({:.2f}, {:.2f})", unit[0], unit[1])
                    : fmt::format("({:.2f}, {:.2f}, {:.2f})", unit[0], unit[1], unit[dim - 1]);
  };
  if constexpr (dim == 2) {
    const double rotation = twist[2] / part.size;
    if (std::abs(twist[2]) * far < along.norm()) return "move along " + direction(along);
    const Vector<2> point = part.centre + Vector<2>(-along[1], along[0]) / rotation;
    return "turn about " + rounded(point, part.size);
  } else {
    const Vector<3> rotation = twist.template tail<3>() / part.size;
    if (rotation.norm() * part.size * far < along.norm()) return "move along " + direction(along);
    const Vector<3> point = part.centre + rotation.cross(along) / rotation.squaredNorm();
    return fmt::format("turn about {} through {}", direction(rotation), rounded(point, part.size));
  }
}

template <int dim>
std::string free_rotation_of(const RigidPart<dim>& part, Section section) {
  constexpr double rounding = 1e-6;
  const Eigen::MatrixXd rotations = part.loose.bottomRows(rigid_motions_of(dim) - dim);
  if (rotations.norm() <= rounding) return "";
  const Spectrum spectrum = spectrum_of(rotations.transpose() * rotations);
  const Twist<dim> most = part.loose * spectrum.vectors.rightCols(1);
  return description_of<dim>(most, part, section);
}

template <int dim>
std::string free_motions_of(const RigidPart<dim>& part, Section section) {
  constexpr double rounding = 1e-6;
  std::vector<std::string> directions;
  for (int i = 0; i < dim; ++i) {
    const Twist<dim> along = Twist<dim>::Unit(i);
    if ((part.loose * (part.loose.transpose() * along) - along).norm() < rounding)
      directions.emplace_back(1, dim == 2 && section == Section::meridian ? "rz"[i] : "xyz"[i]);
  }
  const auto moves = static_cast<Eigen::Index>(directions.size());
  if (moves == 0) return description_of<dim>(part.loose.col(0), part, section);
  // About any point where translations are free.
  return fmt::format("move along {}{}", fmt::join(directions, ", "),
                     part.loose.cols() > moves ? " and turn" : "");
}

template const Body& body_of_part(const AssemblyParts<2>&, const RigidPart<2>&);
template const Body& body_of_part(const AssemblyParts<3>&, const RigidPart<3>&);
template std::string free_rotation_of(const RigidPart<2>&, Section);
template std::string free_rotation_of(const RigidPart<3>&, Section);
template std::string free_motions_of(const RigidPart<2>&, Section);
template std::string free_motions_of(const RigidPart<3>&, Section);
template Eigen::Matrix<double, 2, 3> rigid_velocities<2>(const Vector<2>&, const Vector<2>&,
                                                         double);
template Eigen::Matrix<double, 3, 6> rigid_velocities<3>(const Vector<3>&, const Vector<3>&,
                                                         double);
template Eigen::Transform<double, 2, Eigen::Affine> moved_by<2>(const Twist<2>&, const Vector<2>&,
                                                                double);
template Eigen::Transform<double, 3, Eigen::Affine> moved_by<3>(const Twist<3>&, const Vector<3>&,
                                                                double);
template SpringsHold springs_hold(const AssemblyParts<2>&);
template SpringsHold springs_hold(const AssemblyParts<3>&);
template Eigen::MatrixXd resisted(const AssemblyParts<2>&, const RigidPart<2>&,
                                  const std::vector<Vector<2>>&, SpringsHold);
template Eigen::MatrixXd resisted(const AssemblyParts<3>&, const RigidPart<3>&,
                                  const std::vector<Vector<3>>&, SpringsHold);
template Eigen::MatrixXd loose_twists(const AssemblyParts<2>&, const RigidPart<2>&,
                                      const std::vector<Vector<2>>&, Eigen::Index, SpringsHold);
template Eigen::MatrixXd loose_twists(const AssemblyParts<3>&, const RigidPart<3>&,
                                      const std::vector<Vector<3>>&, Eigen::Index, SpringsHold);
template std::vector<RigidPart<2>> rigid_parts(const AssemblyParts<2>&,
                                               const std::vector<Vector<2>>&, SpringsHold);
template std::vector<RigidPart<3>> rigid_parts(const AssemblyParts<3>&,
                                               const std::vector<Vector<3>>&, SpringsHold);
template std::string description_of(const Twist<2>&, const RigidPart<2>&, Section);
template std::string description_of(const Twist<3>&, const RigidPart<3>&, Section);

}  // namespace gnomon
