// dahlquist: the test equation of stability theory (G. Dahlquist, BIT 3 (1963) 27-43), with the
// forcing of A. Prothero and A. Robinson (Math. Comp. 28 (1974) 145-162), written as an index-1 DAE
// and made nonlinear by a change of variables, so that its exact solution is known at every order
// and stiffness.
//
// Let the complex z obey zdot = r(t, z) = lambda (z - phi(t)) + phidot(t), z(0) = 1, with
// phi(t) = forcing exp(i omega t). Then
//
//   z(t) = phi(t) + (1 - phi(0)) exp(lambda t).                                              exact
//
// The differential unknown is y = z + c |z|^2 z, and z is an algebraic one. With z as a real pair
// and M(z) = dy/dz = (1 + c z.z) I + 2 c z z^T the rows are
//
//   y:  ydot - M(z) r(t, z) = 0,      z:  z + c |z|^2 z - y = 0.
//
// forcing = 0 and c = 0 is Dahlquist's equation; forcing = 1 has the smooth solution z = phi
// for every lambda, with the phenomena of stiffness (order reduction). There are no events.

#include <cmath>
#include <complex>
#include <gnomon/base/tensor.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/scene/keys.hpp>

namespace gnomon {

namespace {

using Complex = std::complex<double>;
using Pair = Vector<2>;
using Block = Tensor<2>;

Pair pair(const Complex& value) {
  return {value.real(), value.imag()};
}

struct Equation {
  Complex lambda;
  double forcing, omega, nonlinearity;

  Complex phi(double t) const { return forcing * std::exp(Complex(0, omega * t)); }
  Pair rate(double t, const Pair& z) const {
    return pair(lambda * (Complex(z[0], z[1]) - phi(t)) + Complex(0, omega) * phi(t));
  }
  Block rate_by_z() const {
    return Block{{lambda.real(), -lambda.imag()}, {lambda.imag(), lambda.real()}};
  }
  Pair y_of(const Pair& z) const { return (1 + nonlinearity * z.squaredNorm()) * z; }
  Block y_by_z(const Pair& z) const {
    return (1 + nonlinearity * z.squaredNorm()) * Block::Identity() +
           2 * nonlinearity * z * z.transpose();
  }
  /// Derivative of M(z) r with respect to z for constant r.
  Block curvature(const Pair& z, const Pair& r) const {
    return 2 * nonlinearity *
           (r * z.transpose() + z.dot(r) * Block::Identity() + z * r.transpose());
  }
  Pair exact(double t) const { return pair(phi(t) + (1.0 - phi(0)) * std::exp(lambda * t)); }
  double fastest() const { return std::abs(lambda) + std::abs(omega); }
};

/// Unknowns y (2), z (2); or z alone with y frozen.
class DahlquistSystem : public System {
public:
  DahlquistSystem(const Equation& equation, bool coupled)
      : equation_(equation), z_0_(coupled ? 2 : 0) {
    const int size = z_0_ + 2;
    PatternBuilder builder(size);
    std::vector<int> all(size);
    for (int i = 0; i < size; ++i) all[i] = i;
    builder.add(all, all);
    structure_.size = size;
    structure_.pattern = builder.build();
    structure_.group.assign(size, 0);
    structure_.differential.assign(size, 0);
    structure_.row_scale.assign(size, 1.0);
    structure_.unknown_scale.assign(size, 1.0);
    for (int i = 0; i < z_0_; ++i) {
      structure_.differential[i] = 1;
      structure_.row_scale[i] = equation.fastest() > 0 ? equation.fastest() : 1;
    }
  }

  const Structure& structure() const override { return structure_; }

  void residual(const Point& at, std::span<double> F) const override {
    const Pair z(at.y[z_0_], at.y[z_0_ + 1]);
    const Pair y = z_0_ ? Pair(at.y[0], at.y[1]) : frozen_y_;
    const Pair definition = equation_.y_of(z) - y;
    const Pair rate = equation_.y_by_z(z) * equation_.rate(at.t, z);
    for (int i = 0; i < 2; ++i) {
      F[z_0_ + i] = definition[i];
      if (z_0_) F[i] = at.ydot[i] - rate[i];
    }
  }

  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    const Pair z(at.y[z_0_], at.y[z_0_ + 1]);
    const Block M = equation_.y_by_z(z);
    // The pattern is full: values are the matrix, column by column.
    Eigen::Map<Eigen::MatrixXd> J(values.data(), structure_.size, structure_.size);
    J.setZero();
    J.block<2, 2>(z_0_, z_0_) = M;
    if (!z_0_) return;
    J.block<2, 2>(0, 0) = alpha * Block::Identity();
    J.block<2, 2>(0, 2) =
        -(M * equation_.rate_by_z() + equation_.curvature(z, equation_.rate(at.t, z)));
    J.block<2, 2>(2, 0) = -Block::Identity();
  }

  void switching(const Point&, std::span<double>) const override {}

  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto algebraic = std::make_unique<DahlquistSystem>(equation_, false);
    AlgebraicStage stage;
    stage.unknowns = {2, 3};
    stage.freeze = [system = algebraic.get()](double, std::span<const double> y) {
      system->frozen_y_ = Pair(y[0], y[1]);
    };
    stage.system = std::move(algebraic);
    std::vector<AlgebraicStage> stages;
    stages.push_back(std::move(stage));
    return stages;
  }

private:
  Equation equation_;
  int z_0_;  // number of the first component of z
  Structure structure_;
  Pair frozen_y_ = Pair::Zero();
};

class DahlquistModel : public Model {
public:
  explicit DahlquistModel(const Equation& equation) : equation_(equation), system_(equation, true) {
    blocks = {{"value", "y", 2, "the point (differential)"}, {"image", "z", 2, "the point"}};
    exact = [this](double t) {
      const Pair z = equation_.exact(t), y = equation_.y_of(z);
      const Pair rate = equation_.y_by_z(z) * equation_.rate(t, z);
      return State{t, {y[0], y[1], 0, 0}, {rate[0], rate[1], 0, 0}};
    };
  }

  const System& system() const override { return system_; }
  State start(Counters&) const override {
    const Pair z = equation_.exact(0), y = equation_.y_of(z);
    State state{0, {y[0], y[1], z[0], z[1]}, {}};
    set_rates(system_, nullptr, state);
    return state;
  }
  /// The value, its magnitude and the magnitude of its error.
  Observation observe(const State& state) const override {
    const Pair y(state.y[0], state.y[1]);
    return {{"real", "", y[0]},
            {"imaginary", "", y[1]},
            {"magnitude", "", y.norm()},
            {"error", "", (y - equation_.y_of(equation_.exact(state.t))).norm()}};
  }
  std::vector<GridField> fields(const State&) const override { return {}; }
  /// One point of the complex plane, so that shapes can be compared.
  std::optional<ContactSurface> contact(const State& state) const override {
    const Pair from = equation_.y_of(equation_.exact(0)), y(state.y[0], state.y[1]);
    ContactSurface surface;
    surface.node = {0};
    surface.initial = {{from[0], from[1], 0}};
    surface.worn = surface.current = {{y[0], y[1], 0}};
    surface.pressure = {0};
    surface.wear_depth = {(y - from).norm()};
    surface.active = {1};
    return surface;
  }

private:
  Equation equation_;
  DahlquistSystem system_;
};

std::vector<Key> keys() {
  return {
      real_key("dahlquist.rate_real", "1/s", required(), {}, "real part of lambda"),
      real_key("dahlquist.rate_imag", "1/s", by_default(0.0), {}, "imaginary part of lambda"),
      real_key("dahlquist.forcing", "", by_default(0.0), {},
               "amplitude of phi: 0 Dahlquist's equation, 1 Prothero and Robinson's, z = phi"),
      real_key("dahlquist.frequency", "1/s", by_default(1.0), {}, "angular frequency omega of phi"),
      real_key("dahlquist.nonlinearity", "", by_default(0.0), non_negative,
               "c of y = z + c |z|^2 z; 0 is the linear equation")};
}

std::unique_ptr<Model> make(const Scene& scene) {
  Equation equation;
  equation.lambda = {scene.real("dahlquist.rate_real"), scene.real("dahlquist.rate_imag")};
  equation.forcing = scene.real("dahlquist.forcing");
  equation.omega = equation.forcing != 0 ? scene.real("dahlquist.frequency") : 0;
  equation.nonlinearity = scene.real("dahlquist.nonlinearity");
  return std::make_unique<DahlquistModel>(equation);
}

const Registration<Problem> registration({
    .name = "dahlquist",
    .help = "the test equation ydot = lambda y, optionally forced and nonlinear, solved exactly",
    .keys = keys(),
    .make = make,
});

}  // namespace

}  // namespace gnomon
