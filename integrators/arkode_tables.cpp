// Runge-Kutta methods with coefficients from ARKODE's tables. The number in the name is the order.
//   sdirk-*, esdirk-*   diagonally implicit, on the DAE, one KINSOL solve per stage
//   erk-*               explicit, on the reduced ODE, driven by ERKStep with its own error control;
//                       every rate is a solve of mesh motion and contact for the given surface
//                       (Remark 1)

#include <arkode/arkode.h>  // the next two rely on its <stdio.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <gnomon/integrators/diagonally_implicit.hpp>

#include "sundials/room.hpp"

namespace gnomon {

namespace {

struct Entry {
  const char* name;
  const char* order;
  const char* embedded;
  const char* stability;
  const char* table;
  const char* help;
};

// Order and stability are stated here for the reader; the tests check them against the tables.
const Entry implicit_entries[] = {
    {"sdirk-2", "2", "embedded, order 1", "A", "ARKODE_SDIRK_2_1_2",
     "two stages, |R| = 1/2 at infinity, its embedded method is backward Euler"},
    {"esdirk-2", "2", "embedded, order 3", "A, L, stiffly accurate", "ARKODE_TRBDF2_3_3_2",
     "trapezoidal rule and BDF2 in one step; its error estimate does not damp stiff modes"},
    {"esdirk-3", "3", "embedded, order 2", "A, L, stiffly accurate", "ARKODE_ESDIRK325L2SA_5_2_3",
     "five stages, of stage order 2 (Kennedy and Carpenter, 2019)"},
    {"esdirk-3-short", "3", "embedded, order 2", "A, L, stiffly accurate",
     "ARKODE_ESDIRK324L2SA_4_2_3", "four stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
    {"sdirk-4", "4", "embedded, order 3", "A, L, stiffly accurate", "ARKODE_SDIRK_5_3_4",
     "five stages (Hairer and Wanner II, table IV.6.5)"},
    {"esdirk-4", "4", "embedded, order 3", "A, L, stiffly accurate", "ARKODE_ESDIRK436L2SA_6_3_4",
     "six stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
    {"esdirk-5", "5", "embedded, order 4", "A, L, stiffly accurate", "ARKODE_ESDIRK547L2SA_7_4_5",
     "seven stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
};

// The interval of stability is that of |R(z)| <= 1 on the negative real axis.
const Entry explicit_entries[] = {
    {"erk-2", "2", "embedded, order 1", "conditional, z > -2", "ARKODE_HEUN_EULER_2_1_2",
     "Heun's method with an Euler estimate"},
    {"erk-3", "3", "embedded, order 2", "conditional, z > -2.5", "ARKODE_BOGACKI_SHAMPINE_4_2_3",
     "Bogacki and Shampine's pair"},
    {"erk-4", "4", "embedded, order 3", "conditional, z > -2.8", "ARKODE_ZONNEVELD_5_3_4",
     "Zonneveld's pair: the classical method with an estimate"},
};

/// The table that ARKODE loads by this name. Throws Error when the installed SUNDIALS has none.
template <auto load>
ButcherTable table_of_arkode(const char* name) {
  const sundials::TableOwner table(load(name));
  if (!table) throw Error(std::string("ARKODE has no Butcher table called ") + name);
  const int s = table->stages;
  ButcherTable result{name, table->q, Eigen::MatrixXd(s, s), Eigen::VectorXd(s),
                      Eigen::VectorXd(s)};
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j < s; ++j) result.A(i, j) = table->A[i][j];
    result.b[i] = table->b[i];
    result.c[i] = table->c[i];
  }
  if (!table->d) return result;
  result.embedded_order = table->p;
  result.b_embedded = Eigen::Map<const Eigen::VectorXd>(table->d, s);
  return result;
}

/// `load` is the function of ARKODE for its table, and `make` makes a stepper by it. An explicit
/// method neither locates events nor settles.
template <auto load, auto make>
void add(const Entry& entry, const char* family, const char* driver, bool implicit) {
  Registry<Integrator>::add(
      {.name = entry.name,
       .family = family,
       .order = entry.order,
       .error_estimate = entry.embedded,
       .stability = entry.stability,
       .driver = driver,
       .help = std::string(entry.table).substr(7) + ": " + entry.help,
       .locates_events = implicit,
       .settles = implicit,
       .table =
           [name = entry.table](const IntegratorSettings&) { return table_of_arkode<load>(name); },
       .make =
           [name = entry.table](const System& system, const IntegratorSettings& settings,
                                Counters& counters) {
             return make(system, settings, counters, table_of_arkode<load>(name));
           }});
}

const bool registered = [] {
  for (const Entry& entry : implicit_entries)
    add<ARKodeButcherTable_LoadDIRKByName, make_diagonally_implicit>(entry, "implicit Runge-Kutta",
                                                                     "KINSOL, ARKODE table", true);
  for (const Entry& entry : explicit_entries)
    add<ARKodeButcherTable_LoadERKByName, make_erk>(entry, "explicit Runge-Kutta, decoupled",
                                                    "ARKODE ERKStep, KINSOL", false);
  return true;
}();

}  // namespace

}  // namespace gnomon
