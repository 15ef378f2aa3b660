// Distances between two states of a contact surface.
#pragma once

#include <gnomon/model/model.hpp>

namespace gnomon {

/// The paper's error (sec. 4.1): Euclidean norm of the differences of worn (undeformed)
/// contact-node positions [length]. Throws InputError when the surfaces have different nodes.
double shape_error(const ContactSurface& surface, const ContactSurface& reference);

/// Largest difference of the nodal contact pressures [stress]. Throws InputError as above.
double pressure_error(const ContactSurface& surface, const ContactSurface& reference);

}  // namespace gnomon
