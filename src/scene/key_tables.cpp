// The keys that scenes share. Each is specified here and nowhere else.

#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

// Wide enough for every set of units, and far from where rounding errors exceed differences.
constexpr Range duration{.min = 1e-6, .max = 1e12};

/// Of keys of steps that follow the error.
std::string steps_are_fixed(const Scene& scene) {
  return scene.has("integrator.step") ? "steps are fixed (integrator.step)" : "";
}

/// Where it governs the steps; an absolute tolerance that is given changes with it.
std::optional<Scene> scaled_tolerance(const Scene& scene, double factor) {
  const double rtol = factor * scene.real("integrator.rtol");
  if (scene.has("integrator.step") || rtol < relative_tolerance.min ||
      rtol > relative_tolerance.max)
    return {};
  Scene scaled = scene.with("integrator.rtol", rtol);
  if (const auto atol = scene.real_if("integrator.atol"))
    scaled = scaled.with("integrator.atol", factor * *atol);
  return scaled;
}

std::string no_cycle(const Scene& scene) {
  return scene.given("cycle.period") ? "" : "there is no cycle";
}

std::vector<Key> integrator_keys() {
  return {
      text_key("integrator.name", by_default("esdirk-3"),
               "time integration method (gnomon list integrators)"),
      resumable(controlling(
          real_key("integrator.step", "s", absent("steps chosen by the error estimate"), duration,
                   "fixed step, halved only if its equations cannot be solved; not for bdf"),
          ErrorSource::time)),
      resumable(controlling(
          real_key("integrator.rtol", "", by_default(1e-4), relative_tolerance,
                   "relative tolerance of the worn surface per step, when steps follow the error",
                   steps_are_fixed),
          ErrorSource::time, scaled_tolerance)),
      resumable(
          real_key("integrator.atol", "mm", absent("rtol times the mean wear depth at time.end"),
                   {.min = 1e-20},
                   "absolute tolerance of the worn surface per step, when steps follow the error",
                   steps_are_fixed)),
      resumable(controlling(
          real_key("integrator.nonlinear_fraction", "", by_default(0.01), {.min = 0, .max = 0.5},
                   "part of the tolerated error of a step, or of a fixed step's own where an "
                   "estimate tells it, "
                   "that Newton's iterations may leave; 0: they go on to rounding, 1e-11 of "
                   "the scaled residual"),
          ErrorSource::solves)),
      resumable(real_key(
          "integrator.max_step", "s",
          absent("no bound, but a sixteenth of a turn of a counter-body that changes its place"),
          duration, "longest step, when steps follow the error", steps_are_fixed)),
      text_key("integrator.events", by_default("ignore"),
               "locate: end steps where contact nodes switch (implicit one-step methods, "
               "forward-euler and bdf)",
               {"ignore", "locate"}),
      text_key("integrator.unstable", by_default("stop"),
               "for fixed steps that amplify the fastest mode or hardly damp it: stop the run, or "
               "accept numbers without meaning",
               {"stop", "accept"}),
  };
}

std::vector<Key> accuracy_keys() {
  return {
      real_key("accuracy.within", "", absent("the settings of the scene"),
               {.min = 1e-5, .max = 0.5},
               "error that the result may have, relative: gnomon chooses mesh, model and tolerance "
               "where the scene does not give them (docs/accuracy.md)"),
      {.name = "accuracy.of",
       .kind = KeyKind::texts,
       .default_value = std::vector<std::string>{"depth", "volume", "pressure"},
       .choices = {"depth", "volume", "profile", "width", "pressure", "largest_pressure",
                   "approach"},
       .help = "of what: depth, volume, profile, width, pressure (the mean and the inner one), "
               "largest_pressure, approach",
       .idle =
           [](const Scene& scene) {
             return scene.has("accuracy.within") ? "" : "there is no accuracy.within";
           }},
  };
}

std::vector<Key> output_keys() {
  return {
      resumable(integer_key(
          "output.every", by_default(10L), non_negative,
          "store fields every n-th step; 0: never (the start and the end are always stored)")),
      resumable(reals_key("output.times", "s", by_default(std::vector<double>{}), non_negative,
                          "store fields at these times; steps end on them exactly")),
      resumable(real_key("output.interval", "s", absent("no such times"), duration,
                         "store fields every so many seconds; steps end on these times exactly")),
      {.name = "output.settle",
       .kind = KeyKind::flag,
       .default_value = true,
       .on_resume = true,
       .help =
           "two short steps before times, multiples of interval and the end, where a node has just "
           "closed, so that the stored pressures of a stiff body are accurate; for steps that "
           "follow the error, of integrators that settle (gnomon list integrators)"},
      resumable(real_key(
          "output.checkpoint_seconds", "s", by_default(10.0), non_negative,
          "wall time between checkpoints (gnomon resume), besides those where the run ends or "
          "is interrupted; 0: no others")),
      {.name = "output.phase_errors",
       .kind = KeyKind::flag,
       .default_value = true,
       .help = "estimate the error of the mean over the phases of a cycle, with other ones, at "
               "the start and at the end of the run",
       .idle = no_cycle},
      {.name = "output.budget",
       .kind = KeyKind::flag,
       .default_value = true,
       .on_resume = true,
       .help = "estimate the errors of the result at the end of the run, by a fifth of its work or "
               "in some two seconds (docs/accuracy.md)"},
  };
}

std::vector<Key> make_run_keys() {
  std::vector<Key> keys = {
      text_key("problem", required(), "the problem that the scene sets (gnomon list problems)"),
      {.name = "time.end",
       .unit = "s",
       .range = duration,
       .or_product = {"time.cycles", "cycle.period"},
       .on_resume = true,
       .help = "end of the run, which begins at t = 0; in scenes with a cycle also as time.cycles"},
      resumable(text_key(
          "time.until", absent("the run goes on to time.end"),
          "ends the run where this holds, before time.end: an observation of the history, > "
          "or <, and a number in its unit, as in \"wear_depth > 1.0\"; \"\": none")),
  };
  for (const auto& part : {accuracy_keys(), integrator_keys(), output_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  return keys;
}

/// In 3D it is required: the balls of the paper wear by friction.
Key friction_key(int dim) {
  return real_key("friction.coefficient", "", dim == 2 ? by_default(0.0) : required(),
                  {.min = 0, .max = positive_quantity.max},
                  "Coulomb's coefficient of friction f, eq. (10)");
}

std::vector<Key> load_and_wear_keys(int dim) {
  return {
      real_key(
          "load.force", dim == 2 ? "N/mm" : "N", required(), positive_quantity,
          dim == 2 ? "normal force F, per unit of thickness" : "normal force F, on the whole body"),
      reals_key("load.times", "s", by_default(std::vector<double>{}), non_negative,
                "ascending times of load.factors, one twice for a jump; steps end on them exactly"),
      reals_key("load.factors", "", by_default(std::vector<double>{}),
                {.max = positive_quantity.max},
                "factors of F at load.times, 1e-6 or more: linear between them, constant "
                "before the first and after the last"),
      text_key("wear.law", by_default("expression"),
               "wear law: the expression wear.rate, or a built-in law (gnomon list laws)"),
      {.name = "wear.rate",
       .kind = KeyKind::text,
       .unit = "mm/s",
       .default_value = dim == 2 ? "k * p * v" : "k * f * p * v",
       .help = "wear rate, from pressure p, sliding speed v, friction power q = f p v (q_mean: its "
               "mean over the contact, in rolling), wear depth h, time t, sliding distance s, "
               "initial position x0 y0 z0, k = wear.coefficient, f = "
               "friction.coefficient, constants and tables (docs/wear_laws.md)"},
      real_key("wear.coefficient", "1/MPa", absent("no wear law reads k"), positive_quantity,
               "wear coefficient, k of wear.rate; needed by a law that reads it"),
      real_key("wear.constants.*", "", absent("no such constant"), any_quantity,
               "a constant of wear.rate, by its name"),
      real_key("wear.velocity", "mm/s", required(), positive_quantity, "sliding velocity v"),
      text_key("wear.normal", by_default("conservative"),
               "direction of wear at a node: such that the volume lost is exactly what wears, the "
               "average of facet normals of the paper, eq. (35), or that average made unit",
               {"conservative", "averaged", "normalised"}),
  };
}

std::vector<Key> table_keys() {
  return {reals_key("tables.*.x", "", absent("no such table"), any_quantity,
                    "arguments, ascending, of a function that expressions of the scene call by its "
                    "name: linear between, constant beyond"),
          reals_key("tables.*.y", "", absent("no such table"), any_quantity,
                    "values of this function, as many as arguments")};
}

/// The key chooses between two models: for a factor below 1 the one that neglects less, else the
/// one that neglects more, unless it is chosen. The stiffness is condensed where the other one
/// allows it.
Key between_models(const Key& key, const std::string& simple, const std::string& full) {
  const auto scaled = [name = key.name, simple, full](const Scene& scene,
                                                      double factor) -> std::optional<Scene> {
    if (factor == 1 || !scene.has(name) || scene.text(name) != (factor < 1 ? simple : full))
      return {};
    const Scene chosen = scene.with(name, factor < 1 ? full : simple);
    return chosen.knows("solver.reduce") ? chosen.without("solver.reduce") : chosen;
  };
  return controlling(key, ErrorSource::model, scaled);
}

std::vector<Key> body_keys() {
  return {
      real_key("body.young_modulus", "MPa", required(), positive_quantity,
               "Young's modulus E of the worn body (of the linearized law)"),
      real_key("body.poisson_ratio", "", required(), poisson_ratios,
               "Poisson's ratio nu of the worn body (of the linearized law)"),
      // Further choices, and keys of the materials that follow it, are filled in where materials
      // are known.
      between_models(
          text_key("body.material", by_default("neo-hookean"),
                   "elastic law of the body, with finite strains (docs/equations.md); linear: with "
                   "small strains (K_uu then depends on the shape alone)",
                   {"linear", "neo-hookean"}),
          "linear", "neo-hookean"),
      text_key("body.element", by_default("f-bar"),
               "plain, F-bar (de Souza Neto), or F-bar as the variation of eq. (32)",
               {"plain", "f-bar", "f-bar-variational"}),
  };
}

std::vector<Key> shape_keys() {
  return {
      between_models(
          text_key("shape.motion", by_default("mesh"),
                   "mesh: the mesh follows the wear; gap: it stays, and wear is a gap between the "
                   "body and its partner (docs/gap.md)",
                   {"mesh", "gap"}),
          "gap", "mesh"),
      text_key("shape.constraint", by_default("eliminated"),
               "shape of the contact surface: reaction eliminated, or multiplier mu, eq. (22)",
               {"eliminated", "multiplier"}),
      real_key("shape.poisson_ratio", "", by_default(0.3), poisson_ratios,
               "Poisson's ratio of the auxiliary elasticity, eq. (20)"),
      text_key("shape.energy", by_default("neo-hookean"),
               "elastic law of the auxiliary elasticity: eq. (38), or blatz-ko, for example, which "
               "keeps elements from collapsing; a larger Poisson's ratio strengthens this"),
      real_key("shape.stiffening", "", by_default(0.0), {.min = 0, .max = 2},
               "exponent c of the auxiliary elasticity: an element is (mean volume / its "
               "volume)^c times as stiff, so that small elements move almost rigidly"),
  };
}

std::vector<Key> make_worn_body_keys(int dim) {
  std::vector<Key> keys;
  for (const auto& part : {body_keys(), load_and_wear_keys(dim), table_keys(), shape_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  keys.push_back(resumable(text_key("solver.method", by_default("block"),
                                    "how linear systems are solved (gnomon list solvers)")));
  keys.push_back({.name = "solver.reduce",
                  .kind = KeyKind::flag,
                  .absent_meaning = "where it can and pays, which few contact nodes do",
                  .help = "condense the elasticity to the contact nodes once: with small strains "
                          "and wear as a gap (docs/gap.md)"});
  keys.push_back(friction_key(dim));
  keys.push_back({.name = "contact.initial_gap",
                  .unit = "mm",
                  .default_value = 0.0,
                  .range = {.min = -1e5, .max = 1e5},  // beyond, rounding errors are too large
                  .help = "distance of the bodies before they are loaded (negative: they overlap); "
                          "under a force only the approach depends on it"});
  keys.push_back(
      real_key("contact.regularization", "", by_default(0.01), positive_quantity,
               "rho of eq. (26) in units of E / facet length (smaller under a light load); only "
               "the path of Newton's method depends on it"));
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
