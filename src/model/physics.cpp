#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

namespace gnomon {

namespace {

std::vector<BlockSize> sizes_of(const Structure& structure) {
  std::vector<BlockSize> sizes;
  for (const Block& block : *structure.blocks)
    if (std::ranges::find(sizes, block.name, &BlockSize::name) == sizes.end())
      sizes.push_back({block.name, block.symbol, 0, block.where});
  for (long i = 0; i < structure.size; ++i)
    ++std::ranges::find(sizes, structure.block_of(i).name, &BlockSize::name)->size;
  return sizes;
}

}  // namespace

template <int dim>
Physics<dim>::Physics(std::shared_ptr<const Composition<dim>> composition, const Mesh<dim>& mesh)
    : system_(std::move(composition)) {
  blocks = sizes_of(system_.structure());
  grid = grid_of(mesh);
}

template <int dim>
State Physics<dim>::start(Counters& counters) const {
  State state{0, std::vector<double>(system_.structure().size, 0.0), {}};
  const std::string reason = AlgebraicSolver(system_, counters).solve(0, state.y);
  if (!reason.empty()) throw SolutionError("no equilibrium at t = 0: " + reason);
  set_rates(system_, nullptr, state);
  return state;
}

template class Physics<2>;
template class Physics<3>;

}  // namespace gnomon
