#include "stressed_model.hpp"

#include <cmath>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/material.hpp>
#include <gnomon/terms/mesh_motion.hpp>
#include <gnomon/terms/shape_evolution.hpp>

#include "configurational_force.hpp"
#include "harmonic_mesh.hpp"

namespace gnomon::stressed {

namespace {

/// Without moduli where the body is not elastic.
std::vector<Body> bodies_of(const StressedBody& body) {
  return {{.material = {.moduli = body.elastic.value_or(ElasticModuli{})},
           .element = {ElementTechnology::plain, Kinematics::small}}};
}

/// The fields of a body, and which blocks the algebraic stages solve for.
struct StressedSet {
  FieldSet set;
  StressedFields fields;
  std::vector<BlockSelection> stages;

  explicit StressedSet(const StressedBody& body) {
    set.nodes = static_cast<int>(body.mesh.nodes.size());
    const double density =
        body.elastic ? body.stress * body.stress / body.elastic->young_modulus() : 0;
    int displacement = -1;
    if (body.elastic) {
      displacement = set.add({"displacement", "u", "all nodes", Role::stiffness});
      fields.u = set.add(field_at_nodes<2>(
          "displacement", body.displacement_fixed, displacement, body.stress * body.size,
          body.stress / body.elastic->young_modulus() * body.size));
    }
    const int inside = set.add({"shape", "d", "nodes off the free surface", Role::extension});
    const int surface = set.add({.name = "free_surface",
                                 .symbol = "d",
                                 .where = "its nodes (differential)",
                                 .role = Role::evolution,
                                 .differential = true});
    // Rounding errors of positions must not exceed what the equations are solved to.
    const double change = std::max(body.change, 1e-3 * body.size);
    fields.d = set.add(field_at_nodes<2>("shape", body.shape_fixed, inside, change, body.change));
    NodalFlags<2> boundary = body.shape_fixed;
    for (const ContactPatch<2>& patch : body.surface) {
      boundary.row(patch.node).setOnes();
      for (int i = 0; i < 2; ++i) {
        int& block = set[fields.d].block(patch.node, i);
        if (block >= 0) block = surface;
        set[fields.d].row_scale(patch.node, i) = body.change / body.duration;
      }
    }
    int adjoint = -1;
    if (body.elastic) {
      adjoint = set.add({"adjoint", "p", "nodes off the free surface", Role::extension});
      fields.p = set.add(field_at_nodes<2>("adjoint", boundary, adjoint, density * body.size,
                                           density * body.size));
    }
    for (const int block : {inside, displacement, adjoint}) {
      if (block < 0) continue;
      stages.emplace_back(set.blocks.size(), 0);
      stages.back()[block] = 1;
    }
  }
};

std::vector<TermFactory<2>> stressed_terms(const std::shared_ptr<const StressedBody>& body,
                                           const StressedFields& f) {
  using Made = std::unique_ptr<Term<2>>;
  std::vector<TermFactory<2>> terms;
  terms.push_back([body, f](const Numbering& numbering) -> Made {
    return std::make_unique<SurfaceMotion>(*body, f, numbering);
  });
  terms.push_back([body, f](const Numbering& numbering) -> Made {
    return std::make_unique<ShapeEvolution<2>>(numbering, body->surface, f.d);
  });
  terms.push_back([body, f](const Numbering& numbering) -> Made {
    return std::make_unique<MeshMotion<2>>(body->mesh, nullptr, body->shape_along,
                                           MeshMotionLaw{harmonic_material(body->mesh_weights)},
                                           numbering, f.d);
  });
  if (body->elastic)
    terms.push_back([body, f](const Numbering& numbering) -> Made {
      return std::make_unique<BodyTerm<2>>(body->mesh, bodies_of(*body), numbering, f.u, f.d);
    });
  return terms;
}

/// The part of the height of the surface along cos(phase), by the trapezoidal rule.
double amplitude_of(const std::vector<OnWave>& surface) {
  double sum = 0, square = 0, total = 0, mean = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < surface.size(); ++k) {
      const double width = surface[std::min(k + 1, surface.size() - 1)].phase -
                           surface[std::max<std::size_t>(k, 1) - 1].phase;
      const auto [phase, height] = surface[k];
      if (pass == 0) total += width, mean += width * height;
      if (pass == 1) sum += width * std::cos(phase) * (height - mean / total);
      if (pass == 1) square += width * std::cos(phase) * std::cos(phase);
    }
  return sum / square;
}

}  // namespace

struct StressedModel::Equations {
  StressedFields fields;
  std::shared_ptr<Composition<2>> composition = std::make_shared<Composition<2>>();

  explicit Equations(const std::shared_ptr<const StressedBody>& body) {
    StressedSet all(*body);
    fields = all.fields;
    composition->fields = std::make_shared<const FieldSet>(std::move(all.set));
    composition->terms = stressed_terms(body, fields);
    composition->stages = all.stages;
    composition->position = points_in_space<2>(body->mesh.nodes);
    if (!body->pulled.empty())
      composition->prescribed.push_back(
          {.field = fields.u, .entries = body->pulled, .history = {}});
  }
};

StressedModel::StressedModel(std::shared_ptr<const StressedBody> body)
    : StressedModel(body, Equations(body)) {}

StressedModel::StressedModel(std::shared_ptr<const StressedBody> body, const Equations& equations)
    : Physics<2>(equations.composition, body->mesh),
      body_(std::move(body)),
      fields_(equations.fields) {
  differential_scale = body_->change;
  if (body_->ratio) Abilities::exact = [this](double t) { return exact(t); };
}

std::vector<SurfaceNode<>> StressedModel::nodes(const FieldValues<2>& values) const {
  return dynamic_cast<const SurfaceMotion&>(system().term(0)).nodes(values);
}

NodalField<2> StressedModel::displacement(const FieldValues<2>& values) const {
  return body_->elastic ? values.vector(fields_.u)
                        : NodalField<2>::Zero(values.vector(fields_.d).rows(), 2);
}

Observation StressedModel::observe(const State& state) const {
  const FieldValues<2> values = system().values(state.t, state.y);
  const NodalField<2>&d = values.vector(fields_.d), u = displacement(values);
  double elastic = 0, before = 0, area = 0, quality = 1, least = 1;
  for (const Mesh<2>::Cell& cell : body_->mesh.cells) {
    const CellState<2> at(body_->mesh, cell, d, u);
    const double initial = cell_volume<2>(at.initial), now = cell_volume<2>(at.X);
    before += initial;
    area += now;
    least = std::min(least, now / initial);
    quality = std::min(quality, scaled_jacobian<2>(at.X));
    if (body_->elastic) elastic += elastic_energy(*body_->elastic, at.X, at.u);
  }
  double length = 0, sharpest = 0;
  std::vector<OnWave> wave;
  for (const SurfaceNode<>& node : nodes(values)) {
    length += node.length;
    sharpest = std::max(sharpest, -node.curvature);
    const int k = body_->surface[wave.size()].node;
    wave.push_back(body_->wave(body_->mesh.nodes[k] + d.row(k).transpose()));
  }
  const double energy = elastic + body_->law.tension * length - body_->law.reference * area;
  return {common("worn_volume", before - area),
          common("element_quality", quality),
          common("element_volume", least),
          {"energy", "N", energy},
          {"elastic_energy", "N", elastic},
          {"surface_length", "mm", length},
          {"area", "mm^2", area},
          {"amplitude", "mm", amplitude_of(wave)},
          {"sharpest_notch", "1/mm", sharpest}};
}

std::vector<GridField> StressedModel::fields(const State& state) const {
  const FieldValues<2> values = system().values(state.t, state.y);
  GridField drive{"driving_stress", "MPa", GridField::On::nodes, 1, {}};
  drive.values.assign(body_->mesh.nodes.size(), 0.0);
  const std::vector<SurfaceNode<>> surface = nodes(values);
  for (std::size_t c = 0; c < surface.size(); ++c)
    drive.values[body_->surface[c].node] = surface[c].drive;
  std::vector<GridField> fields = solid_fields<2>(body_->mesh, bodies_of(*body_), {},
                                                  values.vector(fields_.d), displacement(values));
  fields.insert(fields.begin() + 2, drive);
  return fields;
}

std::optional<ContactSurface> StressedModel::contact(const State& state) const {
  const FieldValues<2> values = system().values(state.t, state.y);
  return surface_of<2>(body_->mesh, body_->surface, values.vector(fields_.d), displacement(values));
}

/// A circle shrinks as R^2 = R0^2 - 2 m gamma t. So does the polygon of its nodes.
std::optional<State> StressedModel::exact(double t) const {
  const std::optional<double> ratio = body_->ratio(t);
  if (!ratio) return std::nullopt;
  State state{t, std::vector<double>(system().structure().size, 0.0), {}};
  state.ydot = state.y;
  const double radius = body_->mesh.nodes[body_->surface.front().node].norm();
  const double rate = -body_->law.mobility * body_->law.tension / (*ratio * radius * radius);
  for (const ContactPatch<2>& patch : body_->surface)
    for (int i = 0; i < 2; ++i)
      if (const int k = system().numbering().number(fields_.d, patch.node, i); k >= 0) {
        state.y[k] = (*ratio - 1) * body_->mesh.nodes[patch.node][i];
        state.ydot[k] = rate * body_->mesh.nodes[patch.node][i];
      }
  return state;
}

}  // namespace gnomon::stressed
