// The motion of a free surface down the gradient of the body's energy
//
//   E(u, X) = elastic energy - work of loads + gamma length - w0 area,   X = X^ + d.
//
// In equilibrium dE/du = 0. The nodes inside follow the surface by the mesh motion, which is linear
// here (harmonic_mesh.hpp): K_ii d_i + K_is d_s = 0. So E depends on the surface alone, and its
// gradient there, with C = dE_el/dX (configurational_force.hpp), is
//
//   g_s = C_s + K_si p + gamma dL/dX - w0 dV/dX,   K_ii p = -C_i.
//
// C_i, the forces on nodes inside, vanish as the mesh is refined; p carries what is left of them to
// the surface. With ddot = -m (N . g_s) N / M (SurfaceNode) the semi-discrete energy decreases:
// dE/dt = -sum m (N . g_s)^2 / M, exactly, and a smooth mode of the surface grows by the second
// derivative of the discrete energy, whose error is of second order in the size of the elements.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/fields/numbering.hpp>
#include <gnomon/terms/term.hpp>
#include <unsupported/Eigen/AutoDiff>

#include "configurational_force.hpp"
#include "harmonic_mesh.hpp"
#include "stressed_body.hpp"

namespace gnomon::stressed {

/// The fields of a stressed body, at all nodes of the mesh.
struct StressedFields {
  FieldId u = FieldId::none;  ///< displacement; none where the body is not elastic
  FieldId d = FieldId::none;  ///< shape; differential on the surface
  FieldId p = FieldId::none;  ///< adjoint of the mesh motion, zero on the boundary; none without u
};

template <int count>
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, count, 1>>;

/// A variable of the derivative: the k-th of `count`.
template <int count>
Dual<count> variable(double value, int k) {
  return {value, count, k};
}

inline CellNodal<2> of_cell(const Mesh<2>::Cell& cell, const NodalField<2>& values) {
  CellNodal<2> result;
  for (int a = 0; a < 4; ++a) result.row(a) = values.row(cell[a]);
  return result;
}

/// Derivatives of C by X, then by u: rows and columns 2 node + component.
inline Eigen::Matrix<double, 8, 16> force_derivative(const ElasticModuli& moduli,
                                                     const CellNodal<2>& X, const CellNodal<2>& u) {
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
inline Eigen::Matrix<double, 2, 8> motion_derivative(const SurfaceLaw& law,
                                                     const ContactPatch<2>& patch,
                                                     const PatchNodal<2>& X,
                                                     const Vector<2>& elastic) {
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

/// C + K p in the rows of p, and m (N . g_s) N / M in those of d on the surface.
class SurfaceMotion : public Term<2> {
public:
  /// `body` must outlive the term.
  SurfaceMotion(const StressedBody& body, const StressedFields& fields, const Numbering& numbering)
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

  void declare(TermStructure& structure) const override {
    for (int e : cells_) {
      const Mesh<2>::Cell& cell = body_.mesh.cells[e];
      structure.pattern.add(cell_rows(cell), cell_columns(cell));
    }
    for (const ContactPatch<2>& patch : body_.surface)
      structure.pattern.add({d_(patch.node, 0), d_(patch.node, 1)}, patch_columns(patch));
  }

  void map_to(const SparsePattern& pattern) override {
    map_.clear();
    patch_map_.clear();
    for (int e : cells_) {
      const Mesh<2>::Cell& cell = body_.mesh.cells[e];
      map_.push_back(pattern.positions(cell_rows(cell), cell_columns(cell)));
    }
    for (const ContactPatch<2>& patch : body_.surface)
      patch_map_.push_back(
          pattern.positions({d_(patch.node, 0), d_(patch.node, 1)}, patch_columns(patch)));
  }

  /// Throws RecoverableError also where the surface is as sharp as the mesh can show, with an
  /// estimate of the time of the cusp.
  void add_residual(const Evaluation<2>& at, std::span<double> F) const override {
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

  void add_jacobian(const Evaluation<2>& at, double, std::span<double> values) const override {
    const NodalField<2>& d = at.values.vector(fields_.d);
    std::vector<Tensor<2>> by_gradient(body_.surface.size(), Tensor<2>::Zero());
    if (moves_) {
      const NodalField<2> G = elastic_gradient(at.values);
      for (std::size_t c = 0; c < body_.surface.size(); ++c) {
        const ContactPatch<2>& patch = body_.surface[c];
        const Eigen::Matrix<double, 2, 8> K =
            motion_derivative(body_.law, patch, positions(patch, d), G.row(patch.node).transpose());
        by_gradient[c] = K.rightCols<2>();
        for (std::size_t k = 0; k < patch_map_[c].size(); ++k)
          if (const int place = patch_map_[c][k]; place >= 0) values[place] += K.data()[k];
      }
    }

    for (std::size_t k = 0; k < cells_.size(); ++k) {
      const Mesh<2>::Cell& cell = body_.mesh.cells[cells_[k]];
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
      for (std::size_t m = 0; m < map_[k].size(); ++m)
        if (const int place = map_[k][m]; place >= 0) values[place] += K.data()[m];
    }
  }

  /// The law at every node of the surface.
  std::vector<SurfaceNode<>> nodes(const FieldValues<2>& values) const {
    const NodalField<2> G = elastic_gradient(values);
    std::vector<SurfaceNode<>> result;
    for (const ContactPatch<2>& patch : body_.surface)
      result.emplace_back(body_.law, patch, positions(patch, values.vector(fields_.d)),
                          G.row(patch.node).transpose());
    return result;
  }

private:
  /// Columns of a cell: d, then u, then p, node by node.
  static constexpr int local = 8, columns = 3 * local;

  std::vector<int> cell_rows(const Mesh<2>::Cell& cell) const {
    std::vector<int> rows;
    for (int node : cell)
      for (int i = 0; i < 2; ++i) rows.push_back(rows_(node, i));
    return rows;
  }
  std::vector<int> cell_columns(const Mesh<2>::Cell& cell) const {
    std::vector<int> result;
    for (const NodalNumbers<2>* numbers : {&d_, &u_, &p_})
      for (int node : cell)
        for (int i = 0; i < 2; ++i) result.push_back((*numbers)(node, i));
    return result;
  }
  std::vector<int> patch_columns(const ContactPatch<2>& patch) const {
    std::vector<int> result;
    for (int node : patch.nodes)
      for (int i = 0; i < 2; ++i) result.push_back(d_(node, i));
    return result;
  }
  PatchNodal<2> positions(const ContactPatch<2>& patch, const NodalField<2>& d) const {
    PatchNodal<2> X(patch.nodes.size(), 2);
    for (std::size_t k = 0; k < patch.nodes.size(); ++k)
      X.row(static_cast<Eigen::Index>(k)) =
          body_.mesh.nodes[patch.nodes[k]].transpose() + d.row(patch.nodes[k]);
    return X;
  }

  /// C + K p at the nodes of the cells with a row.
  NodalField<2> elastic_gradient(const FieldValues<2>& values) const {
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

  /// Where facets turn by 14 degrees at a node, the radius of curvature is about that of four
  /// elements: less is not resolved, and the cusp would seem to be late. The velocity at a tip of
  /// radius r is proportional to 1/r, by its stress and by its curvature: then r^2 decreases
  /// linearly in time, as for a shrinking circle, and vanishes r / (2 |dr/dt|) from now.
  void require_no_cusp(const std::vector<SurfaceNode<>>& nodes, const NodalField<2>& d,
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

  const StressedBody& body_;
  StressedFields fields_;
  NodalNumbers<2> rows_;  // of each node: those of p inside, those of d on the surface
  NodalNumbers<2> d_, u_, p_;
  std::vector<int> on_surface_;  // of each node: its place on the surface, -1: inside
  std::vector<int> cells_;       // with a row
  bool moves_ = false;           // the system has rows of d on the surface
  // Positions of each cell and of each surface node, column by column; -1: none.
  std::vector<std::vector<int>> map_, patch_map_;
};

}  // namespace gnomon::stressed
