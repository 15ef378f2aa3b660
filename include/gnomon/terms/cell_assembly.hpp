// Gather and scatter of a solid term over the cells of a mesh, written once for the body (rows of
// u, derivatives with respect to u and d) and for the mesh motion (rows and derivatives of d only).
// Large meshes are assembled by all threads (OMP_NUM_THREADS); results do not depend on their
// number.
#pragma once

#include <gnomon/fields/field.hpp>
#include <gnomon/fields/sparse_pattern.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/terms/material.hpp>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

template <int dim>
class CellAssembly {
public:
  using Numbers = NodalNumbers<dim>;

  /// `bodies`: together all cells, each once (one body without cells: all). `rows`, `columns`:
  /// numbers of the residual rows and of the unknown that is the displacement here.
  /// `shape_columns`: numbers of the shape unknowns that move the reference configuration, empty
  /// when it does not move. `stiffness`: factors of the moduli, one per cell; none: 1. `along`: the
  /// nodes that keep to planes or lines, with the projectors P on them; with N = 1 - P their
  /// equations are P R(P u) + k N u = 0, of which P K P + k N is the derivative: equilibrium along,
  /// no displacement across. k is a stiffness of the cells. Null: no node does. Cells without a row
  /// are left out. Mesh and projectors must outlive the object.
  CellAssembly(const Mesh<dim>& mesh, const std::vector<Body>& bodies, Numbers rows,
               Numbers columns, Numbers shape_columns = {}, std::vector<double> stiffness = {},
               const NodalProjectors<dim>* along = nullptr);

  void add_to_pattern(PatternBuilder& builder) const;
  /// Computes the scatter map; call once, after the pattern is built.
  void map_to(const SparsePattern& pattern);

  /// F += R; `shape` may be null (reference = initial configuration).
  /// Throws RecoverableError naming the first inverted cell.
  void add_residual(const NodalField<dim>* shape, const NodalField<dim>& displacement,
                    std::span<double> F) const;
  void add_jacobian(const NodalField<dim>* shape, const NodalField<dim>& displacement,
                    std::span<double> values) const;

private:
  static constexpr int local = dim * (1 << dim);  // values per cell

  struct Elastic {  // what a body is made of
    ElasticModuli moduli;
    CellKernel<dim> kernel;
    std::string name;  // for messages; empty: the only body
  };
  const Elastic& elastic(int cell) const { return bodies_[body_of_.empty() ? 0 : body_of_[cell]]; }
  ElasticModuli moduli_of(int cell) const;
  bool moves() const { return shape_columns_.size() > 0; }
  void cell_numbers(int cell, const Numbers& numbers, std::vector<int>& result) const;
  void gather(int cell, const NodalField<dim>* shape, const NodalField<dim>& displacement,
              CellNodal<dim>& X, CellNodal<dim>& u) const;
  [[noreturn]] void throw_inverted(int cell, const NodalField<dim>* shape) const;
  void fill_map(const SparsePattern& pattern, const Numbers& columns, std::vector<int>& map) const;

  const Mesh<dim>& mesh_;
  std::vector<Elastic> bodies_;
  std::vector<int> body_of_;  // per cell; empty: the only one
  std::vector<double> stiffness_;
  Numbers rows_, columns_;
  Numbers shape_columns_;  // empty: the reference does not move, or is frozen
  const NodalProjectors<dim>* along_;
  std::vector<char> keeps_;           // per cell with a row: 1 where a node is in `along`
  std::vector<int> cells_;            // cells with at least one row
  std::size_t size_ = 0;              // of the matrix
  std::vector<int> map_, shape_map_;  // local*local positions per cell, column by column; -1: none
};

}  // namespace gnomon
