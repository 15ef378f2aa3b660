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
// the surface. With ddot = -m (N . g_s) N / M (surface_law.hpp) the semi-discrete energy decreases:
// dE/dt = -sum m (N . g_s)^2 / M, exactly, and a smooth mode of the surface grows by the second
// derivative of the discrete energy, whose error is of second order in the size of the elements.
#pragma once

#include <gnomon/fields/numbering.hpp>
#include <gnomon/terms/term.hpp>

#include "stressed_body.hpp"

namespace gnomon::stressed {

/// The fields of a stressed body, at all nodes of the mesh.
struct StressedFields {
  FieldId u = FieldId::none;  ///< displacement; none where the body is not elastic
  FieldId d = FieldId::none;  ///< shape; differential on the surface
  FieldId p = FieldId::none;  ///< adjoint of the mesh motion, zero on the boundary; none without u
};

/// C + K p in the rows of p, and m (N . g_s) N / M in those of d on the surface.
class SurfaceMotion : public Term<2> {
public:
  /// `body` must outlive the term.
  SurfaceMotion(const StressedBody& body, const StressedFields& fields, const Numbering& numbering);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  /// Throws RecoverableError also where the surface is as sharp as the mesh can show, with an
  /// estimate of the time of the cusp.
  void add_residual(const Evaluation<2>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<2>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<2>&, std::span<double>) const override {}

  /// The law at every node of the surface.
  std::vector<SurfaceNode<>> nodes(const FieldValues<2>& values) const;

private:
  /// Columns of a cell: d, then u, then p, node by node.
  static constexpr int local = 8, columns = 3 * local;

  std::vector<int> cell_rows(const Mesh<2>::Cell& cell) const;
  std::vector<int> cell_columns(const Mesh<2>::Cell& cell) const;
  std::vector<int> patch_columns(const ContactPatch<2>& patch) const;
  PatchNodal<2> positions(const ContactPatch<2>& patch, const NodalField<2>& d) const;
  NodalField<2> elastic_gradient(const FieldValues<2>& values) const;
  void require_no_cusp(const std::vector<SurfaceNode<>>& nodes, const NodalField<2>& d,
                       double t) const;

  const StressedBody& body_;
  StressedFields fields_;
  NodalNumbers<2> rows_;  // of each node: those of p inside, those of d on the surface
  NodalNumbers<2> d_, u_, p_;
  std::vector<int> on_surface_;  // of each node: its place on the surface, -1: inside
  std::vector<int> cells_;       // with a row
  bool moves_ = false;           // the system has rows of d on the surface
  std::vector<int> map_;         // local * columns positions per cell, row by row; -1: none
  std::vector<std::vector<int>> patch_map_;  // 2 x 2 nodes positions per surface node
};

}  // namespace gnomon::stressed
