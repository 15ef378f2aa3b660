#include "balls.hpp"

#include <fmt/format.h>

#include <cmath>
#include <gnomon/laws/hertz.hpp>
#include <gnomon/model/problem.hpp>

namespace gnomon::bench {

namespace {

/// `file`: a scene in problems/ of a ball of this radius; `parts`: modelled ones in the whole ball.
Example example(const std::string& file, double radius, double parts,
                std::vector<std::string> overrides, bool multigrid) {
  overrides.push_back(fmt::format("solver.preconditioner={}", multigrid ? "multigrid" : "factor"));
  const Scene scene = load_scene(GNOMON_SOURCE_DIR "/problems/" + file, overrides, key_table);
  const auto model = Problems::find(scene.text("problem"), "problem").make(scene);
  const Assembly<3>& body = dynamic_cast<const WearModel<3>&>(*model).assembly();
  return {std::make_shared<const Assembly<3>>(body), radius, parts * body.interface.force.value()};
}

constexpr double paper_radius = 5;

}  // namespace

Example groove(double refinement, bool multigrid) {
  const auto elements = [&](double paper) { return std::lround(paper * refinement); };
  const double size = 0.015 / refinement;
  return example(
      "ball_on_half_space/small_deformation.toml", paper_radius, 1,
      {fmt::format("mesh.elements=[{}, {}, {}]", 2 * elements(20), elements(82), elements(20)),
       fmt::format("mesh.size=[{0}, {0}, {0}]", size), "mesh.fine=[0.15, 0.3, 0.03]"},
      multigrid);
}

Example worn_ball(double refinement, bool multigrid) {
  const auto elements = [&](double paper) { return std::lround(paper * refinement); };
  return example(
      "ball_on_flat/small_deformation.toml", paper_radius, 2,
      {fmt::format("mesh.elements=[{}, {}, {}]", elements(20), elements(6), elements(9))},
      multigrid);
}

Example ball_of_tetrahedra(double refinement, bool multigrid) {
  return example("worn_body/ball.toml", paper_radius, 2,
                 {fmt::format("mesh.factor={}", 1 / refinement)}, multigrid);
}

FieldValues<3> NewtonIteration::guess(const Example& example) const {
  const Assembly<3>& body = *example.body;
  FieldValues<3> values(*equations_.composition()->fields);
  const Material& material = body.bodies.front().material;
  const HertzPoint hertz(example.force, example.radius, material.young_modulus,
                         material.poisson_ratio);
  for (std::size_t c = 0; c < body.contact_nodes.size(); ++c) {
    const Vector<3>& X = body.mesh.nodes[body.contact_nodes[c].node];
    const double inside = 1 - (X[0] * X[0] + X[1] * X[1]) / (hertz.radius * hertz.radius);
    values.scalar(equations_.fields().lambda)[static_cast<Eigen::Index>(c)] =
        inside > 0 ? -hertz.peak_pressure * std::sqrt(inside) : 0;
  }
  return values;
}

NewtonIteration::NewtonIteration(const Example& example, bool coupled, bool kept)
    : equations_(example.body),
      system_(equations_.composition(),
              coupled ? BlockSelection(equations_.composition()->fields->blocks.size(), 1)
                      : equations_.deformation()),
      y_(structure().size),
      rest_(structure().size),
      F_(structure().size),
      J_(structure().pattern.nonzeros()),
      solution_(structure().size),
      kept_(kept),
      solver_(structure(), counters_,
              example.body->solver.coarsens ? multigrid_solvers() : factor_solvers()) {
  const FieldValues<3> values = guess(example);
  for (double lambda : values.scalar(equations_.fields().lambda)) branch_.push_back(lambda < 0);
  system_.numbering().gather(values, y_);
  if (!coupled) system_.freeze(values, 0);
}

void NewtonIteration::run() {
  constexpr double alpha = 1.0 / 50, reduction = 1e-4;
  SlowPart* const slow = kept_ ? &slow_ : nullptr;
  const Point at{.t = 0, .y = y_, .ydot = rest_, .branch = &branch_, .slow = slow};
  residual_.time([&] { system_.residual(at, F_); });
  jacobian_.time([&] { system_.jacobian(at, alpha, J_); });
  set_up_.time([&] { solver_.set_up(J_, true); });
  solve_.time([&] { solver_.solve(F_, solution_, reduction, reduction); });
  ++runs_;
}

void NewtonIteration::forget() {
  residual_ = jacobian_ = set_up_ = solve_ = {};
  counters_ = {};
  runs_ = 0;
}

double NewtonIteration::krylov() const {
  return static_cast<double>(counters_.krylov_iterations) / static_cast<double>(runs_);
}

}  // namespace gnomon::bench
