// The scene of the pin on springs, and the error of the mean over the phases of its cycle.
#pragma once

#include <gnomon/model/model.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "winkler_system.hpp"

namespace gnomon::winkler {

std::vector<Key> foundation_keys();

/// With as many phases of a cycle as its tolerance asks for where cycle.phases is "auto". Throws
/// InputError.
std::shared_ptr<const Foundation> read_foundation(const Scene& scene);

/// Whether the wear rate is k v p, for which the closed form holds.
bool has_archard_rate(const Scene& scene);

/// The error of the mean wear rate over the phases of the foundation at the wear depths d of a
/// time, as a part of the rate there, or of the mean rate until then if that is larger; absent
/// where nothing wears.
std::optional<PhaseError> phase_error(const Foundation& foundation, double t,
                                      const std::vector<double>& d);

}  // namespace gnomon::winkler
