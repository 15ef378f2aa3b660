// A run of backward Euler from the start to 1000 s, without output.

#include <benchmark/benchmark.h>

#include "pin.hpp"

namespace gnomon::bench {

namespace {

/// 80 steps of 12.5 s at n x n elements; the consistent start is part of it and of its counts.
void backward_euler_run(::benchmark::State& loop) {
  Counters counters;
  while (loop.KeepRunning()) {
    counters = {};
    const auto model = pin_model(static_cast<int>(loop.range(0)));
    wear(*model, 12.5, 1000, counters);
  }
  loop.counters["steps"] = static_cast<double>(counters.steps);
  loop.counters["rejected"] = static_cast<double>(counters.rejected_steps);
  loop.counters["newton"] = static_cast<double>(counters.newton_iterations);
  loop.counters["residuals"] = static_cast<double>(counters.residual_evaluations);
  loop.counters["factorizations"] = static_cast<double>(counters.factorizations);
}

// Wall time, because that is the time a user waits.
BENCHMARK(backward_euler_run)->Arg(40)->UseRealTime()->Unit(::benchmark::kSecond);

}  // namespace

}  // namespace gnomon::bench
