// Loads along the contact of a pair that friction cannot balance.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <string>

namespace gnomon {

/// Says that loads of a pair are more than friction holds in a phase; empty: they are not, or that
/// is not known. Inclined surfaces hold more than flat ones.
template <int dim>
std::string loads_beyond_friction(const Assembly<dim>& body, const Phase<dim>& phase, double t);

}  // namespace gnomon
