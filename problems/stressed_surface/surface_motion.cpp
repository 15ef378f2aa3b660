#include "surface_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unsupported/Eigen/AutoDiff>

#include "configurational_force.hpp"
#include "harmonic_mesh.hpp"

namespace gnomon::stressed {

namespace {

template <int count>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>;

/// A variable of the derivative: the k-th of `count`.
template <int count>
Dual<count> variable(double value, int k) {
  return {value, count, k};
}

CellNodal<2> of_cell(const Mesh<2>::Cell& cell, const NodalField<2>& values) {
  CellNodal<2> result;
  for (int a = 0; a < 4; ++a) result.row(a) = values.row(cell[a]);
  return result;
}

int position(const SparsePattern& pattern, int row, int column) {
  return row >= 0 && column >= 0 ? pattern.find(row, column) : -1;
}

/// Derivatives of C by X, then by u: rows and columns 2 node + component.
Eigen::Matrix<double, 8, 16> force_derivative(const ElasticModuli& moduli, const CellNodal<2>& X,
                                              const CellNodal<2>& u) {
  CellNodal<2, Dual<16>> X_, u_;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 2; ++i) {
      X_(a, i) = variable<16>(X(a, i), 2 * a + i);
      u_(a, i) = variable<16>(u(a, i), 8 + 2 * a + i);
    }
  const CellNodal<2, Dual<16>> C = configurational_force<Dual<16>>(moduli, X_, u_);
  Eigen::Matrix<double, 8, 16> K;
  for (int a = 0; a < 4; ++a)
    for (int i = 0; i < 2; ++i) K.row(2 * a + i) = C(a, i).derivatives().transpose();
  return K;
}

/// Derivatives of -dX/dt by the positions of the patch (two columns for each of up to three nodes)
/// and, in the last two columns, by the elastic gradient.
Eigen::Matrix<double, 2, 8> motion_derivative(const SurfaceLaw& law, const ContactPatch<2>& patch,
                                              const PatchNodal<2>& X, const Vector<2>& elastic) {
  PatchNodal<2, Dual<8>> X_(X.rows(), 2);
  for (int k = 0; k < X.rows(); ++k)
    for (int i = 0; i < 2; ++i) X_(k, i) = variable<8>(X(k, i), 2 * k + i);
  const Vector<2, Dual<8>> g(variable<8>(elastic[0], 6), variable<8>(elastic[1], 7));
  const SurfaceNode<Dual<8>> node(law, patch, X_, g);
  Eigen::Matrix<double, 2, 8> K;
  for (int i = 0; i < 2; ++i)
    K.row(i) = -Dual<8>(node.rate * node.normal[i]).derivatives().transpose();
  return K;
}

}  // namespace

SurfaceMotion::SurfaceMotion(const StressedBody& body, const StressedFields& fields,
                             const Numbering& numbering)
    : body_(body),
      fields_(fields),
      d_(numbering.nodal<2>(fields.d)),
      on_surface_(body.mesh.nodes.size(), -1) {
  rows_ = NodalNumbers<2>::Constant(d_.rows(), 2, -1);
  if (body.elastic) u_ = numbering.nodal<2>(fields.u), rows_ = p_ = numbering.nodal<2>(fields.p);
  for (std::size_t c = 0; c < body.surface.size(); ++c) {
    const int node = body.surface[c].node;
    on_surface_[node] = static_cast<int>(c);
    rows_.row(node) = d_.row(node);
    moves_ = moves_ || d_.row(node).maxCoeff() >= 0;
  }
  if (!body.elastic) return;
  for (std::size_t e = 0; e < body.mesh.cells.size(); ++e)
    if (std::ranges::any_of(cell_rows(body.mesh.cells[e]), [](int row) { return row >= 0; }))
      cells_.push_back(static_cast<int>(e));
}

std::vector<int> SurfaceMotion::cell_rows(const Mesh<2>::Cell& cell) const {
  std::vector<int> rows;
  for (int node : cell)
    for (int i = 0; i < 2; ++i) rows.push_back(rows_(node, i));
  return rows;
}

std::vector<int> SurfaceMotion::cell_columns(const Mesh<2>::Cell& cell) const {
  std::vector<int> result;
  for (const NodalNumbers<2>* numbers : {&d_, &u_, &p_})
    for (int node : cell)
      for (int i = 0; i < 2; ++i) result.push_back((*numbers)(node, i));
  return result;
}

std::vector<int> SurfaceMotion::patch_columns(const ContactPatch<2>& patch) const {
  std::vector<int> result;
  for (int node : patch.nodes)
    for (int i = 0; i < 2; ++i) result.push_back(d_(node, i));
  return result;
}

void SurfaceMotion::declare(TermStructure& structure) const {
  for (int e : cells_) {
    const Mesh<2>::Cell& cell = body_.mesh.cells[e];
    structure.pattern.add(cell_rows(cell), cell_columns(cell));
  }
  for (const ContactPatch<2>& patch : body_.surface)
    structure.pattern.add({d_(patch.node, 0), d_(patch.node, 1)}, patch_columns(patch));
}

void SurfaceMotion::map_to(const SparsePattern& pattern) {
  map_.clear();
  patch_map_.clear();
  for (int e : cells_) {
    const std::vector<int> numbers = cell_columns(body_.mesh.cells[e]);
    for (int row : cell_rows(body_.mesh.cells[e]))
      for (int column : numbers) map_.push_back(position(pattern, row, column));
  }
  for (const ContactPatch<2>& patch : body_.surface) {
    std::vector<int>& map = patch_map_.emplace_back();
    const std::vector<int> numbers = patch_columns(patch);
    for (int i = 0; i < 2; ++i)
      for (int column : numbers) map.push_back(position(pattern, d_(patch.node, i), column));
  }
}

PatchNodal<2> SurfaceMotion::positions(const ContactPatch<2>& patch, const NodalField<2>& d) const {
  PatchNodal<2> X(patch.nodes.size(), 2);
  for (std::size_t k = 0; k < patch.nodes.size(); ++k)
    X.row(static_cast<Eigen::Index>(k)) =
        body_.mesh.nodes[patch.nodes[k]].transpose() + d.row(patch.nodes[k]);
  return X;
}

/// C + K p at the nodes of the cells with a row.
NodalField<2> SurfaceMotion::elastic_gradient(const FieldValues<2>& values) const {
  const NodalField<2>& d = values.vector(fields_.d);
  NodalField<2> G = NodalField<2>::Zero(d.rows(), 2);
  for (int e : cells_) {
    const Mesh<2>::Cell& cell = body_.mesh.cells[e];
    const CellNodal<2> initial = body_.mesh.positions(cell);
    const CellNodal<2> C =
        configurational_force<>(*body_.elastic, CellNodal<2>(initial + of_cell(cell, d)),
                                of_cell(cell, values.vector(fields_.u))) +
        harmonic_matrix(body_.mesh_weights, initial) * of_cell(cell, values.vector(fields_.p));
    for (int a = 0; a < 4; ++a) G.row(cell[a]) += C.row(a);
  }
  return G;
}

std::vector<SurfaceNode<>> SurfaceMotion::nodes(const FieldValues<2>& values) const {
  const NodalField<2> G = elastic_gradient(values);
  std::vector<SurfaceNode<>> result;
  for (const ContactPatch<2>& patch : body_.surface)
    result.emplace_back(body_.law, patch, positions(patch, values.vector(fields_.d)),
                        G.row(patch.node).transpose());
  return result;
}

/// Where facets turn by 14 degrees at a node, the radius of curvature is about that of four
/// elements: less is not resolved, and the cusp would seem to be late. The velocity at a tip of
/// radius r is proportional to 1/r, by its stress and by its curvature: then r^2 decreases linearly
/// in time, as for a shrinking circle, and vanishes r / (2 |dr/dt|) from now.
void SurfaceMotion::require_no_cusp(const std::vector<SurfaceNode<>>& nodes, const NodalField<2>& d,
                                    double t) const {
  constexpr double sharpest = 0.125, small = 1e-6;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    if (nodes[c].turn > -sharpest) continue;
    const ContactPatch<2>& patch = body_.surface[c];
    const PatchNodal<2> X = positions(patch, d);
    PatchNodal<2> rate(X.rows(), 2);
    for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
      const SurfaceNode<>& at = nodes[on_surface_[patch.nodes[k]]];
      rate.row(static_cast<Eigen::Index>(k)) = at.rate * at.normal.transpose();
    }
    const double dt = small * nodes[c].length / rate.norm(), curvature = nodes[c].curvature;
    const double later =
        SurfaceNode<>(body_.law, patch, X + dt * rate, Vector<2>::Zero()).curvature;
    const double left = curvature * dt / (2 * (later - curvature));
    const std::string where = fmt::format("({:.4g}, {:.4g})", X(0, 0), X(0, 1));
    if (!(left > 0))
      throw RecoverableError(
          fmt::format("the surface is notched at {}, by more than the mesh can show", where));
    throw RecoverableError(
        fmt::format("the surface sharpens to a cusp at {}, where its radius of curvature, {:.3g} "
                    "mm, is that of four elements and vanishes at about t = {:.4g} s",
                    where, -1 / curvature, t + left));
  }
}

void SurfaceMotion::add_residual(const Evaluation<2>& at, std::span<double> F) const {
  if (cells_.empty() && !moves_) return;
  const NodalField<2>& d = at.values.vector(fields_.d);
  const NodalField<2> G = elastic_gradient(at.values);
  for (Eigen::Index node = 0; node < rows_.rows(); ++node)
    for (int i = 0; i < 2; ++i)
      if (on_surface_[node] < 0 && rows_(node, i) >= 0) F[rows_(node, i)] += G(node, i);
  if (!moves_) return;
  std::vector<SurfaceNode<>> nodes;
  for (const ContactPatch<2>& patch : body_.surface) {
    const SurfaceNode<>& node =
        nodes.emplace_back(body_.law, patch, positions(patch, d), G.row(patch.node).transpose());
    for (int i = 0; i < 2; ++i)
      if (const int row = rows_(patch.node, i); row >= 0) F[row] -= node.rate * node.normal[i];
  }
  require_no_cusp(nodes, d, at.t);
}

void SurfaceMotion::add_jacobian(const Evaluation<2>& at, double, std::span<double> values) const {
  const NodalField<2>& d = at.values.vector(fields_.d);
  std::vector<Tensor<2>> by_gradient(body_.surface.size(), Tensor<2>::Zero());
  if (moves_) {
    const NodalField<2> G = elastic_gradient(at.values);
    for (std::size_t c = 0; c < body_.surface.size(); ++c) {
      const ContactPatch<2>& patch = body_.surface[c];
      const Eigen::Matrix<double, 2, 8> K =
          motion_derivative(body_.law, patch, positions(patch, d), G.row(patch.node).transpose());
      by_gradient[c] = K.rightCols<2>();
      const std::vector<int>& map = patch_map_[c];
      const auto width = static_cast<int>(map.size() / 2);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < width; ++j)
          if (map[i * width + j] >= 0) values[map[i * width + j]] += K(i, j);
    }
  }
  const int* place = map_.data();
  for (int e : cells_) {
    const Mesh<2>::Cell& cell = body_.mesh.cells[e];
    const CellNodal<2> initial = body_.mesh.positions(cell);
    Eigen::Matrix<double, local, columns> K;
    K.leftCols<16>() = force_derivative(*body_.elastic, initial + of_cell(cell, d),
                                        of_cell(cell, at.values.vector(fields_.u)));
    const Eigen::Matrix4d motion = harmonic_matrix(body_.mesh_weights, initial);
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        K.block<2, 2>(2 * a, 16 + 2 * b) = motion(a, b) * Tensor<2>::Identity();
    for (int a = 0; a < 4; ++a)
      if (const int c = on_surface_[cell[a]]; c >= 0)
        K.middleRows<2>(2 * a) = (by_gradient[c] * K.middleRows<2>(2 * a)).eval();
    for (int i = 0; i < local; ++i)
      for (int j = 0; j < columns; ++j, ++place)
        if (*place >= 0) values[*place] += K(i, j);
  }
}

}  // namespace gnomon::stressed
