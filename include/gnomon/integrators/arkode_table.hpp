// Coefficients from ARKODE's public Butcher tables, by name.
#pragma once

#include <gnomon/integrators/butcher_table.hpp>
#include <string>

namespace gnomon {

/// The diagonally implicit table that ARKODE calls `name` ("ARKODE_ESDIRK436L2SA_6_3_4"). Throws
/// Error when the installed SUNDIALS has none.
ButcherTable arkode_dirk_table(const std::string& name);

/// The explicit table that ARKODE calls `name` ("ARKODE_BOGACKI_SHAMPINE_4_2_3"). Same errors.
ButcherTable arkode_erk_table(const std::string& name);

}  // namespace gnomon
