// The part of a model that follows from its composition of fields and terms and from its mesh, for
// every physics. What remains to a physics: observe(), differential_scale(), fields(), contact(),
// exact().
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/system/composed_system.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// In 2D, z is zero.
template <int dim>
std::array<double, 3> point_in_space(const Vector<dim>& v) {
  std::array<double, 3> point{};
  std::copy(v.begin(), v.end(), point.begin());
  return point;
}

template <int dim>
std::vector<std::array<double, 3>> points_in_space(const std::vector<Vector<dim>>& points) {
  std::vector<std::array<double, 3>> result;
  for (const Vector<dim>& X : points) result.push_back(point_in_space<dim>(X));
  return result;
}

/// A vector of every node, for files.
template <int dim>
GridField nodal_field(const std::string& name, const NodalField<dim>& values) {
  GridField field{name, "mm", GridField::On::nodes, 3, {}};
  field.values.assign(3 * values.rows(), 0.0);
  for (Eigen::Index node = 0; node < values.rows(); ++node)
    for (int i = 0; i < dim; ++i) field.values[3 * node + i] = values(node, i);
  return field;
}

template <int dim>
class ComposedModel : public Model {
public:
  /// `mesh` must outlive the model.
  ComposedModel(std::shared_ptr<const Composition<dim>> composition, const Mesh<dim>& mesh)
      : mesh_(mesh), system_(std::move(composition)) {}

  const ComposedSystem<dim>& system() const override { return system_; }

  /// Blocks of one name are listed as one.
  std::vector<BlockSize> blocks() const override {
    const Structure& structure = system_.structure();
    std::vector<BlockSize> sizes;
    for (const Block& block : structure.blocks)
      if (std::ranges::find(sizes, block.name, &BlockSize::name) == sizes.end())
        sizes.push_back({block.name, block.symbol, 0, block.where});
    for (int block : structure.block)
      ++std::ranges::find(sizes, structure.blocks[block].name, &BlockSize::name)->size;
    return sizes;
  }

  /// From zero, by the algebraic stages.
  State start(Counters& counters) const override {
    State state{0, std::vector<double>(system_.structure().size, 0.0), {}};
    const std::string reason = AlgebraicSolver(system_, counters).solve(0, state.y);
    if (!reason.empty()) throw SolutionError("no equilibrium at t = 0: " + reason);
    set_rates(system_, nullptr, state);
    return state;
  }

  std::optional<Grid> grid() const override {
    Grid grid;
    grid.cell = dim == 2 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
    grid.points = points_in_space<dim>(mesh_.nodes);
    for (const auto& cell : mesh_.cells)
      grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
    return grid;
  }

private:
  const Mesh<dim>& mesh_;
  ComposedSystem<dim> system_;
};

}  // namespace gnomon
