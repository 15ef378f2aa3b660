// The cost of a Newton iteration on the coupled system, part by part, for n x n elements.

#include <benchmark/benchmark.h>

#include "dense.hpp"
#include "pin.hpp"
#include "stopwatch.hpp"

namespace gnomon::bench {

namespace {

int elements(const ::benchmark::State& loop) {
  return static_cast<int>(loop.range(0));
}

void report_sizes(::benchmark::State& loop, const PinSystem& pin) {
  loop.counters["unknowns"] = static_cast<double>(pin.structure().size);
  loop.counters["nonzeros"] = static_cast<double>(pin.structure().pattern.nonzeros());
  loop.counters["factor_nonzeros"] = pin.lu.factor_nonzeros();
  loop.counters["flops"] = pin.lu.factor_flops();
}

void residual(::benchmark::State& loop) {
  PinSystem& pin = pin_system(elements(loop));
  while (loop.KeepRunning()) pin.residual();
}

void jacobian(::benchmark::State& loop) {
  PinSystem& pin = pin_system(elements(loop));
  while (loop.KeepRunning()) pin.jacobian();
  report_sizes(loop, pin);
}

void factorization(::benchmark::State& loop) {
  PinSystem& pin = pin_system(elements(loop));
  while (loop.KeepRunning()) pin.lu.factorize(pin.values);
  report_sizes(loop, pin);
}

void solve(::benchmark::State& loop) {
  PinSystem& pin = pin_system(elements(loop));
  while (loop.KeepRunning()) pin.lu.solve(pin.right_side, pin.x);
  report_sizes(loop, pin);
}

/// All parts in the order of Newton's method, with a dense product and factorization between them.
/// The counters named a/b are ratios of times (assembly: residual and Jacobian together), except
/// for factorization/dgemm and /dgetrf, which are ratios of rates in flops per second.
void newton_iteration(::benchmark::State& loop) {
  PinSystem& pin = pin_system(elements(loop));
  Dense dense;
  Stopwatch residual, jacobian, factorization, solve, product, dense_factorization;
  while (loop.KeepRunning()) {
    residual.time([&] { pin.residual(); });
    jacobian.time([&] { pin.jacobian(); });
    factorization.time([&] { pin.lu.factorize(pin.values); });
    solve.time([&] { pin.lu.solve(pin.right_side, pin.x); });
    loop.PauseTiming();
    product.time([&] { dense.product(); });
    if (Dense::has_factorization()) dense_factorization.time([&] { dense.factorize(); });
    loop.ResumeTiming();
  }
  report_sizes(loop, pin);
  const double assembly = residual.median() + jacobian.median();
  const double rate = pin.lu.factor_flops() / factorization.median();
  const double dgemm_rate = Dense::product_flops / product.median();
  loop.counters["assembly/factorization"] = assembly / factorization.median();
  loop.counters["residual/factorization"] = residual.median() / factorization.median();
  loop.counters["solve/factorization"] = solve.median() / factorization.median();
  loop.counters["GFlop/s"] = 1e-9 * rate;
  loop.counters["dgemm_GFlop/s"] = 1e-9 * dgemm_rate;
  loop.counters["factorization/dgemm"] = rate / dgemm_rate;
  if (Dense::has_factorization())
    loop.counters["factorization/dgetrf"] =
        rate * dense_factorization.median() / Dense::factorization_flops;
}

void sizes(::benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(40)->Arg(80)->Arg(160)->Unit(::benchmark::kMillisecond);
}

BENCHMARK(residual)->Apply(sizes);
BENCHMARK(jacobian)->Apply(sizes);
BENCHMARK(factorization)->Apply(sizes);
BENCHMARK(solve)->Apply(sizes);
BENCHMARK(newton_iteration)->Apply(sizes)->MinTime(2);

}  // namespace

}  // namespace gnomon::bench
