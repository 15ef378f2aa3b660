// The cost of assembly in three dimensions: one hexahedron in the cache, and a block of hexahedra
// with pattern, map, gather and scatter.

#include <benchmark/benchmark.h>

#include <gnomon/terms/cell_assembly.hpp>
#include <memory>
#include <string>

#include "../tests/support/structured_hexahedra.hpp"
#include "memory.hpp"

namespace gnomon::bench {

namespace {

const ElasticModuli moduli = ElasticModuli::from_young_poisson(100, 0.3);

/// By the name of its law.
Material material(const std::string& law) {
  Material result = make_material(law, moduli);
  if (law == "mooney-rivlin") result.moduli.ratios[0] = 0.2;
  return result;
}

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

void residual(::benchmark::State& loop, ElementTechnology technology,
              const std::string& law = "neo-hookean") {
  Hexahedron cell;
  const Material chosen = material(law);
  const auto kernel = chosen.kernel<3>({technology, Kinematics::finite});
  while (loop.KeepRunning()) {
    kernel.residual(chosen.moduli, cell.X, cell.u, cell.R);
    ::benchmark::DoNotOptimize(cell.R);
  }
}

void tangent(::benchmark::State& loop, ElementTechnology technology, bool by_shape,
             const std::string& law = "neo-hookean") {
  Hexahedron cell;
  const Material chosen = material(law);
  const auto kernel = chosen.kernel<3>({technology, Kinematics::finite});
  const auto evaluate = by_shape ? kernel.tangent_ud : kernel.tangent_u;
  while (loop.KeepRunning()) {
    evaluate(chosen.moduli, cell.X, cell.u, cell.R, cell.K_u, cell.K_d);
    ::benchmark::DoNotOptimize(cell.K_u);
    ::benchmark::DoNotOptimize(cell.K_d);
  }
}

BENCHMARK_CAPTURE(residual, hexahedron_plain, ElementTechnology::plain);
BENCHMARK_CAPTURE(residual, hexahedron_f_bar, ElementTechnology::f_bar);
BENCHMARK_CAPTURE(tangent, hexahedron_plain_by_u, ElementTechnology::plain, false);
BENCHMARK_CAPTURE(tangent, hexahedron_plain_by_u_and_d, ElementTechnology::plain, true);
BENCHMARK_CAPTURE(tangent, hexahedron_f_bar_by_u, ElementTechnology::f_bar, false);
BENCHMARK_CAPTURE(tangent, hexahedron_f_bar_by_u_and_d, ElementTechnology::f_bar, true);
// A law whose tangent does not consist of dyads.
BENCHMARK_CAPTURE(residual, hexahedron_general, ElementTechnology::f_bar, "mooney-rivlin");
BENCHMARK_CAPTURE(tangent, hexahedron_general_by_u, ElementTechnology::f_bar, false,
                  "mooney-rivlin");
BENCHMARK_CAPTURE(tangent, hexahedron_general_by_u_and_d, ElementTechnology::f_bar, true,
                  "mooney-rivlin");

/// A block of 60,000 hexahedra whose nodes all carry u, and d where `shape`.
struct Block {
  using Numbers = NodalNumbers<3>;

  explicit Block(bool shape)
      : mesh(testing::structured_hexahedra(
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
  CellAssembly<3> assembly() const {
    return {mesh, {Body{.material = material("neo-hookean"), .element = {}}}, u, u, d};
  }
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
