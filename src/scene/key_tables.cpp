// The keys that scenes share. Each is specified here and nowhere else.

#include <gnomon/scene/scene.hpp>

namespace gnomon {

namespace {

constexpr Range non_negative{.min = 0};
// Wide enough for every set of units, and far from where rounding errors exceed differences.
constexpr Range duration{.min = 1e-6, .max = 1e12};

/// Of keys of steps that follow the error.
std::string steps_are_fixed(const Scene& scene) {
  return scene.has("integrator.step") ? "steps are fixed (integrator.step)" : "";
}

std::string no_cycle(const Scene& scene) {
  return scene.given("cycle.period") ? "" : "there is no cycle";
}

std::vector<Key> integrator_keys() {
  return {
      {.name = "integrator.name",
       .kind = KeyKind::text,
       .help = "time integration method (gnomon list integrators)"},
      {.name = "integrator.step",
       .unit = "s",
       .absent_meaning = "steps chosen by the error estimate",
       .range = duration,
       .on_resume = true,
       .help = "fixed step, halved only if its equations cannot be solved; not for bdf"},
      {.name = "integrator.rtol",
       .default_value = 1e-4,
       .range = relative_tolerance,
       .on_resume = true,
       .help = "relative tolerance of the worn surface per step, when steps follow the error",
       .idle = steps_are_fixed},
      {.name = "integrator.atol",
       .unit = "mm",
       .absent_meaning = "rtol times the mean wear depth at time.end",
       .range = {.min = 1e-20},
       .on_resume = true,
       .help = "absolute tolerance of the worn surface per step, when steps follow the error",
       .idle = steps_are_fixed},
      {.name = "integrator.nonlinear_fraction",
       .default_value = 0.01,
       .range = {.min = 0, .max = 0.5},
       .on_resume = true,
       .help =
           "part of the tolerated error of a step, or of the error of a fixed step, that Newton's "
           "iterations may leave; 0: they go on to rounding, 1e-11 of the scaled residual"},
      {.name = "integrator.max_step",
       .unit = "s",
       .absent_meaning = "no bound",
       .range = duration,
       .on_resume = true,
       .help = "longest step, when steps follow the error",
       .idle = steps_are_fixed},
      {.name = "integrator.events",
       .kind = KeyKind::text,
       .default_value = "ignore",
       .choices = {"ignore", "locate"},
       .help = "locate: end steps where contact nodes switch (implicit one-step methods, "
               "forward-euler and bdf)"},
      {.name = "integrator.unstable",
       .kind = KeyKind::text,
       .default_value = "stop",
       .choices = {"stop", "accept"},
       .help = "for fixed steps that amplify the fastest mode or hardly damp it: stop the run, or "
               "accept numbers without meaning"},
  };
}

std::vector<Key> output_keys() {
  return {
      {.name = "output.every",
       .kind = KeyKind::integer,
       .default_value = 10L,
       .range = non_negative,
       .on_resume = true,
       .help = "store fields every n-th step; 0: never (the start and the end are always stored)"},
      {.name = "output.times",
       .kind = KeyKind::reals,
       .unit = "s",
       .default_value = std::vector<double>{},
       .range = non_negative,
       .on_resume = true,
       .help = "store fields at these times; steps end on them exactly"},
      {.name = "output.interval",
       .unit = "s",
       .absent_meaning = "no such times",
       .range = duration,
       .on_resume = true,
       .help = "store fields every so many seconds; steps end on these times exactly"},
      {.name = "output.settle",
       .kind = KeyKind::flag,
       .default_value = true,
       .on_resume = true,
       .help =
           "two short steps before times, multiples of interval and the end, where a node has just "
           "closed, so that the stored pressures of a stiff body are accurate; for steps that "
           "follow the error, of integrators that settle (gnomon list integrators)"},
      {.name = "output.checkpoint_seconds",
       .unit = "s",
       .default_value = 10.0,
       .range = non_negative,
       .on_resume = true,
       .help = "wall time between checkpoints (gnomon resume), besides those where the run ends or "
               "is interrupted; 0: no others"},
      {.name = "output.phase_errors",
       .kind = KeyKind::flag,
       .default_value = true,
       .help = "estimate the error of the mean over the phases of a cycle, with other ones, at "
               "the start and at the end of the run",
       .idle = no_cycle},
  };
}

std::vector<Key> make_run_keys() {
  std::vector<Key> keys = {
      {.name = "problem",
       .kind = KeyKind::text,
       .help = "the problem that the scene sets (gnomon list problems)"},
      {.name = "time.end",
       .unit = "s",
       .range = duration,
       .or_product = {"time.cycles", "cycle.period"},
       .on_resume = true,
       .help = "end of the run, which begins at t = 0; in scenes with a cycle also as time.cycles"},
      {.name = "time.until",
       .kind = KeyKind::text,
       .absent_meaning = "the run goes on to time.end",
       .on_resume = true,
       .help = "ends the run where this holds, before time.end: an observation of the history, > "
               "or <, and a number in its unit, as in \"wear_depth > 1.0\""},
  };
  for (const auto& part : {integrator_keys(), output_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  return keys;
}

/// In 3D it is required: the balls of the paper wear by friction.
Key friction_key(int dim) {
  return {.name = "friction.coefficient",
          .default_value = dim == 2 ? std::optional<SceneValue>(0.0) : std::nullopt,
          .range = {.min = 0, .max = positive_quantity.max},
          .help = "Coulomb's coefficient of friction f, eq. (10)"};
}

std::vector<Key> load_and_wear_keys(int dim) {
  return {
      {.name = "load.force",
       .unit = dim == 2 ? "N/mm" : "N",
       .range = positive_quantity,
       .help = dim == 2 ? "normal force F, per unit of thickness"
                        : "normal force F, on the whole body"},
      {.name = "load.times",
       .kind = KeyKind::reals,
       .unit = "s",
       .default_value = std::vector<double>{},
       .range = non_negative,
       .help = "ascending times of load.factors, one twice for a jump; steps end on them exactly"},
      {.name = "load.factors",
       .kind = KeyKind::reals,
       .default_value = std::vector<double>{},
       .range = {.max = positive_quantity.max},
       .help = "factors of F at load.times, 1e-6 or more: linear between them, constant "
               "before the first and after the last"},
      {.name = "wear.law",
       .kind = KeyKind::text,
       .default_value = "expression",
       .help = "wear law: the expression wear.rate, or a built-in law (gnomon list laws)"},
      {.name = "wear.rate",
       .kind = KeyKind::text,
       .unit = "mm/s",
       .default_value = dim == 2 ? "k * p * v" : "k * f * p * v",
       .help =
           "wear rate, from pressure p, sliding speed v, friction power q = f p v, wear depth h, "
           "time t, sliding distance s, initial position x0 y0 z0, k = wear.coefficient, f = "
           "friction.coefficient, constants and tables (docs/wear_laws.md)"},
      {.name = "wear.coefficient",
       .unit = "1/MPa",
       .absent_meaning = "no wear law reads k",
       .range = positive_quantity,
       .help = "wear coefficient, k of wear.rate; needed by a law that reads it"},
      {.name = "wear.constants.*",
       .absent_meaning = "no such constant",
       .range = {.min = -positive_quantity.max, .max = positive_quantity.max},
       .help = "a constant of wear.rate, by its name"},
      {.name = "wear.velocity",
       .unit = "mm/s",
       .range = positive_quantity,
       .help = "sliding velocity v"},
      {.name = "wear.normal",
       .kind = KeyKind::text,
       .default_value = "conservative",
       .choices = {"conservative", "averaged", "normalised"},
       .help = "direction of wear at a node: such that the volume lost is exactly what wears, the "
               "average of facet normals of the paper, eq. (35), or that average made unit"},
  };
}

std::vector<Key> table_keys() {
  return {{.name = "tables.*.x",
           .kind = KeyKind::reals,
           .absent_meaning = "no such table",
           .range = {.min = -positive_quantity.max, .max = positive_quantity.max},
           .help = "arguments, ascending, of a function that expressions of the scene call by its "
                   "name: linear between, constant beyond"},
          {.name = "tables.*.y",
           .kind = KeyKind::reals,
           .absent_meaning = "no such table",
           .range = {.min = -positive_quantity.max, .max = positive_quantity.max},
           .help = "values of this function, as many as arguments"}};
}

std::vector<Key> body_keys() {
  return {
      {.name = "body.young_modulus",
       .unit = "MPa",
       .range = positive_quantity,
       .help = "Young's modulus E of the worn body (of the linearized law)"},
      {.name = "body.poisson_ratio",
       .range = {.min = 0, .max = 0.5, .max_open = true},
       .help = "Poisson's ratio nu of the worn body (of the linearized law)"},
      // Further choices, and keys of the materials that follow it, are filled in where materials
      // are known.
      {.name = "body.material",
       .kind = KeyKind::text,
       .default_value = "neo-hookean",
       .choices = {"linear", "neo-hookean"},
       .help = "elastic law of the body, with finite strains (docs/equations.md); linear: with "
               "small strains (K_uu then depends on the shape alone)"},
      {.name = "body.element",
       .kind = KeyKind::text,
       .default_value = "f-bar",
       .choices = {"plain", "f-bar", "f-bar-variational"},
       .help = "plain, F-bar (de Souza Neto), or F-bar as the variation of eq. (32)"},
  };
}

std::vector<Key> shape_keys() {
  return {
      {.name = "shape.constraint",
       .kind = KeyKind::text,
       .default_value = "eliminated",
       .choices = {"eliminated", "multiplier"},
       .help = "shape of the contact surface: reaction eliminated, or multiplier mu, eq. (22)"},
      {.name = "shape.poisson_ratio",
       .default_value = 0.3,
       .range = {.min = 0, .max = 0.5, .max_open = true},
       .help = "Poisson's ratio of the auxiliary elasticity, eq. (20)"},
      {.name = "shape.energy",
       .kind = KeyKind::text,
       .default_value = "neo-hookean",
       .help = "elastic law of the auxiliary elasticity: eq. (38), or blatz-ko, for example, which "
               "keeps elements from collapsing; a larger Poisson's ratio strengthens this"},
      {.name = "shape.stiffening",
       .default_value = 0.0,
       .range = {.min = 0, .max = 2},
       .help = "exponent c of the auxiliary elasticity: an element is (mean volume / its "
               "volume)^c times as stiff, so that small elements move almost rigidly"},
  };
}

std::vector<Key> make_worn_body_keys(int dim) {
  std::vector<Key> keys;
  for (const auto& part : {body_keys(), load_and_wear_keys(dim), table_keys(), shape_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  keys.push_back({.name = "solver.method",
                  .kind = KeyKind::text,
                  .default_value = "block",
                  .on_resume = true,
                  .help = "how linear systems are solved (gnomon list solvers)"});
  keys.push_back(friction_key(dim));
  keys.push_back({.name = "contact.initial_gap",
                  .unit = "mm",
                  .default_value = 0.0,
                  .range = {.min = -1e5, .max = 1e5},  // beyond, rounding errors are too large
                  .help = "distance of the bodies before they are loaded (negative: they overlap); "
                          "under a force only the approach depends on it"});
  keys.push_back(
      {.name = "contact.regularization",
       .default_value = 0.01,
       .range = positive_quantity,
       .help = "rho of eq. (26) in units of E / facet length (smaller under a light load); only "
               "the path of Newton's method depends on it"});
  return keys;
}

}  // namespace

// Function-local statics: problems copy these tables while they register themselves.

const std::vector<Key>& run_keys() {
  static const std::vector<Key> keys = make_run_keys();
  return keys;
}

const std::vector<Key>& worn_body_keys(int dim) {
  static const std::vector<Key> plane = make_worn_body_keys(2), solid = make_worn_body_keys(3);
  return dim == 2 ? plane : solid;
}

}  // namespace gnomon
