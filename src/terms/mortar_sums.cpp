// What the surfaces of pairs have at a state: positions, sums over facets, pressures and wear.
#include <algorithm>
#include <gnomon/terms/mortar_term.hpp>
#include <limits>

namespace gnomon {

template <int dim>
Vector<dim> MortarTerm<dim>::undeformed(const Evaluation<dim>& at, int node) const {
  return state_.mesh.nodes[static_cast<std::size_t>(node)] +
         at.values.vector(state_.d).row(node).transpose();
}

template <int dim>
Vector<dim> MortarTerm<dim>::current(const Evaluation<dim>& at, int node,
                                     const BodyPlace<dim>& place) const {
  return place.of(undeformed(at, node) + at.values.vector(state_.u).row(node).transpose());
}

template <int dim>
PatchNodal<dim> MortarTerm<dim>::positions(const Evaluation<dim>& at,
                                           const ContactPatch<dim>& patch,
                                           const BodyPlace<dim>* place) const {
  PatchNodal<dim> result(static_cast<Eigen::Index>(patch.nodes.size()), dim);
  for (Eigen::Index p = 0; p < result.rows(); ++p)
    result.row(p) =
        (place ? current(at, patch.nodes[p], *place) : undeformed(at, patch.nodes[p])).transpose();
  return result;
}

template <int dim>
std::pair<FacetPair<dim>, std::vector<FacetNodal<dim>>> MortarTerm<dim>::places_of(
    const SlaveFacet& facet, const Evaluation<dim>& at, const Surfaces& result) const {
  FacetPair<dim> slave;
  slave.y.setZero();  // of each master in turn
  for (int a = 0; a < corners; ++a) {
    const int node = patch(sides_[facet.sides[a]]).node;
    slave.X.row(a) = undeformed(at, node).transpose();
    slave.x.row(a) = current(at, node, places_[facet.pair].of[0]).transpose();
    slave.n.row(a) = result.sides[facet.sides[a]].normal->value.transpose();
  }
  std::vector<FacetNodal<dim>> masters(facet.masters.size());
  for (std::size_t k = 0; k < masters.size(); ++k)
    for (int b = 0; b < corners; ++b)
      masters[k].row(b) = current(at, state_.pairs[facet.pair].master[facet.masters[k]][b],
                                  places_[facet.pair].of[1])
                              .transpose();
  return {slave, std::move(masters)};
}

template <int dim>
void MortarTerm<dim>::add_facets(const Evaluation<dim>& at, Surfaces& result) const {
  auto facets = std::make_shared<std::vector<MortarFacet<dim>>>();
  result.facets = facets;
  for (const SlaveFacet& facet : facets_) {
    const auto [slave, masters] = places_of(facet, at, result);
    const MortarFacet<dim>& sums = facets->emplace_back(
        slave, masters, facet.masters, state_.section, state_.pairs[facet.pair].reach);
    for (int a = 0; a < corners; ++a) {
      SideState& state = result.sides[facet.sides[a]];
      state.area += sums.D[a];
      state.gap += sums.gap[a];
    }
    if (!state_.path) continue;
    for (const auto& covering : sums.masters) {
      const FacetNodal<dim> shared = covering.M * labels_of(at, facet.pair, covering.facet);
      for (int a = 0; a < corners; ++a)
        result.sides[facet.sides[a]].covering += shared.row(a).transpose();
    }
  }
}

/// h of a contact node.
template <int dim>
double MortarTerm<dim>::depth(const Evaluation<dim>& at, const Side& side) const {
  const ContactPatch<dim>& own = patch(side);
  return (own.initial_position - undeformed(at, own.node)).dot(own.initial_normal);
}

template <int dim>
WearMoment MortarTerm<dim>::moment(const Evaluation<dim>& at, const Side& side) const {
  return {
      .time = at.t, .slid = pair(side).slides * state_.nominal_speed * at.t, .within = at.within};
}

/// What a slave node presses with, and whether it slides.
template <int dim>
void MortarTerm<dim>::find_traction(const Evaluation<dim>& at, const Side& side,
                                    SideState& state) const {
  const double lambda = at.values.scalar(state_.lambda)[side.node];
  state.active = at.branch.empty()
                     ? state.area > 0 && lambda * state.area + state_.rho * state.gap <= 0
                     : at.branch[side.first_switch] != 0;
  state.lambda = state.active ? lambda : 0;
  if (state_.path) {
    find_sticking(at, side, state);
  } else if (state.active) {
    const Vector<dim> x = current(at, patch(side).node, place(side));
    state.traction = {SlidingTraction<dim>(patch(side), state.normal->value, x,
                                           places_[side.pair].motion, pair(side).friction),
                      lambda};
  } else {
    state.traction = MortarTraction<dim>(1);
  }
  state.load = -state.lambda * state.area;
  state.rubbing = state.traction.pressure * state.area;
  state.share = {state.traction.pressure, state_.full_pressure};
  state.touching = state.share.value * state.area;
  state.power = state.rubbing * state.traction.speed;
  state.force = state.area * state.traction.value;
}

/// What the slaves press on the masters.
template <int dim>
void MortarTerm<dim>::add_masters(Surfaces& result) const {
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const MortarPair<dim>& pair = state_.pairs[facets_[f].pair];
    for (const auto& covering : (*result.facets)[f].masters)
      for (int b = 0; b < corners; ++b) {
        SideState& master = result.sides[side_of(facets_[f].pair, pair.master[covering.facet][b])];
        for (int a = 0; a < corners; ++a) {
          const SideState& slave = result.sides[facets_[f].sides[a]];
          const double shared = covering.W(a, b), rubbing = slave.traction.pressure * shared;
          master.area += shared;
          master.load -= slave.lambda * shared;
          master.touching += slave.share.value * shared;
          master.rubbing += rubbing;
          master.power += rubbing * slave.traction.speed;
          master.force -= covering.M(a, b) * slave.traction.value;
        }
      }
  }
}

template <int dim>
WearInput MortarTerm<dim>::wear_input_of(const Evaluation<dim>& at, const Side& side,
                                         const SideState& state) const {
  const double p = state.pressure(), v = state.speed();
  Vector<6> variables;
  variables << p, v, depth(at, side), pair(side).friction * p * v, mean_power(at, side),
      state.contact_share();
  return wear_input(patch(side), variables, moment(at, side));
}

template <int dim>
void MortarTerm<dim>::find_wear(const Evaluation<dim>& at, const Side& side,
                                SideState& state) const {
  const ContactPatch<dim>& own = patch(side);
  // What rubs, by the area, may underflow, and derivatives are divided by it.
  constexpr double least = std::numeric_limits<double>::min();
  if (state_.path || !side.slave ? !(state.pressure() >= least) : !state.active) return;
  const PatchNodal<dim> X = positions(at, own, nullptr);
  const double friction = pair(side).friction;
  state.rate = law(side).rate(wear_input_of(at, side, state), law_branch(at, side));
  const double share = state_.path ? state_.path->share : 1;
  for (double* of : {&state.rate.value, &state.rate.by_pressure, &state.rate.by_speed,
                     &state.rate.by_depth, &state.rate.by_friction_power,
                     &state.rate.by_mean_friction_power, &state.rate.by_contact_share})
    *of *= share;
  state.rate_by_pressure =
      state.rate.by_pressure + friction * state.speed() * state.rate.by_friction_power;
  if (side.slave) state.rate_by_pressure += state.rate.by_contact_share * state.share.by_pressure;
  state.rate_by_speed =
      state.rate.by_speed + friction * state.pressure() * state.rate.by_friction_power;
  if (!own.may_move()) return;
  state.direction.emplace(own, X, state_.normal_rule);
  // A node that has just opened wears by a pressure that may be no more than a rounding error.
  if (state.rate.value != 0 && state.active && shape_is_unknown_)
    require_direction(own, state.direction->value);
}

template <int dim>
typename MortarTerm<dim>::Surfaces MortarTerm<dim>::geometry(const Evaluation<dim>& at) const {
  const NodalField<dim>&u = at.values.vector(state_.u), &d = at.values.vector(state_.d);
  if (geometry_ && geometry_->u == u && geometry_->d == d) return geometry_->surfaces;
  Surfaces result;
  result.sides.resize(sides_.size());
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    if (!side.slave) continue;
    SideState& state = result.sides[s];
    const PatchNodal<dim> x = positions(at, patch(side), &place(side));
    const auto along = pair(side).along.find(patch(side).node);
    const Tensor<dim>& turn = place(side).turn;
    state.normal = std::make_shared<const NodeNormal<dim>>(
        patch(side), x,
        along == pair(side).along.end() ? Tensor<dim>(Tensor<dim>::Identity())
                                        : Tensor<dim>(turn * along->second * turn.transpose()));
  }
  add_facets(at, result);
  geometry_ = Geometry{u, d, std::move(result)};
  return geometry_->surfaces;
}

template <int dim>
typename MortarTerm<dim>::Surfaces MortarTerm<dim>::surfaces(const Evaluation<dim>& at) const {
  Surfaces result = geometry(at);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    if (!side.slave) continue;
    result.sides[s].gap +=
        (1 - at.load_fraction) * pair(side).interference * patch(side).initial_area;
    find_traction(at, side, result.sides[s]);
  }
  add_masters(result);
  constexpr double rounding = 1e-12;  // of sums over facets, at the edge of contact
  double largest = 0;
  for (const SideState& state : result.sides) largest = std::max(largest, state.load);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    if (!sides_[s].slave) result.sides[s].active = result.sides[s].load > rounding * largest;
    find_wear(at, sides_[s], result.sides[s]);
  }
  return result;
}

template <int dim>
void MortarTerm<dim>::switching(const Evaluation<dim>& at, std::span<double> values) const {
  const Surfaces result = surfaces(at);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const Side& side = sides_[s];
    const SideState& state = result.sides[s];
    std::span<double> own = values.subspan(
        side.first_switch, static_cast<std::size_t>(contact_switches(side)) + law(side).kinks());
    if (side.slave) {
      const double gap = state.area > 0 ? state.gap / state.area : pair(side).reach;
      own[0] = at.values.scalar(state_.lambda)[side.node] + state_.rho * gap;
      if (state.sticking) own[1] = state.sticking->excess;
    }
    if (law(side).kinks() == 0) continue;
    law(side).switching(wear_input_of(at, side, state), own.subspan(contact_switches(side)),
                        law_branch(at, side));
  }
}

template <int dim>
std::vector<ContactNode<dim>> MortarTerm<dim>::nodes(const Evaluation<dim>& at) const {
  const Surfaces result = surfaces(at);
  const BodyPlace<dim> at_rest;
  std::vector<ContactNode<dim>> nodes(state_.patches.size());
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const SideState& state = result.sides[s];
    ContactNode<dim>& node = nodes[sides_[s].node];
    // A node that the partner hardly covers has a pressure of no meaning.
    const double least = state.load > 0 ? 0.1 * patch(sides_[s]).initial_area : 0;
    const double area = node.area + std::max(state.area, least);
    const double flux = node.area * node.wear_rate, load = node.area * node.traction;
    node.active = node.active || state.active;
    const Tensor<dim>& turn = place(sides_[s]).turn;
    node.force += turn.transpose() * state.force;
    if (state.normal) node.normal = -turn.transpose() * state.normal->value;
    if (!sides_[s].slave && state_.path && state.active)  // what rubs on it is told, too
      node.normal = -NodeNormal<dim>(patch(sides_[s]), positions(at, patch(sides_[s]), &at_rest),
                                     Tensor<dim>::Identity())
                         .value;
    if (state.sticking) {
      node.slip = state.sticking->slip;
      node.friction = state.sticking->friction;
      node.sticks = state.sticking->sticks;
    }
    if (state.direction)
      node.velocity -= weight(sides_[s]) * state.rate.value * state.area * state.direction->value;
    if (sides_[s].slave) {
      node.load = state.load;
      node.own_force = turn.transpose() * state.force;
      node.share = std::max(state.area, 0.0);
      node.gap = state.area > 0 ? state.gap / state.area : pair(sides_[s]).reach;
    }
    if (!(area > 0)) continue;
    node.traction = (load - state.load) / area;
    node.wear_rate = (flux + state.area * state.rate.value) / area;
    node.area = area;
  }
  return nodes;
}

template Vector<2> MortarTerm<2>::undeformed(const Evaluation<2>&, int) const;
template std::pair<FacetPair<2>, std::vector<FacetNodal<2>>> MortarTerm<2>::places_of(
    const SlaveFacet&, const Evaluation<2>&, const Surfaces&) const;
template double MortarTerm<2>::depth(const Evaluation<2>&, const Side&) const;
template WearMoment MortarTerm<2>::moment(const Evaluation<2>&, const Side&) const;
template MortarTerm<2>::Surfaces MortarTerm<2>::geometry(const Evaluation<2>&) const;
template MortarTerm<2>::Surfaces MortarTerm<2>::surfaces(const Evaluation<2>&) const;
template void MortarTerm<2>::switching(const Evaluation<2>&, std::span<double>) const;
template std::vector<ContactNode<2>> MortarTerm<2>::nodes(const Evaluation<2>&) const;
template Vector<3> MortarTerm<3>::undeformed(const Evaluation<3>&, int) const;
template std::pair<FacetPair<3>, std::vector<FacetNodal<3>>> MortarTerm<3>::places_of(
    const SlaveFacet&, const Evaluation<3>&, const Surfaces&) const;
template double MortarTerm<3>::depth(const Evaluation<3>&, const Side&) const;
template WearMoment MortarTerm<3>::moment(const Evaluation<3>&, const Side&) const;
template MortarTerm<3>::Surfaces MortarTerm<3>::geometry(const Evaluation<3>&) const;
template MortarTerm<3>::Surfaces MortarTerm<3>::surfaces(const Evaluation<3>&) const;
template void MortarTerm<3>::switching(const Evaluation<3>&, std::span<double>) const;
template std::vector<ContactNode<3>> MortarTerm<3>::nodes(const Evaluation<3>&) const;

}  // namespace gnomon
