// The cycle that a scene describes: [cycle].
#pragma once

#include <gnomon/laws/cycle.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// cycle.*: period, phases, motions and loads. All are optional.
const std::vector<Key>& cycle_keys();

/// The cycle of a scene that has these keys; nothing where it has no cycle.period. Throws
/// InputError for an expression or a file that cannot be read, and for keys without a period.
std::optional<Cycle> read_cycle(const Scene& scene);

/// The phases of cycle.phases: so many, as cycle_points() distributes them between the `kinks`, or
/// at chosen positions. Throws InputError.
std::vector<CyclePoint> read_cycle_points(const Scene& scene, const std::vector<double>& kinks);

/// The same scene with the tables of files (*.csv) in it.
Scene with_cycle_tables(const Scene& scene);

}  // namespace gnomon
