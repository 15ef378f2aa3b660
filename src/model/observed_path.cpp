#include "model/observed_path.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/model/magnitudes.hpp>

namespace gnomon {

namespace {

template <int dim>
void append(std::vector<double>& to, const Vector<dim>& value) {
  to.insert(to.end(), value.begin(), value.end());
}

}  // namespace

template <int dim>
void add_friction(const std::vector<ContactNode<dim>>& nodes, ContactSurface& surface) {
  for (const ContactNode<dim>& node : nodes) {
    Vector<dim> friction = Vector<dim>::Zero();  // of a pair, where nothing covers the node
    if (node.area > 0) friction = node.traction * node.normal - node.force / node.area;
    append<dim>(surface.phase_traction, friction);
    append<dim>(surface.phase_slip, node.slip);
  }
}

namespace {

/// By the node's own multiplier.
template <int dim>
double carried_pressure(const ContactNode<dim>& node) {
  return node.share > 0 ? node.load / node.share : 0;
}

}  // namespace

template <int dim>
CycleOfSlip cycle_of_slip(const Assembly<dim>& assembly,
                          const std::vector<PhaseContact<dim>>& phases) {
  constexpr double creeping = 1e-3;  // of the longest path: a node at its limit of friction
  CycleOfSlip result;
  std::vector<double> paths(assembly.contact_nodes.size(), 0);
  result.holds.assign(paths.size(), Hold::open);
  for (std::size_t c = 0; c < paths.size(); ++c) {
    if (!assembly.carries[c]) continue;
    for (std::size_t p = 0; p < phases.size(); ++p) {
      const ContactNode<dim>& now = phases[p].nodes[c];
      const ContactNode<dim>& before = phases[(p + phases.size() - 1) % phases.size()].nodes[c];
      if (now.active) result.holds[c] = Hold::slips;
      if (now.sticks || !(now.active || before.active)) continue;
      paths[c] += now.slip.norm();
      result.work += assembly.copies * now.share * now.friction * now.slip.norm() *
                     (carried_pressure(now) + carried_pressure(before)) / 2;
    }
    if (result.holds[c] != Hold::open) result.path = std::max(result.path, paths[c]);
  }
  result.path = largest_over_processes(result.path);
  constexpr double rounding = 1e-6;
  const double least = rounding * assembly.interface.friction * assembly.scales.displacement;
  for (std::size_t c = 0; c < paths.size(); ++c) {
    if (result.holds[c] == Hold::open) continue;
    const bool sticks = paths[c] <= std::max(creeping * result.path, least);
    if (sticks) result.holds[c] = Hold::sticks;
    (sticks ? result.stick_area : result.slip_area) +=
        assembly.copies * phases.front().nodes[c].share;
  }
  result.work = sum_over_processes(result.work);
  result.stick_area = sum_over_processes(result.stick_area);
  result.slip_area = sum_over_processes(result.slip_area);
  return result;
}

namespace {

/// What is not along the approach of the first pair, or of the counter-body.
template <int dim>
Vector<dim> tangential(const Assembly<dim>& assembly, const Vector<dim>& v) {
  const Vector<dim>& normal = assembly.pairs.empty() ? assembly.interface.partner.approach
                                                     : assembly.pairs.front().approach;
  return v - normal * normal.dot(v);
}

}  // namespace

template <int dim>
bool is_rubbed(const Assembly<dim>& assembly, const std::vector<PlaceAndForce<dim>>& loop) {
  constexpr double little = 1e-3;
  const double arm = contact_width<dim>(assembly.scales),
               friction = assembly.interface.friction * assembly.copies * assembly.scales.force;
  return std::ranges::any_of(loop, [&](const PlaceAndForce<dim>& at) {
    const Vector<dim> change = at.friction - loop.front().friction;
    return change.norm() > little * friction ||
           std::abs(at.moment - loop.front().moment) > little * friction * arm;
  });
}

template <int dim>
void observe_path(const Assembly<dim>& assembly, const std::vector<PhaseContact<dim>>& phases,
                  const std::vector<PlaceAndForce<dim>>& loop, int units, Observation& observed) {
  const auto along = [&](const Vector<dim>& v) { return tangential(assembly, v).norm(); };
  double stroke = 0, force = 0, twist = 0, moment = 0;
  for (const PlaceAndForce<dim>& at : loop) {
    force = std::max(force, at.friction.norm());
    moment = std::max(moment, std::abs(at.moment));
    for (const PlaceAndForce<dim>& other : loop) {
      stroke = std::max(stroke, along(at.place - other.place));
      twist = std::max(twist, at.angle - other.angle);
    }
  }
  const CycleOfSlip slip = cycle_of_slip(assembly, phases);
  observed.push_back(common("friction_work", slip.work, units));
  observed.push_back(common("slip_path", slip.path, units));
  observed.push_back(common("stick_area", slip.stick_area, units));
  observed.push_back(common("stroke", stroke));
  observed.push_back(common("friction_force", force, units));
  if (!axis_of_path(assembly)) return;
  observed.push_back(common("twist", twist));
  observed.push_back(common("friction_moment", moment, units));
}

template bool is_rubbed(const Assembly<2>&, const std::vector<PlaceAndForce<2>>&);
template bool is_rubbed(const Assembly<3>&, const std::vector<PlaceAndForce<3>>&);
template void add_friction(const std::vector<ContactNode<2>>&, ContactSurface&);
template void add_friction(const std::vector<ContactNode<3>>&, ContactSurface&);
template CycleOfSlip cycle_of_slip(const Assembly<2>&, const std::vector<PhaseContact<2>>&);
template CycleOfSlip cycle_of_slip(const Assembly<3>&, const std::vector<PhaseContact<3>>&);
template void observe_path(const Assembly<2>&, const std::vector<PhaseContact<2>>&,
                           const std::vector<PlaceAndForce<2>>&, int, Observation&);
template void observe_path(const Assembly<3>&, const std::vector<PhaseContact<3>>&,
                           const std::vector<PlaceAndForce<3>>&, int, Observation&);

}  // namespace gnomon
