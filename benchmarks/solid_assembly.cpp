// What assembly costs in three dimensions: one hexahedron in the cache, and a block of them with
// pattern, map, gather and scatter.

#include <benchmark/benchmark.h>

#include <gnomon/terms/cell_assembly.hpp>
#include <memory>
#include <string>

#include "memory.hpp"

namespace gnomon::bench {

namespace {

const NeoHookean law = NeoHookean::from_young_poisson(100, 0.3);

/// A distorted, deformed hexahedron.
struct Hexahedron {
  CellNodal<3> X, u, R;
  CellMatrix<3> K_u, K_d;

  Hexahedron() {
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) {
        X(a, i) = reference_corner<3>(a)[i] + 0.1 * std::sin(3.0 * a + i);
        u(a, i) = 0.05 * std::cos(2.0 * a - i);
      }
  }
};

void residual(::benchmark::State& loop, ElementKind kind) {
  Hexahedron cell;
  const auto kernel = SolidKernel<3>::of(kind);
  while (loop.KeepRunning()) {
    kernel.residual(law, cell.X, cell.u, cell.R);
    ::benchmark::DoNotOptimize(cell.R);
  }
}

void tangent(::benchmark::State& loop, ElementKind kind, bool by_shape) {
  Hexahedron cell;
  const auto kernel = SolidKernel<3>::of(kind);
  const auto evaluate = by_shape ? kernel.tangent_ud : kernel.tangent_u;
  while (loop.KeepRunning()) {
    evaluate(law, cell.X, cell.u, cell.R, cell.K_u, cell.K_d);
    ::benchmark::DoNotOptimize(cell.K_u);
    ::benchmark::DoNotOptimize(cell.K_d);
  }
}

BENCHMARK_CAPTURE(residual, hexahedron_plain, ElementKind::plain);
BENCHMARK_CAPTURE(residual, hexahedron_f_bar, ElementKind::f_bar);
BENCHMARK_CAPTURE(tangent, hexahedron_plain_by_u, ElementKind::plain, false);
BENCHMARK_CAPTURE(tangent, hexahedron_plain_by_u_and_d, ElementKind::plain, true);
BENCHMARK_CAPTURE(tangent, hexahedron_f_bar_by_u, ElementKind::f_bar, false);
BENCHMARK_CAPTURE(tangent, hexahedron_f_bar_by_u_and_d, ElementKind::f_bar, true);

/// A block of 60,000 hexahedra whose nodes all carry u, and d where `shape`.
struct Block {
  using Numbers = NodalNumbers<3>;

  explicit Block(bool shape)
      : mesh(structured_hexahedra(
            50, 40, 30,
            [](double r, double s, double t) { return Vector<3>(5 * r, 4 * s, 3 * t); })),
        u(Numbers::Constant(nodes(), 3, -1)),
        d(u),
        displacement(NodalField<3>::Zero(nodes(), 3)) {
    for (int node = 0; node < nodes(); ++node) {
      for (int i = 0; i < 3; ++i) u(node, i) = size++;
      for (int i = 0; shape && i < 3; ++i) d(node, i) = size++;
      for (int i = 0; i < 3; ++i) displacement(node, i) = 1e-3 * std::sin(7.0 * node + i);
    }
  }

  int nodes() const { return static_cast<int>(mesh.nodes.size()); }
  CellAssembly<3> assembly() const { return {mesh, law, ElementKind::f_bar, u, u, &d}; }
  SparsePattern pattern(const CellAssembly<3>& cells) const {
    PatternBuilder builder(size);
    cells.add_to_pattern(builder);
    return builder.build();
  }

  Mesh<3> mesh;
  Numbers u, d;
  int size = 0;
  NodalField<3> displacement;
};

void pattern(::benchmark::State& loop) {
  const Block block(loop.range(0));
  const auto cells = block.assembly();
  double nonzeros = 0;
  while (loop.KeepRunning()) nonzeros = static_cast<double>(block.pattern(cells).nonzeros());
  loop.counters["nonzeros"] = nonzeros;
  loop.counters["peak_MB"] = peak_memory();
}

void map(::benchmark::State& loop) {
  const Block block(loop.range(0));
  auto cells = block.assembly();
  const SparsePattern pattern = block.pattern(cells);
  while (loop.KeepRunning()) cells.map_to(pattern);
  loop.counters["peak_MB"] = peak_memory();
}

void block_residual(::benchmark::State& loop) {
  const Block block(false);
  const auto cells = block.assembly();
  std::vector<double> F(block.size);
  while (loop.KeepRunning()) cells.add_residual(nullptr, block.displacement, F);
}

void block_jacobian(::benchmark::State& loop) {
  const Block block(loop.range(0));
  auto cells = block.assembly();
  const SparsePattern pattern = block.pattern(cells);
  cells.map_to(pattern);
  std::vector<double> values(pattern.nonzeros());
  while (loop.KeepRunning()) cells.add_jacobian(nullptr, block.displacement, values);
}

BENCHMARK(pattern)->ArgName("shape")->Arg(0)->Arg(1)->Unit(::benchmark::kMillisecond);
BENCHMARK(map)->ArgName("shape")->Arg(0)->Arg(1)->Unit(::benchmark::kMillisecond);
BENCHMARK(block_residual)->UseRealTime()->Unit(::benchmark::kMillisecond);
BENCHMARK(block_jacobian)
    ->ArgName("shape")
    ->Arg(0)
    ->Arg(1)
    ->UseRealTime()
    ->Unit(::benchmark::kMillisecond);

}  // namespace

}  // namespace gnomon::bench
