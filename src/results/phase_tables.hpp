// Of a cycle: the pressures in its phases, and the errors of the mean over them.
#pragma once

#include <hdf5.h>

#include <gnomon/model/model.hpp>
#include <string>
#include <vector>

#include "results/layout.hpp"

namespace gnomon::layout {

/// "gnomon/phase_pressure", with the positions and weights of the phases.
hdf5::Handle create_phase_group(hid_t gnomon, const ContactSurface& contact);
void write_phases(hid_t group, const std::string& name, const ContactSurface& contact);
/// Fills in the phases of a contact surface, if it has any; `step`: its path below the group.
void read_phases(hid_t gnomon, const std::string& step, ContactSurface& contact);

/// "gnomon/phase_errors".
GrowingTable create_phase_errors(hid_t gnomon);
void append_phase_error(GrowingTable& table, const PhaseError& error);
/// Empty where there is no such table.
std::vector<PhaseError> read_phase_errors(hid_t gnomon);

}  // namespace gnomon::layout
