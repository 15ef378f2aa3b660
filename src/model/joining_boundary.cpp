#include <algorithm>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/model/gap_motion.hpp>
#include <gnomon/model/joining_boundary.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/near_facets.hpp"

namespace gnomon {

namespace {

template <int dim>
using Facet = typename Mesh<dim>::Facet;

template <int dim>
std::vector<Facet<dim>> boundary_without_contact(const AssemblyParts<dim>& parts) {
  std::set<Facet<dim>> touching;
  for (const Facet<dim>& facet : facets_of(parts.interface.surfaces))
    touching.insert(sorted(facet));
  std::vector<Facet<dim>> others;
  for (const Facet<dim>& facet : parts.interface.boundary)
    if (!touching.contains(sorted(facet))) others.push_back(facet);
  // Facets on the axis of a body of revolution have no area, and no contact.
  if (dim == 2 && parts.section() == Section::meridian)
    std::erase_if(others, [&](const Facet<dim>& facet) {
      return std::ranges::all_of(facet, [&](int node) { return parts.mesh.nodes[node][0] == 0; });
    });
  return others;
}

/// Whether supports hold the node along its normal.
template <int dim>
bool held_across(const AssemblyParts<dim>& parts, const ContactPatch<dim>& patch) {
  double free = 0;
  for (int i = 0; i < dim; ++i)
    if (!parts.supports.held(patch.node, i))
      free += patch.initial_normal[i] * patch.initial_normal[i];
  return free <= 0.5;
}

}  // namespace

template <int dim>
OtherBoundary<dim>::OtherBoundary(const AssemblyParts<dim>& parts)
    : facets_(boundary_without_contact(parts)),
      patches_(contact_patches<dim>(parts.mesh, facets_, {}, parts.section())) {
  std::set<int> held;
  for (const ContactPatch<dim>& patch : patches_)
    if (held_across(parts, patch)) held.insert(patch.node);
  std::erase_if(patches_, [&](const auto& patch) { return held.contains(patch.node); });
  std::erase_if(facets_, [&](const Facet<dim>& facet) {
    return std::ranges::any_of(facet, [&](int node) { return held.contains(node); });
  });
}

template <int dim>
Surface<dim> OtherBoundary<dim>::joining(
    const std::function<bool(const ContactPatch<dim>&)>& near) const {
  Surface<dim> surface{.name = "", .facets = {}, .wear = WearLaw(), .wears = false};
  std::set<int> reached;
  for (const ContactPatch<dim>& patch : patches_)
    if (near(patch)) reached.insert(patch.node);
  for (const Facet<dim>& facet : facets_)
    if (std::ranges::any_of(facet, [&](int node) { return reached.contains(node); }))
      surface.facets.push_back(facet);
  return surface;
}

namespace {

/// What lies nearer than `distance` to the counter-body in some phase of a state.
template <int dim>
Surface<dim> boundary_within(double distance, const OtherBoundary<dim>& others,
                             const WornBodyEquations<dim>& equations,
                             const FieldValues<dim>& values, double t) {
  std::vector<PartnerMotion<>> q;  // by phase
  for (std::size_t p = 0; p < equations.phases().size(); ++p)
    q.push_back(equations.partner_motion(values, t, p));
  const NodalField<dim>& worn = values.vector(equations.fields().d);
  return others.joining([&](const ContactPatch<dim>& patch) {
    if (is_worn_away(equations.assembly(), worn, patch.initial_position)) return false;
    for (std::size_t p = 0; p < q.size(); ++p) {
      const Vector<dim> d = values.vector(equations.fields(p).d).row(patch.node).transpose(),
                        u = values.vector(equations.fields(p).u).row(patch.node).transpose();
      const SignedDistance<dim> at = equations.phases()[p].counter_body.unchecked_distance(
          patch.initial_position + d + u, q[p], t);
      if (at.gap < distance && faces<dim>(patch.initial_normal, at.normal)) return true;
    }
    return false;
  });
}

template <int dim>
AssemblyParts<dim> with_surface(AssemblyParts<dim> parts, Surface<dim> joining) {
  std::vector<Surface<dim>>& surfaces = parts.interface.surfaces;
  if (surfaces.back().wears)
    surfaces.push_back(std::move(joining));
  else
    surfaces.back().facets.insert(surfaces.back().facets.end(), joining.facets.begin(),
                                  joining.facets.end());
  return parts;
}

/// The values of the same nodes; zero at nodes that a field did not have.
template <int dim>
FieldValues<dim> moved(const FieldSet& from, const FieldValues<dim>& values, const FieldSet& to) {
  FieldValues<dim> result(to);
  for (std::size_t f = 0; f < to.fields.size(); ++f) {
    const std::vector<int>&before = from.fields[f].node, &now = to.fields[f].node;
    const int width = to.fields[f].components();
    if (before == now) {
      std::copy_n(values.data(f), now.size() * width, result.data(f));
      continue;
    }
    std::map<int, std::size_t> place;
    for (std::size_t e = 0; e < before.size(); ++e) place[before[e]] = e;
    for (std::size_t e = 0; e < now.size(); ++e)
      if (const auto found = place.find(now[e]); found != place.end())
        std::copy_n(values.data(f) + found->second * width, width, result.data(f) + e * width);
  }
  return result;
}

}  // namespace

template <int dim>
bool WearModel<dim>::overdue(const State& state) const {
  return !boundary_within(0, *others_, equations_, values(state), state.t).facets.empty();
}

template <int dim>
std::optional<Succession> WearModel<dim>::succeed(const State& state) const {
  const double reach = assembly().interface.reach;
  const FieldValues<dim> values = this->values(state);
  if (boundary_within(reach / 2, *others_, equations_, values, state.t).facets.empty()) return {};
  auto next = std::make_shared<WearModel>(
      with_surface<dim>(assembly(), boundary_within(reach, *others_, equations_, values, state.t)));
  State start{state.t, std::vector<double>(next->system().structure().size), {}};
  FieldValues<dim> with_joined =
      moved(*equations_.composition()->fields, values, *next->equations_.composition()->fields);
  if (assembly().interface.sticks) next->remember_joined(assembly(), state.t, with_joined);
  next->system().numbering().gather(with_joined, start.y);
  // Where no shorter step was found, it is inside of the counter-body.
  Counters counters;
  if (const std::string reason = AlgebraicSolver(next->system(), counters).solve(state.t, start.y);
      !reason.empty())
    throw SolutionError("no equilibrium with the boundary that joins the contact: " + reason);
  set_rates(next->system(), nullptr, start);
  return Succession{std::move(next), std::move(start)};
}

template <int dim>
void WearModel<dim>::remember_joined(const Assembly<dim>& before, double t,
                                     FieldValues<dim>& values) const {
  const NodalField<dim> places =
      equations_.places(system(), values, t, equations_.phases().size() - 1);
  NodalField<dim>& memory = values.vector(equations_.fields().memory);
  for (std::size_t c = 0; c < assembly().contact_nodes.size(); ++c) {
    const int node = assembly().contact_nodes[c].node;
    const auto at = static_cast<std::size_t>(before.contact_node(node));
    const bool known = at < before.contact_nodes.size() && before.contact_nodes[at].node == node;
    if (const auto row = static_cast<Eigen::Index>(c); !known) memory.row(row) = places.row(row);
  }
}

template <int dim>
std::vector<std::vector<Vector<dim>>> WearModel<dim>::positions(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  std::vector<std::vector<Vector<dim>>> all;
  for (std::size_t p = 0; p < equations_.phases().size(); ++p)
    all.push_back(deformed(assembly().mesh, values.vector(equations_.fields().d),
                           values.vector(equations_.fields(p).u)));
  return all;
}

template <int dim>
bool WearModel<dim>::have_moved(const std::vector<std::vector<Vector<dim>>>& x, double part) const {
  for (std::size_t p = 0; p < x.size(); ++p)
    if (have_strayed(assembly(), equations_.phases()[p], x[p], part)) return true;
  return false;
}

/// New candidates before facets leave the margin in which they were found.
template <int dim>
std::optional<Succession> WearModel<dim>::succeed_pairs(const State& state) const {
  std::vector<std::vector<Vector<dim>>> x = positions(state);
  if (!have_moved(x, 0.5)) return {};
  AssemblyParts<dim> parts = assembly();
  parts.near = std::move(x);
  return Succession{
      std::make_shared<WearModel>(std::make_shared<const Assembly<dim>>(std::move(parts))), state,
      true};
}

template class OtherBoundary<2>;
template class OtherBoundary<3>;
template bool WearModel<2>::overdue(const State&) const;
template bool WearModel<3>::overdue(const State&) const;
template std::optional<Succession> WearModel<2>::succeed(const State&) const;
template std::optional<Succession> WearModel<2>::succeed_pairs(const State&) const;
template std::vector<std::vector<Vector<2>>> WearModel<2>::positions(const State&) const;
template std::vector<std::vector<Vector<3>>> WearModel<3>::positions(const State&) const;
template bool WearModel<2>::have_moved(const std::vector<std::vector<Vector<2>>>&, double) const;
template bool WearModel<3>::have_moved(const std::vector<std::vector<Vector<3>>>&, double) const;
template std::optional<Succession> WearModel<3>::succeed_pairs(const State&) const;
template std::optional<Succession> WearModel<3>::succeed(const State&) const;

}  // namespace gnomon
