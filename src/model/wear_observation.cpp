// What is observed of a state: the scalars of a wearing assembly.
#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/processes.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/terms/meridian_point.hpp>

#include "model/connected_parts.hpp"
#include "model/observed_path.hpp"
#include "model/observed_rolling.hpp"
#include "model/resultants.hpp"
#include "model/tracks.hpp"

namespace gnomon {

namespace {

/// X = X^ + d, one row per node.
template <int dim>
CellNodal<dim> worn_positions(CellNodal<dim> initial, const typename Mesh<dim>::Cell& cell,
                              const NodalField<dim>& d) {
  for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) initial.row(a) += d.row(cell[a]);
  return initial;
}

/// The norm of the displacement gradient at the centroid, in a body of revolution its largest norm
/// at a Gauss point.
template <int dim>
double displacement_gradient(const CellState<dim>& at, [[maybe_unused]] Section section) {
  if constexpr (dim == 2)
    if (section == Section::meridian) {
      const MeridianCell<> cell(at.X, at.u);
      double largest = 0;
      for (const MeridianPoint<>& point : cell.points())
        largest = std::max(largest, point.H.norm());
      return largest;
    }
  return CellPoint<dim>(CellBasis<dim>::instance().centroid, at.X, at.u).H.norm();
}

/// The part of an observation that is a sum over contact nodes: nodes in contact in any phase, the
/// mean force, the largest pressure.
template <int dim>
void observe_contact(const std::vector<PhaseContact<dim>>& phases, const Assembly<dim>& body,
                     int units, Observation& observed) {
  double force = 0, pressure = 0;
  std::vector<char> active(phases.front().nodes.size(), 0);
  for (const auto& [weight, nodes] : phases)
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      if (!body.carries[c]) continue;
      force += weight * body.copies * nodes[c].load;
      pressure = std::max(pressure, -nodes[c].traction);
      if (nodes[c].active) active[c] = 1;
    }
  const double touching = sum_over_processes(double(std::ranges::count(active, 1)));
  observed.push_back(common("contact_nodes", touching));
  observed.push_back(common("contact_force", sum_over_processes(force), units));
  observed.push_back(common("max_pressure", largest_over_processes(pressure)));
}

/// What the guides of the counter-body, and whatever else holds it, exert on it: the reaction to
/// contact and to the forces that press it [force].
template <int dim>
Vector<dim> reaction_of(const Assembly<dim>& body, const Phase<dim>& phase,
                        const std::vector<ContactNode<dim>>& nodes, double t) {
  Vector<dim> reaction = Vector<dim>::Zero();
  for (const ContactNode<dim>& node : nodes) reaction -= node.force;
  return reaction - pressing_force(phase, body.interface.history, t, t);
}

template <int dim>
void observe_reaction(Section section, const Vector<dim>& reaction, Observation& observed) {
  const bool revolved = dim == 2 && section == Section::meridian;
  for (int i = revolved ? 1 : 0; i < dim; ++i)
    observed.push_back({fmt::format("guide_{}", revolved ? 'z' : "xyz"[i]),
                        find_scalar(observed, "contact_force")->unit,
                        sum_over_processes(reaction[i])});
}

/// The free motion of a counter-body, a part of the mean over a cycle: along the direction of its
/// largest force, and along or about others by the number of their table.
template <int dim>
void add_motion(const Phase<dim>& phase, double weight, const Eigen::VectorXd& w,
                std::optional<double>& approach, Observation& others) {
  const std::vector<std::optional<double>> forces = phase.forces();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (!forces[k]) continue;
    const double part = weight * w[static_cast<Eigen::Index>(k)];
    const Guide<dim>& guide = phase.counter_body.guides[k];
    if (guide.creeps()) continue;
    if (k == 0) {
      approach = approach.value_or(0) + part;
      continue;
    }
    const std::string name =
        (guide.turns() ? "turn_" : "approach_") + guide.key.substr(guide.key.rfind('.') + 1);
    const auto there = std::ranges::find(others, name, &Scalar::name);
    if (there == others.end())
      others.push_back({name, guide.turns() ? "rad" : "mm", part});
    else
      there->value += part;
  }
}

/// The part of an observation that needs a sweep over the cells, but no displacements. Returns what
/// each body has lost of the mesh [length^dim].
template <int dim>
std::vector<double> observe_cells(const Assembly<dim>& body, const NodalField<dim>& d,
                                  double wear_flux, int units, Observation& observed) {
  double quality = 1, least = 1, whole = 0;
  std::vector<double> worn = worn_beyond_mesh(body, d);
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    const auto& cell = body.mesh.cells[c];
    const CellNodal<dim> initial = body.mesh.positions(cell),
                         X = worn_positions<dim>(initial, cell, d);
    const double before = cell_volume<dim>(initial, body.section()),
                 after = cell_volume<dim>(X, body.section());
    worn[static_cast<std::size_t>(body.body_of[c])] += before - after;
    if (!body.shape.gap) least = std::min(least, after / before);
    quality = std::min(quality, scaled_jacobian<dim>(body.shape.gap ? initial : X));
  }
  for (double& volume : worn) {
    volume = sum_over_processes(volume) * body.copies;
    whole += volume;
  }
  const auto& groove = body.cross_section;
  const double volume = groove ? whole * groove->path / groove->length : whole;
  observed.push_back(common("worn_volume", volume, units));
  observed.push_back(common("wear_flux", wear_flux, units));
  observed.push_back(common("element_quality", -largest_over_processes(-quality)));
  observed.push_back(common("element_volume", -largest_over_processes(-least)));
  if (groove) observed.push_back(common("groove_section", whole / groove->length));
  return worn;
}

/// The body that has all nodes of a facet.
template <int dim>
int body_of_facet(const typename ContactPatch<dim>::Corner& corner, const ContactPatch<dim>& patch,
                  const std::vector<std::vector<int>>& bodies_at_nodes) {
  for (const int body : bodies_at_nodes[patch.node])
    if (std::ranges::all_of(corner.nodes, [&](int p) {
          return std::ranges::count(bodies_at_nodes[patch.nodes[p]], body) > 0;
        }))
      return body;
  return bodies_at_nodes[patch.node].front();
}

/// What each body of pairs has lost, and loses, with the whole of its tracks: "worn_volume_pin",
/// "wear_flux_pin".
template <int dim>
void observe_bodies(const Assembly<dim>& body, const std::vector<double>& worn,
                    const std::vector<PhaseContact<dim>>& phases, int units,
                    Observation& observed) {
  std::vector<double> flux(worn.size(), 0);
  const std::vector<std::vector<int>> bodies = bodies_at_nodes(body.mesh, body.body_of);
  for (std::size_t c = 0; c < body.contact_nodes.size(); ++c) {
    double of_node = 0;
    for (const auto& [weight, nodes] : phases)
      of_node += weight * body.copies * nodes[c].area * nodes[c].wear_rate;
    for (const auto& corner : body.contact_nodes[c].corners)
      flux[body_of_facet<dim>(corner, body.contact_nodes[c], bodies)] +=
          of_node * corner.initial_area / body.contact_nodes[c].initial_area;
  }
  const std::string volume = common("worn_volume", 0, units).unit,
                    rate = common("wear_flux", 0, units).unit;
  for (std::size_t b = 0; b < worn.size(); ++b) {
    observed.push_back({"worn_volume_" + body.bodies[b].name, volume, worn[b]});
    observed.push_back({"wear_flux_" + body.bodies[b].name, rate, sum_over_processes(flux[b])});
  }
}

/// The largest displacement gradient of this and the phases before, of bodies with small strains.
template <int dim>
void widen(std::optional<double>& largest, const Assembly<dim>& body, const NodalField<dim>& d,
           const NodalField<dim>& u) {
  std::vector<char> small;
  for (const Body& each : body.bodies)
    small.push_back(each.element.kinematics == Kinematics::small);
  if (std::ranges::count(small, 1) == 0) return;
  double gradient = largest.value_or(0);
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c)
    if (small[body.body_of[c]])
      gradient = std::max(
          gradient, displacement_gradient<dim>(CellState<dim>(body.mesh, body.mesh.cells[c], d, u),
                                               body.section()));
  largest = largest_over_processes(gradient);
}

}  // namespace

template <int dim>
Observation WearModel<dim>::observe(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  const std::vector<PhaseContact<dim>> phases = contacts(values, state);
  const bool whole = dim == 3 || assembly().section() == Section::meridian;  // all around
  const int units = whole ? 3 : 2;
  const NodalField<dim>& d = values.vector(equations_.fields().d);
  Vector<dim> reaction = Vector<dim>::Zero();
  std::optional<double> approach, gradient;
  double half_width = 0;
  ContactArea area;
  Observation motion;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const WornBodyFields& fields = equations_.fields(p);
    widen(gradient, assembly(), equations_.shape_of_cells(values), values.vector(fields.u));
    const Phase<dim>& phase = equations_.phases()[p];
    reaction += phases[p].weight * reaction_of(assembly(), phase, phases[p].nodes, state.t);
    if (fields.w != FieldId::none)
      add_motion(phase, phases[p].weight, values.scalar(fields.w), approach, motion);
    const ContactArea now = contact_area(assembly(), d, phases[p].nodes);
    if (now.area >= area.area) area = now;
    if constexpr (dim == 2)
      half_width =
          std::max(half_width, contact_half_width(assembly(), fields, values, phases[p].nodes));
  }
  double depth = 0, worn = 0;  // `worn`: of the thickness
  for (std::size_t c = 0; c < assembly().contact_nodes.size(); ++c) {
    if (!assembly().wears(static_cast<int>(c))) continue;
    const double own = wear_depth(c, d);
    depth = std::max(depth, own);
    if (assembly().shape.gap) worn = std::max(worn, own / thickness_[c]);
  }
  Observation observed;
  observe_contact(phases, assembly(), units, observed);
  const std::vector<double> lost =
      observe_cells(assembly(), d, wear_flux_of(phases, assembly().copies), units, observed);
  if (!assembly().pairs.empty()) observe_bodies(assembly(), lost, phases, units, observed);
  if (approach) observed.push_back(common("approach", *approach));
  if (gradient) observed.push_back(common("displacement_gradient", *gradient));
  // Several pairs have ends of their own.
  if (dim == 2 && assembly().pairs.size() < 2)
    observed.push_back(common("contact_half_width", half_width));
  observed.push_back(common("wear_depth", largest_over_processes(depth)));
  if (assembly().shape.gap)
    observed.push_back(common("thickness_left", 1 - largest_over_processes(worn)));
  observed.push_back(common("contact_area", area.area, units));
  observed.push_back(common("contact_area_error", area.unknown, units));
  observed.insert(observed.end(), motion.begin(), motion.end());
  if (assembly().interface.sticks)
    observe_path(assembly(), phases, loop(values, state.t, phases), units, observed);
  if (assembly().interface.rolling)
    observe_rolling(assembly(), equations_.moved_on_partner(values), phases.front().nodes,
                    equations_.rolling_of_first(values), units, observed);
  // Of a part of a symmetric body, what is across the symmetry is not known.
  if (!equations_.phases().front().counter_body.guides.empty() && assembly().copies == 1)
    observe_reaction(assembly().section(), reaction, observed);
  for (Scalar& column : force_columns(assembly(), resultants_->balance(values, state.t, phases)))
    observed.push_back(std::move(column));
  return observed;
}

template Observation WearModel<2>::observe(const State&) const;
template Observation WearModel<3>::observe(const State&) const;

}  // namespace gnomon
