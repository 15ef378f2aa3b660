// UMFPACK, as SparseLu uses it, against KLU: same matrices, same order of elimination.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <gnomon/system/system.hpp>

#include "klu.hpp"
#include "pin.hpp"
#include "stopwatch.hpp"

namespace gnomon::bench {

namespace {

/// Largest |a_i - b_i| relative to the largest |b_i|, each by its unknown_scale.
double difference(const std::vector<double>& a, const std::vector<double>& b,
                  const std::vector<double>& scale) {
  double distance = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    distance = std::max(distance, std::abs(a[i] - b[i]) / scale[i]);
    size = std::max(size, std::abs(b[i]) / scale[i]);
  }
  return distance / size;
}

struct Times {
  Stopwatch factorization, solve;
};

/// The time of the benchmark is that of both solvers; its purpose is the ratios klu/umfpack of
/// times (both: factorization and solve), of nonzeros of the factors, and of flops.
void umfpack_against_klu(::benchmark::State& loop) {
  PinSystem& pin = pin_system(static_cast<int>(loop.range(0)));
  const Structure& structure = pin.structure();
  Klu klu(structure.pattern, nested_dissection(structure.pattern, structure.group));
  std::vector<double> x(structure.size);
  Times umfpack, full;
  Stopwatch refactorization;
  bool done = true;
  while (loop.KeepRunning()) {
    umfpack.factorization.time([&] { done &= pin.lu.factorize(pin.values); });
    umfpack.solve.time([&] { pin.lu.solve(pin.right_side, pin.x); });
    full.factorization.time([&] { done &= klu.factorize(pin.values); });
    refactorization.time([&] { done &= klu.refactorize(pin.values); });
    full.solve.time([&] { klu.solve(pin.right_side, x); });
  }
  const double apart = difference(x, pin.x, structure.unknown_scale);
  if (!done || !(apart < 1e-6)) return loop.SkipWithError("the two solvers disagree");
  const double umfpack_time = umfpack.factorization.median();
  loop.counters["factor_klu/umfpack"] = full.factorization.median() / umfpack_time;
  loop.counters["refactor_klu/umfpack"] = refactorization.median() / umfpack_time;
  loop.counters["solve_klu/umfpack"] = full.solve.median() / umfpack.solve.median();
  loop.counters["both_klu/umfpack"] =
      (full.factorization.median() + full.solve.median()) / (umfpack_time + umfpack.solve.median());
  loop.counters["nonzeros_klu/umfpack"] = klu.factor_nonzeros() / pin.lu.factor_nonzeros();
  loop.counters["flops_klu/umfpack"] = klu.factor_flops() / pin.lu.factor_flops();
  loop.counters["difference"] = apart;
}

BENCHMARK(umfpack_against_klu)->Arg(40)->Arg(80)->MinTime(2)->Unit(::benchmark::kMillisecond);

}  // namespace

}  // namespace gnomon::bench
