// The cost of a coupled Newton iteration by the block solver as a function of the size of the mesh,
// and compared with the contact problem alone.

#include <benchmark/benchmark.h>

#include <cstdlib>

#include "balls.hpp"
#include "memory.hpp"

namespace gnomon::bench {

namespace {

/// The unit of the argument is a hundredth of a refinement, because arguments of benchmarks are
/// integers.
double refinement(const ::benchmark::State& loop) {
  return 0.01 * static_cast<double>(loop.range(0));
}

void report(::benchmark::State& loop, const NewtonIteration& newton) {
  loop.counters["unknowns"] = static_cast<double>(newton.structure().size);
  loop.counters["krylov"] = newton.krylov();
  loop.counters["assembly"] = newton.assembly();
  loop.counters["set_up"] = newton.set_up();
  loop.counters["solve"] = newton.solve();
  loop.counters["newton"] = newton.all();
}

/// Times of the counters are in seconds of all processors; `first_set_up` chooses aggregates.
void block_newton(::benchmark::State& loop, Example (*make)(double, bool), bool multigrid) {
  const Example example = make(refinement(loop), multigrid);
  NewtonIteration newton(example, true, false);
  newton.run();
  loop.counters["first_set_up"] = newton.set_up();
  newton.forget();
  while (loop.KeepRunning()) newton.run();
  report(loop, newton);
  loop.counters["elements"] = static_cast<double>(example.body->mesh.cells.size());
  loop.counters["peak_MB"] = peak_memory();
}

/// What follows after a set-up: assembly and solve.
double without_set_up(const NewtonIteration& newton) {
  return newton.assembly() + newton.solve();
}

/// All run alternately. `coupled/contact` is the cost of wear and shape; the others are the same
/// ratio for the parts. `kept`: with derivatives of the cells from an earlier Jacobian.
void coupled_against_contact(::benchmark::State& loop, Example (*make)(double, bool),
                             bool multigrid) {
  const Example example = make(refinement(loop), multigrid);
  NewtonIteration coupled(example, true, false), kept(example, true, true);
  NewtonIteration contact(example, false, false), kept_contact(example, false, true);
  const std::initializer_list<NewtonIteration*> all = {&coupled, &contact, &kept, &kept_contact};
  for (NewtonIteration* newton : all) {
    newton->run();
    newton->forget();
  }
  while (loop.KeepRunning())
    for (NewtonIteration* newton : all) newton->run();
  report(loop, coupled);
  loop.counters["contact_krylov"] = contact.krylov();
  loop.counters["contact_unknowns"] = static_cast<double>(contact.structure().size);
  loop.counters["contact_newton"] = contact.all();
  loop.counters["assembly_ratio"] = coupled.assembly() / contact.assembly();
  loop.counters["set_up_ratio"] = coupled.set_up() / contact.set_up();
  loop.counters["solve_ratio"] = coupled.solve() / contact.solve();
  loop.counters["coupled/contact"] = coupled.all() / contact.all();
  loop.counters["no_set_up_ratio"] = without_set_up(coupled) / without_set_up(contact);
  loop.counters["kept/contact"] = without_set_up(kept) / without_set_up(contact);
  loop.counters["kept/kept_contact"] = without_set_up(kept) / without_set_up(kept_contact);
  loop.counters["kept_assembly_ratio"] = kept.assembly() / contact.assembly();
}

/// Refinements in hundredths, from 1,800 elements on. Beyond 100,000 elements only where
/// GNOMON_LARGE_BENCHMARKS is set: the largest takes many GB.
void sizes(::benchmark::internal::Benchmark* benchmark, std::vector<int> large) {
  std::vector<int> all = {30, 40, 50, 65, 80, 100};
  if (std::getenv("GNOMON_LARGE_BENCHMARKS")) all.insert(all.end(), large.begin(), large.end());
  for (int size : all) benchmark->Arg(size);
  benchmark->ArgName("refinement")->Unit(::benchmark::kMillisecond)->MeasureProcessCPUTime();
}

void factor_sizes(::benchmark::internal::Benchmark* benchmark) {
  sizes(benchmark, {});
}
void multigrid_sizes(::benchmark::internal::Benchmark* benchmark) {
  sizes(benchmark, {125, 160, 200});
}
/// From 8,000 hexahedra on; `large` as above.
void tetrahedra_sizes(::benchmark::internal::Benchmark* benchmark) {
  for (int size : {170, 230, 300}) benchmark->Arg(size);
  if (std::getenv("GNOMON_LARGE_BENCHMARKS")) benchmark->Arg(400);
  benchmark->ArgName("refinement")->Unit(::benchmark::kMillisecond)->MeasureProcessCPUTime();
}
BENCHMARK_CAPTURE(block_newton, factor, groove, false)->Apply(factor_sizes);
BENCHMARK_CAPTURE(block_newton, multigrid, groove, true)->Apply(multigrid_sizes);
BENCHMARK_CAPTURE(block_newton, tetrahedra, ball_of_tetrahedra, true)->Apply(tetrahedra_sizes);
#define COUPLED_AGAINST_CONTACT(name, make, multigrid, size)        \
  BENCHMARK_CAPTURE(coupled_against_contact, name, make, multigrid) \
      ->Arg(50)                                                     \
      ->Arg(size)                                                   \
      ->ArgName("refinement")                                       \
      ->Unit(::benchmark::kMillisecond)                             \
      ->Iterations(3)
COUPLED_AGAINST_CONTACT(groove_factor, groove, false, 80);
COUPLED_AGAINST_CONTACT(groove_multigrid, groove, true, 80);
COUPLED_AGAINST_CONTACT(ball_factor, worn_ball, false, 100);
COUPLED_AGAINST_CONTACT(ball_multigrid, worn_ball, true, 100);

}  // namespace

}  // namespace gnomon::bench
