#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <gnomon/results/surface_difference.hpp>
#include <limits>
#include <numeric>

#include "base/spectrum.hpp"

namespace gnomon {

namespace {

Eigen::Vector3d vector_of(const std::array<double, 3>& point) {
  return {point[0], point[1], point[2]};
}

Eigen::Vector3d wear_of(const ContactSurface& surface, std::size_t node) {
  return vector_of(surface.worn[node]) - vector_of(surface.initial[node]);
}

/// Of the body that a node of a surface belongs to.
int body_at(const ContactSurface& surface, std::size_t node) {
  return surface.body.empty() ? 0 : surface.body[node];
}

/// Those of one body: surfaces of others may lie at the same place.
std::vector<std::size_t> nearest_nodes(const ContactSurface& surface, const Eigen::Vector3d& x,
                                       int body, std::size_t count) {
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < surface.initial.size(); ++i)
    if (body_at(surface, i) == body) nodes.push_back(i);
  count = std::min(count, nodes.size());
  std::ranges::partial_sort(
      nodes, nodes.begin() + static_cast<long>(count), {},
      [&](std::size_t i) { return (vector_of(surface.initial[i]) - x).squaredNorm(); });
  nodes.resize(count);
  return nodes;
}

Eigen::Vector4d values_of(const ContactSurface& surface, std::size_t node) {
  Eigen::Vector4d values;
  values << wear_of(surface, node), surface.pressure[node];
  return values;
}

/// The change of shape and the pressure at any place of the initial surface: those of a node there,
/// or linear through the nodes nearest to it, by least squares with weights.
Eigen::Vector4d values_at(const ContactSurface& surface, const Eigen::Vector3d& x, int body) {
  constexpr double same_place = 1e-9, nearest_weight = 1e3;
  const std::vector<std::size_t> nodes = nearest_nodes(surface, x, body, surface.dim == 2 ? 2 : 6);
  if (nodes.empty()) return Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto apart = [&](std::size_t i) -> Eigen::Vector3d {
    return vector_of(surface.initial[i]) - x;
  };
  const double size = apart(nodes.back()).norm() + std::numeric_limits<double>::min();
  if (apart(nodes.front()).norm() < same_place * size) return values_of(surface, nodes.front());
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(4, 4), values = Eigen::MatrixXd::Zero(4, 4);
  for (const std::size_t i : nodes) {
    Eigen::Vector4d row;
    row << 1, apart(i) / size;
    const double weight = 1 / (row.tail<3>().squaredNorm() + 1 / nearest_weight);
    moments += weight * row * row.transpose();
    values += weight * row * values_of(surface, i).transpose();
  }
  const double scale = moments(0, 0);
  return (pseudo_inverse(moments / scale, 1e-4) * (values / scale)).row(0).transpose();
}

/// The projection on the tangents of the initial surface at a node.
Eigen::Matrix3d tangents_at(const ContactSurface& surface, std::size_t node) {
  const std::vector<std::size_t> nodes = nearest_nodes(
      surface, vector_of(surface.initial[node]), body_at(surface, node), surface.dim == 2 ? 3 : 9);
  Eigen::Vector3d middle(0, 0, 0);
  for (const std::size_t i : nodes)
    middle += vector_of(surface.initial[i]) / static_cast<double>(nodes.size());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(3, 3);
  for (const std::size_t i : nodes) {
    const Eigen::Vector3d apart = vector_of(surface.initial[i]) - middle;
    spread += apart * apart.transpose();
  }
  const Eigen::MatrixXd vectors = spectrum_of(spread).vectors;
  const Eigen::Vector3d last = vectors.col(2), normal = vectors.col(0);
  return surface.dim == 2
             ? Eigen::Matrix3d(last * last.transpose())
             : Eigen::Matrix3d(Eigen::Matrix3d::Identity() - normal * normal.transpose());
}

/// How far the worn surface at a node lies from another one along the normal, whichever points of
/// the initial surface have come there: nodes of a mesh that follows the wear slide.
double distance_along_normal(const ContactSurface& surface, std::size_t node,
                             const ContactSurface& other) {
  const Eigen::Matrix3d tangents = tangents_at(surface, node);
  Eigen::Vector3d from = vector_of(surface.initial[node]);
  Eigen::Vector3d apart;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d there = from + values_at(other, from, body_at(surface, node)).head<3>();
    apart = vector_of(surface.worn[node]) - there;
    if (i < 2) from += tangents * apart;
  }
  return (apart - tangents * apart).norm();
}

double norm_of(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

}  // namespace

SurfaceDifference surface_difference(const ContactSurface& surface, const ContactSurface& other) {
  SurfaceDifference difference;
  for (std::size_t i = 0; i < surface.worn.size(); ++i) {
    difference.distance.push_back(distance_along_normal(surface, i, other));
    const double there = values_at(other, vector_of(surface.initial[i]), body_at(surface, i))[3];
    difference.pressure.push_back(surface.pressure[i] - there);
  }
  return difference;
}

double distance_error(const ContactSurface& surface, const ContactSurface& reference) {
  return norm_of(surface_difference(surface, reference).distance) *
         std::sqrt(static_cast<double>(reference.worn.size()) /
                   static_cast<double>(surface.worn.size()));
}

double shape_error(const ContactSurface& surface, const ContactSurface& reference) {
  if (surface.initial != reference.initial) return distance_error(surface, reference);
  double sum = 0;
  for (std::size_t i = 0; i < surface.worn.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sum += std::pow(surface.worn[i][k] - reference.worn[i][k], 2);
  return std::sqrt(sum);
}

double pressure_error(const ContactSurface& surface, const ContactSurface& reference) {
  std::vector<double> differences;
  if (surface.initial == reference.initial)
    std::ranges::transform(surface.pressure, reference.pressure, std::back_inserter(differences),
                           std::minus());
  else
    differences = surface_difference(surface, reference).pressure;
  double largest = 0;
  for (const double difference : differences) {
    if (std::isnan(difference)) return difference;
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

}  // namespace gnomon
