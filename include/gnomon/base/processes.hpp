// The only place where values that a process computes from its own rows are combined over all
// processes of a run. At present a run has one process; for a distributed run these functions
// change, but not their callers (docs/architecture.md).
#pragma once

namespace gnomon {

/// The sum of the sums of all processes, each over the rows that the process owns.
inline double sum_over_processes(double own) {
  return own;
}

/// The largest of the maxima of the processes.
inline double largest_over_processes(double own) {
  return own;
}

/// Whether the condition holds on every process: common decisions must be the same on all.
inline bool on_all_processes(bool own) {
  return own;
}

}  // namespace gnomon
