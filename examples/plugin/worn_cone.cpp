// A problem: a rigid cone, pressed point down with the force F on a flat that slides with v, wears
// to a truncated one. At the depth h off its point, the half angle being a, the contact is a disc:
//
//   h:   hdot - k v p = 0                           Archard
//   p:   pi (h tan a)^2 p - F = 0                   equilibrium
//
// So pi tan^2(a) h^2 hdot = k F v, and the exact solution is
//
//   h(t)^3 = h_0^3 + 3 k F v t / (pi tan^2 a),      h_0: truncated at the start.

#include <cmath>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/system/system.hpp>
#include <numbers>

namespace {

using namespace gnomon;

struct Cone {
  double shape;        // pi tan^2 a
  double force, wear;  // F, k v
  double start;        // h_0

  double depth(double t) const {
    return std::cbrt(start * start * start + 3 * wear * force * t / shape);
  }
};

/// Unknowns h and p; or p alone, with h given.
class ConeSystem : public System {
public:
  ConeSystem(const Cone& cone, bool coupled) : cone_(cone), p_(coupled ? 1 : 0) {
    const int size = p_ + 1;
    PatternBuilder builder(size);
    std::vector<int> all(size);
    for (int i = 0; i < size; ++i) all[i] = i;
    builder.add(all, all);
    structure_.size = size;
    structure_.pattern = builder.build();
    structure_.group.assign(size, 0);
    structure_.differential.assign(size, 0);
    structure_.row_scale.assign(size, cone.force);
    structure_.unknown_scale.assign(size, cone.force / (cone.shape * cone.start * cone.start));
    if (!coupled) return;
    structure_.differential[0] = 1;
    structure_.row_scale[0] = cone.wear * structure_.unknown_scale[1];
    structure_.unknown_scale[0] = cone.start;
  }

  const Structure& structure() const override { return structure_; }

  void residual(const Point& at, std::span<double> F) const override {
    const double h = p_ ? at.y[0] : given_, p = at.y[p_];
    F[p_] = cone_.shape * h * h * p - cone_.force;
    if (p_) F[0] = at.ydot[0] - cone_.wear * p;
  }

  /// The pattern is full: values are the matrix, column by column.
  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    const double h = p_ ? at.y[0] : given_, p = at.y[p_];
    if (!p_) {
      values[0] = cone_.shape * h * h;
      return;
    }
    values[0] = alpha;
    values[1] = 2 * cone_.shape * h * p;
    values[2] = -cone_.wear;
    values[3] = cone_.shape * h * h;
  }

  void switching(const Point&, std::span<double>) const override {}

  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto equilibrium = std::make_unique<ConeSystem>(cone_, false);
    AlgebraicStage stage;
    stage.unknowns = {1};
    stage.freeze = [system = equilibrium.get()](double, std::span<const double> y) {
      system->given_ = y[0];
    };
    stage.system = std::move(equilibrium);
    std::vector<AlgebraicStage> stages;
    stages.push_back(std::move(stage));
    return stages;
  }

private:
  Cone cone_;
  int p_;  // number of the unknown p
  Structure structure_;
  double given_ = 0;  // h, where it is no unknown
};

class ConeModel : public Model {
public:
  explicit ConeModel(const Cone& cone) : cone_(cone), system_(cone, true) {
    blocks = {{"depth", "h", 1, "the point (differential)"}, {"pressure", "p", 1, "the contact"}};
    differential_scale = cone.start;
    exact = [cone](double t) {
      const double h = cone.depth(t), p = cone.force / (cone.shape * h * h);
      return State{t, {h, 0}, {cone.wear * p, 0}};
    };
  }

  const System& system() const override { return system_; }
  State start(Counters&) const override {
    const double h = cone_.start;
    State state{0, {h, cone_.force / (cone_.shape * h * h)}, {}};
    set_rates(system_, nullptr, state);
    return state;
  }
  Observation observe(const State& state) const override {
    return {{"depth", "mm", state.y[0]},
            {"pressure", "MPa", state.y[1]},
            {"depth_error", "mm", state.y[0] - cone_.depth(state.t)}};
  }
  std::vector<GridField> fields(const State&) const override { return {}; }
  std::optional<ContactSurface> contact(const State&) const override { return std::nullopt; }

private:
  Cone cone_;
  ConeSystem system_;
};

std::vector<Key> keys() {
  return {{.name = "cone.half_angle",
           .unit = "degrees",
           .range = {.min = 1, .max = 89},
           .help = "between axis and side"},
          {.name = "cone.start", .unit = "mm", .range = positive_quantity, .help = "h at t = 0"},
          {.name = "cone.force", .unit = "N", .range = positive_quantity, .help = "pressing force"},
          {.name = "cone.wear", .unit = "mm/(MPa s)", .range = positive_quantity, .help = "k v"}};
}

const Registration<Problem> registration(
    {.name = "worn_cone",
     .help = "a rigid cone that wears on a flat, solved exactly",
     .keys = keys(),
     .make = [](const Scene& scene) -> std::unique_ptr<Model> {
       const double tangent = std::tan(scene.real("cone.half_angle") * std::numbers::pi / 180);
       return std::make_unique<ConeModel>(Cone{.shape = std::numbers::pi * tangent * tangent,
                                               .force = scene.real("cone.force"),
                                               .wear = scene.real("cone.wear"),
                                               .start = scene.real("cone.start")});
     }});

}  // namespace
