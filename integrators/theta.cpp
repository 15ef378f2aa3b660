// backward-euler and theta: the implicit schemes of eq. (18) and (21), one coupled solve per step.
//
//   d_{n+1} = d_n + h ((1 - alpha) ddot_n + alpha ddot_{n+1})   on the contact surface

#include <gnomon/integrators/diagonally_implicit.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

ButcherTable backward_euler(const IntegratorSettings&) {
  return {"eq. (18)", 1, Eigen::MatrixXd{{1.0}}, Eigen::VectorXd{{1.0}}, Eigen::VectorXd{{1.0}}};
}

const Key alpha_key = real_key("integrator.alpha", "", by_default(0.5), {.min = 1e-6, .max = 1},
                               "alpha of eq. (21): 1 is backward Euler, 0.5 the trapezoidal rule");

ButcherTable theta(const IntegratorSettings& settings) {
  const double alpha = std::get<double>(settings.value(alpha_key));
  return {"eq. (21)", alpha == 0.5 ? 2 : 1, Eigen::MatrixXd{{0.0, 0.0}, {1 - alpha, alpha}},
          Eigen::VectorXd{{1 - alpha, alpha}}, Eigen::VectorXd{{0.0, 1.0}}};
}

template <auto table>
std::unique_ptr<Stepper> make(const System& system, const IntegratorSettings& settings,
                              Counters& counters) {
  return make_diagonally_implicit(system, settings, counters, table(settings));
}

const Registration<Integrator> backward_euler_registration({
    .name = "backward-euler",
    .family = "implicit one-step",
    .order = "1",
    .error_estimate = "from past rates",
    .stability = "A, L, stiffly accurate",
    .driver = "KINSOL",
    .help = "the paper's implicit scheme, eq. (18): deformation and wear in one Newton solve",
    .table = backward_euler,
    .make = make<backward_euler>,
});

const Registration<Integrator> theta_registration({
    .name = "theta",
    .family = "implicit one-step",
    .order = "1; 2 at alpha = 0.5",
    .error_estimate = "from past rates",
    .stability = "A for alpha >= 0.5, stiffly accurate",
    .driver = "KINSOL",
    .help =
        "eq. (21) with integrator.alpha; 0.5 is the trapezoidal rule, which does not damp stiff "
        "modes",
    .keys = {alpha_key},
    .table = theta,
    .make = make<theta>,
});

}  // namespace

}  // namespace gnomon
