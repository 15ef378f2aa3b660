// The one place where what a process knows of its own rows is combined over all processes that share
// a run. A run has one process so far; a run distributed over several changes these functions, and
// none of their callers (docs/architecture.md).
#pragma once

namespace gnomon {

/// The sum of what each process has summed over the rows that it owns.
inline double sum_over_processes(double own) {
  return own;
}

/// The largest of the maxima of the processes.
inline double largest_over_processes(double own) {
  return own;
}

/// Whether it is so on every process: decisions that all take must be the same.
inline bool on_all_processes(bool own) {
  return own;
}

}  // namespace gnomon
