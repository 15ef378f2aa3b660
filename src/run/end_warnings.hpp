// Warnings about the numbers of a run: why they may be worthless, or less accurate than asked for.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Warns of an explicit method above its critical step, and of wear that is missing in the shape by
/// more than `invisible`.
std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator);

/// Warns of an error of the mean over the phases of a cycle at the start that is larger than the
/// tolerance: about as large may that of the worn shape be; empty otherwise. At the end the shape
/// has the traces of the phases, so that the error of the mean there is several times that of the
/// shape.
std::string phase_warning(const PhaseError& at_start, double tolerance);

/// Size of the rounding errors of the worn volume, to an order of magnitude [mm^2 | mm^3]: a part
/// of the box around the mesh, or around the body of revolution that it is a section of (`dim` 3,
/// the axis being x = 0 of a mesh in the plane). Zero without a mesh: the volume is then a sum of
/// depths.
double invisible_volume(const std::optional<Grid>& grid, int dim);

/// Whether the worn volume differs from the wear integral by a tenth of it or more, and by more
/// than rounding errors; smaller differences may come from the mesh. False without wear.
bool has_lost_wear(const Observation& observed, double invisible);

}  // namespace gnomon
