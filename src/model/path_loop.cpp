// The loop of a path: where the partner is in its phases, and the force that moves it.
#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <limits>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/across_contact.hpp"
#include "model/connected_parts.hpp"
#include "model/observed_path.hpp"

namespace gnomon {

namespace {

/// By contact node: whether it carries the contact whose loop is told, that of the first pair.
template <int dim>
std::vector<char> in_loop(const Assembly<dim>& assembly) {
  if (assembly.pairs.empty()) return std::vector<char>(assembly.contact_nodes.size(), 1);
  std::vector<char> result(assembly.contact_nodes.size(), 0);
  for (const int node : nodes_of_facets(assembly.pairs.front().slave))
    result[static_cast<std::size_t>(assembly.contact_node(node))] = 1;
  return result;
}

/// How far the partner has moved where it touches; the master of the first pair in the frame of the
/// slave, where they slide, or where its axis is.
template <int dim>
Vector<dim> place_in_loop(const Assembly<dim>& assembly, const Phase<dim>& phase,
                          const std::optional<AxisOfPath<dim>>& axis) {
  CyclicMotion<dim> motion = assembly.cycle->motion;
  if (assembly.pairs.empty()) return carried_by(motion, assembly.interface.partner, phase);
  // The slave may be the second in the scene.
  motion.sliding = assembly.pairs.front().numbers;
  return carried_by(motion, assembly.interface.partner, phase, axis ? axis->centre : motion.point);
}

/// By how much the partner has turned about its axis, from where the cycle has no rotation [rad].
template <int dim>
double angle_in_loop(const Assembly<dim>& assembly, const Phase<dim>& phase,
                     const PartnerMotion<>& q, const AxisOfPath<dim>& axis) {
  const CyclicMotion<dim>& motion = assembly.cycle->motion;
  if (axis.side >= 0) {
    const auto body = static_cast<std::size_t>(
        assembly.pairs.front().numbers[static_cast<std::size_t>(axis.side)]);
    const double angle = motion.bodies[body].cycle.rotation->value(phase.position);
    return axis.side == 0 ? -angle : angle;
  }
  double angle = motion.cycle.rotation ? motion.cycle.rotation->value(phase.position) : 0;
  for (std::size_t k = 0; k < phase.counter_body.guides.size(); ++k)
    if (phase.counter_body.guides[k].turns()) angle = q[static_cast<Eigen::Index>(k)];
  return angle;
}

/// Of the force on the partner, about its axis. `x`: the place of the node, of a pair in the frame
/// of the slave, as `force` on it.
template <int dim>
double moment_in_loop(const Assembly<dim>& assembly, const Phase<dim>& phase,
                      const PartnerMotion<>& q, const AxisOfPath<dim>& axis, const Vector<dim>& x,
                      const Vector<dim>& force) {
  if (axis.side < 0) return -force.dot(axis.spin * (phase.counter_body.seen(x, q) - axis.centre));
  const auto place = [&](int side) {
    return phase.places[static_cast<std::size_t>(
        assembly.pairs.front().numbers[static_cast<std::size_t>(side)])];
  };
  const Vector<dim> arm = place(0).of(x) - place(axis.side).of(axis.centre);
  return -(place(0).turn * force).dot(axis.spin * arm);
}

/// Keeps what is not across planes of symmetry, which cut the contact where supports hold nodes
/// that touch in one direction alone, of both bodies, in a plane across it. The other half pushes
/// back there.
template <int dim>
Vector<dim> kept_by_symmetry(const Assembly<dim>& assembly,
                             const std::vector<PhaseContact<dim>>& phases) {
  constexpr double rounding = 1e-9;
  constexpr double none = std::numeric_limits<double>::infinity();
  Vector<dim> low = Vector<dim>::Constant(none), high = -low;  // of what is held along each axis
  std::array<std::set<int>, 2> sides;                          // of the pair of the loop
  if (!assembly.pairs.empty())
    sides = {nodes_of_facets(assembly.pairs.front().slave),
             nodes_of_facets(assembly.pairs.front().master)};
  std::array<std::array<bool, dim>, 2> held{};
  for (const PhaseContact<dim>& phase : phases)
    for (std::size_t c = 0; c < phase.nodes.size(); ++c) {
      const int node = assembly.contact_nodes[c].node;
      const auto by = assembly.supports.held.row(node).template cast<int>();
      if (!phase.nodes[c].active || by.sum() != 1) continue;
      Eigen::Index i = 0;
      by.maxCoeff(&i);
      for (const std::size_t side : {0, 1})
        if (sides[side].contains(node)) held[side][static_cast<std::size_t>(i)] = true;
      low[i] = std::min(low[i], assembly.mesh.nodes[node][i]);
      high[i] = std::max(high[i], assembly.mesh.nodes[node][i]);
    }
  const double size = Box<dim>::around(assembly.mesh.nodes).diagonal();
  Vector<dim> kept = Vector<dim>::Ones();
  for (int i = 0; i < dim; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool all = assembly.pairs.empty() || (held[0][at] && held[1][at]);
    if (all && high[i] >= low[i] && high[i] - low[i] <= rounding * size) kept[i] = 0;
  }
  const CyclicMotion<dim>& motion = assembly.cycle->motion;
  const auto keep_moved = [&](const Cycle& cycle) {
    for (int i = 0; i < dim; ++i)
      if (cycle.displacement[static_cast<std::size_t>(i)] || cycle.rotation) kept[i] = 1;
  };
  keep_moved(motion.cycle);
  for (const BodyCycle<dim>& body : motion.bodies) keep_moved(body.cycle);
  for (const Guide<dim>& guide : assembly.interface.partner.guides)
    for (int i = 0; i < dim; ++i)
      if (guide.turns() || (!guide.is_held() && guide.along[i] != 0)) kept[i] = 1;
  return kept;
}

}  // namespace

/// Where swinging loads alone drive the bodies, these and the mean displacement of their nodes, so
/// that the loop encloses their work; as forces on the partner where the first acts on the slave's
/// part. Loads that pull against each other add up.
template <int dim>
void WearModel<dim>::follow_loads(const FieldValues<dim>& values, double t,
                                  std::vector<PlaceAndForce<dim>>& loop) const {
  constexpr double rounding = 1e-6;
  const Vector<dim>& normal = assembly().pairs.empty() ? assembly().interface.partner.approach
                                                       : assembly().pairs.front().approach;
  const auto stays = [&](const PlaceAndForce<dim>& at) {
    const Vector<dim> moved = at.place - loop.front().place;
    return at.angle == loop.front().angle &&
           (moved - normal * normal.dot(moved)).norm() <= rounding * assembly().scales.displacement;
  };
  if (assembly().swinging_loads.empty() || !std::ranges::all_of(loop, stays)) return;
  const std::vector<int> parts = connected_parts(assembly().mesh);
  const int slave = parts[static_cast<std::size_t>(
      assembly().pairs.empty() ? assembly().contact_nodes.front().node
                               : assembly().pairs.front().slave.front()[0])];
  for (PlaceAndForce<dim>& at : loop) at.place.setZero(), at.force.setZero();
  double whole = 0;
  Vector<dim> along = Vector<dim>::Zero();  // of the first, by which the others are turned
  for (const Load<dim>& load : assembly().swinging_loads) {
    const NodalField<dim> forces = forces_of<dim>(load, assembly());
    const Eigen::VectorXd sizes = forces.rowwise().norm();
    const Vector<dim> sum = forces.colwise().sum().transpose();
    double on_slave = 0;
    for (Eigen::Index node = 0; node < sizes.size(); ++node)
      if (parts[static_cast<std::size_t>(node)] == slave) on_slave += sizes[node];
    const double turned = along.dot(sum);
    const double sign = turned < 0 || (turned == 0 && on_slave > sizes.sum() / 2) ? -1 : 1;
    if (along.isZero(0)) along = sign * sum;
    whole += sizes.sum();
    for (std::size_t p = 0; p < loop.size(); ++p) {
      loop[p].force += assembly().copies * sign * load.history.factor(t) *
                       equations_.phases()[p].load_factor(load.swing) * sum;
      loop[p].place += sign * values.vector(equations_.fields(p).u).transpose() * sizes;
    }
  }
  for (PlaceAndForce<dim>& at : loop) at.place /= whole;
}

namespace {

/// About an axis along the surface, as in the plane, the place of the contact moves.
template <int dim>
std::optional<AxisOfPath<dim>> axis_of_pair(const Assembly<dim>& assembly) {
  constexpr double along = 0.7;  // half a right angle
  std::optional<AxisOfPath<dim>> result;
  const std::vector<BodyCycle<dim>>& bodies = assembly.cycle->motion.bodies;
  if (bodies.empty()) return result;  // phases that no cycle has made
  if constexpr (dim == 3)
    for (const int side : {0, 1}) {
      const MortarPair<dim>& pair = assembly.pairs.front();
      const auto number = pair.numbers[static_cast<std::size_t>(side)];
      const BodyCycle<dim>& body = bodies[static_cast<std::size_t>(number)];
      if (!body.cycle.rotation) continue;
      const Tensor<dim>& spin = body.axis.spin;
      const Vector<dim> axis(spin(2, 1), spin(0, 2), spin(1, 0));
      if (result || std::abs(axis.dot(pair.approach)) < along) return {};
      result = AxisOfPath<dim>{spin, body.axis.centre, side};
    }
  return result;
}

}  // namespace

template <int dim>
std::optional<AxisOfPath<dim>> axis_of_path(const Assembly<dim>& assembly) {
  if (!assembly.pairs.empty()) return axis_of_pair(assembly);
  const CounterBody<dim>& partner = assembly.interface.partner;
  for (const Guide<dim>& guide : partner.guides)
    if (guide.turns()) return AxisOfPath<dim>{guide.turn, guide.centre};
  const CyclicMotion<dim>& motion = assembly.cycle->motion;
  if (!motion.cycle.rotation) return {};
  return AxisOfPath<dim>{motion.axis.spin, motion.axis.centre};
}

template <int dim>
std::vector<PlaceAndForce<dim>> WearModel<dim>::loop(
    const FieldValues<dim>& values, double t, const std::vector<PhaseContact<dim>>& phases) const {
  const std::vector<char> counts = in_loop(assembly());
  const Vector<dim> kept = kept_by_symmetry(assembly(), phases),
                    across = across_contact(assembly(), phases);
  const std::optional<AxisOfPath<dim>> axis = axis_of_path(assembly());
  const NodalField<dim> shape = equations_.shape_of_cells(values);
  std::vector<PlaceAndForce<dim>> result;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const Phase<dim>& phase = equations_.phases()[p];
    PlaceAndForce<dim>& point = result.emplace_back();
    point.place = place_in_loop(assembly(), phase, axis);
    for (std::size_t c = 0; c < counts.size(); ++c)
      if (counts[c]) point.contact -= assembly().copies * phases[p].nodes[c].force;
    for (int i = 0; i < dim; ++i) point.contact[i] = kept[i] * sum_over_processes(point.contact[i]);
    point.friction = point.contact - across * across.dot(point.contact);
    point.force = point.contact;
    const PartnerMotion<> q = equations_.partner_motion(values, t, p);
    for (std::size_t k = 0; k < phase.counter_body.guides.size(); ++k)
      point.place += q[static_cast<Eigen::Index>(k)] * phase.counter_body.guides[k].along;
    if (!axis) continue;
    point.angle = angle_in_loop(assembly(), phase, q, *axis);
    for (std::size_t c = 0; c < counts.size(); ++c) {
      if (!counts[c]) continue;
      const ContactPatch<dim>& patch = assembly().contact_nodes[c];
      const Vector<dim> x = patch.initial_position + shape.row(patch.node).transpose() +
                            values.vector(equations_.fields(p).u).row(patch.node).transpose();
      point.moment += assembly().copies *
                      moment_in_loop(assembly(), phase, q, *axis, x, phases[p].nodes[c].force);
    }
    point.moment = sum_over_processes(point.moment);
  }
  follow_loads(values, t, result);
  return result;
}

template std::optional<AxisOfPath<2>> axis_of_path(const Assembly<2>&);
template std::optional<AxisOfPath<3>> axis_of_path(const Assembly<3>&);
template void WearModel<2>::follow_loads(const FieldValues<2>&, double,
                                         std::vector<PlaceAndForce<2>>&) const;
template void WearModel<3>::follow_loads(const FieldValues<3>&, double,
                                         std::vector<PlaceAndForce<3>>&) const;
template std::vector<PlaceAndForce<2>> WearModel<2>::loop(
    const FieldValues<2>&, double, const std::vector<PhaseContact<2>>&) const;
template std::vector<PlaceAndForce<3>> WearModel<3>::loop(
    const FieldValues<3>&, double, const std::vector<PhaseContact<3>>&) const;

}  // namespace gnomon
