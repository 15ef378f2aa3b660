// Coefficients from ARKODE's public Butcher tables, by name.
#pragma once

#include <string>

#include <gnomon/butcher_table.hpp>

namespace gnomon {

/// The table that ARKODE calls `name` ("ARKODE_ESDIRK436L2SA_6_3_4", "ARKODE_BOGACKI_SHAMPINE_4_2_3").
/// Throws Error when the installed SUNDIALS has none.
ButcherTable arkode_table(const std::string& name);

}  // namespace gnomon
