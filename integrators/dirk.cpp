// sdirk-*, esdirk-*: diagonally implicit Runge-Kutta methods on the DAE, one KINSOL solve a stage,
// with coefficients from ARKODE's tables. The number in the name is the order.

#include <gnomon/integration/diagonally_implicit.hpp>
#include <gnomon/sundials/arkode_table.hpp>

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
const Entry entries[] = {
    {"sdirk-2", "2", "embedded, order 1", "A", "ARKODE_SDIRK_2_1_2",
     "two stages, |R| = 1/2 at infinity, its embedded method is backward Euler"},
    {"esdirk-2", "2", "embedded, order 3", "A, L, stiffly accurate", "ARKODE_TRBDF2_3_3_2",
     "trapezoidal rule and BDF2 in one step; its error estimate does not damp stiff modes"},
    {"esdirk-3", "3", "embedded, order 2", "A, L, stiffly accurate",
     "ARKODE_ESDIRK325L2SA_5_2_3", "five stages, of stage order 2 (Kennedy and Carpenter, 2019)"},
    {"esdirk-3-short", "3", "embedded, order 2", "A, L, stiffly accurate",
     "ARKODE_ESDIRK324L2SA_4_2_3", "four stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
    {"sdirk-4", "4", "embedded, order 3", "A, L, stiffly accurate", "ARKODE_SDIRK_5_3_4",
     "five stages (Hairer and Wanner II, table IV.6.5)"},
    {"esdirk-4", "4", "embedded, order 3", "A, L, stiffly accurate",
     "ARKODE_ESDIRK436L2SA_6_3_4", "six stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
    {"esdirk-5", "5", "embedded, order 4", "A, L, stiffly accurate",
     "ARKODE_ESDIRK547L2SA_7_4_5", "seven stages, of stage order 2 (Kennedy and Carpenter, 2016)"},
};

Integrator describe(const Entry& entry) {
  Integrator integrator;
  integrator.name = entry.name;
  integrator.family = "implicit Runge-Kutta";
  integrator.order = entry.order;
  integrator.error_estimate = entry.embedded;
  integrator.stability = entry.stability;
  integrator.driver = "KINSOL, ARKODE table";
  integrator.help = std::string(entry.table).substr(7) + ": " + entry.help;
  integrator.table = [name = entry.table](const IntegratorSettings&) { return arkode_dirk_table(name); };
  integrator.make = [name = entry.table](const Model& model, const IntegratorSettings& settings,
                                         Counters& counters) {
    return make_diagonally_implicit(model, settings, counters, arkode_dirk_table(name));
  };
  return integrator;
}

const bool registered = [] {
  for (const Entry& entry : entries) Registry<Integrator>::add(describe(entry));
  return true;
}();

}  // namespace

}  // namespace gnomon
