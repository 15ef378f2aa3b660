// erk-*: explicit Runge-Kutta methods on the reduced ODE, driven by ARKODE's ERKStep with its own
// error control. Every evaluation of the rate solves mesh motion and contact for the given surface
// (Remark 1).

#include <gnomon/sundials/arkode_table.hpp>
#include <gnomon/sundials/erk.hpp>

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

// The stability interval is that of |R(z)| <= 1 on the negative real axis; the tests check it.
const Entry entries[] = {
    {"erk-2", "2", "embedded, order 1", "conditional, z > -2", "ARKODE_HEUN_EULER_2_1_2",
     "Heun's method with an Euler estimate"},
    {"erk-3", "3", "embedded, order 2", "conditional, z > -2.5", "ARKODE_BOGACKI_SHAMPINE_4_2_3",
     "Bogacki and Shampine's pair"},
    {"erk-4", "4", "embedded, order 3", "conditional, z > -2.8", "ARKODE_ZONNEVELD_5_3_4",
     "Zonneveld's pair: the classical method with an estimate"},
};

Integrator describe(const Entry& entry) {
  Integrator integrator;
  integrator.name = entry.name;
  integrator.family = "explicit Runge-Kutta, decoupled";
  integrator.order = entry.order;
  integrator.error_estimate = entry.embedded;
  integrator.stability = entry.stability;
  integrator.driver = "ARKODE ERKStep, KINSOL";
  integrator.help = std::string(entry.table).substr(7) + ": " + entry.help;
  integrator.locates_events = false;
  integrator.table = [name = entry.table](const IntegratorSettings&) {
    return arkode_erk_table(name);
  };
  integrator.make = [name = entry.table](const Model& model, const IntegratorSettings& settings,
                                         Counters& counters) -> std::unique_ptr<Stepper> {
    return std::make_unique<ErkSolver>(model.system(), settings, counters, name);
  };
  return integrator;
}

const bool registered = [] {
  for (const Entry& entry : entries) Registry<Integrator>::add(describe(entry));
  return true;
}();

}  // namespace

}  // namespace gnomon
