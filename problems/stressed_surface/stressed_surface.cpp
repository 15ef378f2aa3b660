// stressed_surface: a free surface that dissolves or evaporates,
//
//   v_n = -m (w + gamma kappa - w0),
//
// w the elastic energy density, kappa the curvature, positive where the body is convex. A flat
// surface under stress is not stable (R. J. Asaro, W. A. Tiller, Metall. Trans. 3 (1972) 1789;
// M. A. Grinfeld, Sov. Phys. Dokl. 31 (1986) 831): in plane strain a small wave cos(q x) of it
// grows at the rate
//
//   m [2 (1 - nu^2) sigma^2 q / E - gamma q^2],   that is, if q < q_c = 2 (1 - nu^2) sigma^2/(E
//   gamma),
//
// and sharpens to a cusp in finite time. Without stress (w0 = 0) a circle shrinks as
// R^2 = R0^2 - 2 m gamma t, and its lobes cos(n angle) decay at the rate m gamma (n^2 - 1)/R^2,
// that is as R^(n^2 - 1). docs/stressed_surface.md.

#include <cmath>
#include <gnomon/model/physics.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/mesh_motion.hpp>
#include <gnomon/terms/shape_evolution.hpp>

#include "surface_motion.hpp"

namespace gnomon::stressed {

namespace {

/// Without moduli where the body is not elastic.
std::vector<Body> bodies_of(const StressedBody& body) {
  return {{.material = {.moduli = body.elastic.value_or(ElasticModuli{})},
           .element = {ElementTechnology::plain, Kinematics::small}}};
}

std::vector<TermFactory<2>> stressed_terms(const std::shared_ptr<const StressedBody>& body,
                                           const StressedFields& f) {
  std::vector<TermFactory<2>> terms;
  terms.push_back([body, f](const Numbering& numbering) {
    return std::make_unique<SurfaceMotion>(*body, f, numbering);
  });
  terms.push_back([body, f](const Numbering& numbering) {
    return std::make_unique<ShapeEvolution<2>>(numbering, body->surface, f.d);
  });
  terms.push_back([body, f](const Numbering& numbering) {
    return std::make_unique<MeshMotion<2>>(body->mesh, nullptr, body->shape_along,
                                           MeshMotionLaw{harmonic_material(body->mesh_weights)},
                                           numbering, f.d);
  });
  if (body->elastic)
    terms.push_back([body, f](const Numbering& numbering) {
      return std::make_unique<BodyTerm<2>>(body->mesh, bodies_of(*body), numbering, f.u, f.d);
    });
  return terms;
}

/// Rows, in the order of their unknowns:
///
///   u               equilibrium, R(d, u)                                       [force]
///   d (inside)      mesh motion, K d                                           [length]
///   d (surface)     ddot + m (N . g) N / M                                     [length/time]
///   p               C + K p, adjoint of the mesh motion                        [force]
///
/// u and p only where the body is elastic.
struct Equations {
  StressedFields fields;
  std::shared_ptr<Composition<2>> composition = std::make_shared<Composition<2>>();

  explicit Equations(const std::shared_ptr<const StressedBody>& of) {
    const StressedBody& body = *of;
    FieldSet set;
    set.nodes = static_cast<int>(body.mesh.nodes.size());
    const double stress = std::abs(body.stress);
    const double density = body.elastic ? stress * stress / body.elastic->young_modulus() : 0;
    int displacement = -1;
    if (body.elastic) {
      displacement = set.add({"displacement", "u", "all nodes", Role::stiffness});
      fields.u = set.add(field_at_nodes<2>("displacement", body.displacement_fixed, displacement,
                                           stress * body.size,
                                           stress / body.elastic->young_modulus() * body.size));
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
      composition->stages.emplace_back(set.blocks.size(), 0);
      composition->stages.back()[block] = 1;
    }
    composition->fields = std::make_shared<const FieldSet>(std::move(set));
    composition->terms = stressed_terms(of, fields);
    composition->position = points_in_space<2>(body.mesh.nodes);
    if (!body.pulled.empty())
      composition->prescribed.push_back({.field = fields.u, .entries = body.pulled, .history = {}});
  }
};

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

class StressedModel : public Physics<2> {
public:
  explicit StressedModel(const std::shared_ptr<const StressedBody>& body)
      : StressedModel(body, Equations(body)) {}

  /// `worn_volume` is the area that the body has lost. Of its own: `energy` of surface_motion.hpp,
  /// its `elastic_energy`, `surface_length`, the `amplitude` of the wave or of the lobes, and the
  /// curvature of the `sharpest_notch`.
  Observation observe(const State& state) const override {
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

  /// displacement, shape, driving_stress (mu of the surface), equivalent_stress, element_quality.
  std::vector<GridField> fields(const State& state) const override {
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

  /// The free surface, which has no contact: its pressures are zero.
  std::optional<ContactSurface> contact(const State& state) const override {
    const FieldValues<2> values = system().values(state.t, state.y);
    return surface_of<2>(body_->mesh, body_->surface, values.vector(fields_.d),
                         displacement(values));
  }

private:
  StressedModel(std::shared_ptr<const StressedBody> body, const Equations& equations)
      : Physics<2>(equations.composition, body->mesh),
        body_(std::move(body)),
        fields_(equations.fields) {
    differential_scale = body_->change;
    if (body_->ratio) Abilities::exact = [this](double t) { return exact(t); };
  }
  std::vector<SurfaceNode<>> nodes(const FieldValues<2>& values) const {
    return dynamic_cast<const SurfaceMotion&>(system().term(0)).nodes(values);
  }

  /// A circle shrinks as R^2 = R0^2 - 2 m gamma t. So does the polygon of its nodes.
  std::optional<State> exact(double t) const {
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

  /// Zero where the body is not elastic.
  NodalField<2> displacement(const FieldValues<2>& values) const {
    return body_->elastic ? values.vector(fields_.u)
                          : NodalField<2>::Zero(values.vector(fields_.d).rows(), 2);
  }

  std::shared_ptr<const StressedBody> body_;
  StressedFields fields_;
};

const Registration<Problem> stressed_surface({
    .name = "stressed_surface",
    .help = "2D free surface that moves by its elastic energy and its curvature; no contact",
    .keys = stressed_body_keys(),
    .make = [](const Scene& scene) -> std::unique_ptr<Model> {
      return std::make_unique<StressedModel>(read_stressed_body(scene));
    },
});

}  // namespace

}  // namespace gnomon::stressed
