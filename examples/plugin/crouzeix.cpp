// An integrator: the diagonally implicit method of two stages and order three by Crouzeix (1975)
// and Norsett (1974), A-stable, with gamma = (3 + sqrt 3) / 6:
//
//   gamma   | gamma
//   1-gamma | 1-2 gamma   gamma
//   --------+---------------------
//           | 1/2         1/2
//
// The table is all that has to be said. The first stage alone, y + h k_1, is of order one; the
// difference from it is an error estimate, a cautious one.

#include <cmath>
#include <gnomon/integrators/diagonally_implicit.hpp>

namespace {

using namespace gnomon;

ButcherTable crouzeix(const IntegratorSettings&) {
  const double gamma = (3 + std::sqrt(3.0)) / 6;
  ButcherTable table{"Crouzeix (1975)",  3, Eigen::MatrixXd(2, 2), Eigen::VectorXd(2),
                     Eigen::VectorXd(2), 1, Eigen::VectorXd(2)};
  table.A << gamma, 0, 1 - 2 * gamma, gamma;
  table.b << 0.5, 0.5;
  table.c << gamma, 1 - gamma;
  table.b_embedded << 1, 0;
  return table;
}

const Registration<Integrator> registration(
    {.name = "crouzeix-3",
     .family = "implicit one-step",
     .order = "3",
     .error_estimate = "1",
     .stability = "A",
     .driver = "KINSOL",
     .help = "two stages, order three (Crouzeix 1975)",
     .table = crouzeix,
     .make = [](const System& system, const IntegratorSettings& settings, Counters& counters) {
       return make_diagonally_implicit(system, settings, counters, crouzeix(settings));
     }});

}  // namespace
