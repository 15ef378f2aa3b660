// The runs of a study as job arrays of Slurm, the scheduler of many clusters. Its programs sbatch
// and squeue are called; jobs share the study's folder, and nothing else is needed.
#pragma once

#include <gnomon/study/study.hpp>
#include <string>
#include <vector>

namespace gnomon {

struct SlurmOptions {
  std::vector<std::string> sbatch;  ///< further options of sbatch, as "--time=60"
  int at_most = 0;   ///< jobs of an array at the same time; 0: as many as Slurm allows
  double poll = 10;  ///< between looks at the jobs [s]
};

/// Plans the study, submits the runs that are not done, and submits those again whose jobs have
/// ended before them (preempted, out of time, lost with their machine), until all are done or make
/// no progress. After an interruption the jobs go on; a later call with `resume` finds them. Throws
/// as plan_study(), and Error with the words of sbatch when it refuses.
StudyProgress run_study_by_slurm(const Study& study, const StudyOptions& options,
                                 const SlurmOptions& slurm, const StudyHooks& hooks);

}  // namespace gnomon
