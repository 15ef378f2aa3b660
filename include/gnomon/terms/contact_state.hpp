// A contact state of a deformed body and its rigid partner: what its terms are made from.
#pragma once

#include <algorithm>
#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/term.hpp>
#include <limits>
#include <vector>

namespace gnomon {

/// One contact state: its fields and constants. The referenced objects must outlive the term.
template <int dim>
struct ContactState {
  FieldId u = FieldId::none;       ///< displacement, at all nodes of the mesh
  FieldId lambda = FieldId::none;  ///< contact multiplier, at the contact nodes
  FieldId q = FieldId::none;  ///< motion of the partner, at each of its guides; none: no motion
  FieldId mean_power = FieldId::none;  ///< mean of q over the contact, of laws that read it
  const Mesh<dim>& mesh;
  ContactParameters<dim> parameters;  ///< those of all phases of a cycle but for the counter-body
  const std::vector<ContactPatch<dim>>& patches;
  /// Part of each contact node in the wear rate of its shape unknowns; empty: 1. With a section,
  /// the length that the node represents divided by the length of the path.
  const std::vector<double>& wear_weight;
  const std::vector<int>& surface_of;  ///< each contact node: whose law wears it
  std::vector<WearLaw> laws{};         ///< of the surfaces
  double part = 1;                     ///< of the mean over a cycle: the weight of its phase
  double nominal_speed = 0;            ///< at which the bodies slide [length / time]
  /// Of bodies that nothing else presses: how deep they lie in the partner at rest [length].
  double interference = 0;

  /// A load ramp begins where they touch.
  double clearance(const Evaluation<dim>& at) const {
    return (1 - at.load_fraction) * interference;
  }
};

/// The motion q of the partner of a contact state: its unknown and its given part. In a load ramp
/// it comes from where it would touch the body at rest.
template <int dim>
class MotionOfPartner {
public:
  explicit MotionOfPartner(const ContactState<dim>& state) : body_(state.parameters.counter_body) {
    if (!body_.is_given()) return;
    double touching = std::numeric_limits<double>::infinity(), travel = 0;
    for (const ContactPatch<dim>& patch : state.patches)
      touching =
          std::min(touching, body_.travel_to(state.mesh.nodes[patch.node], patch.initial_normal));
    const PartnerMotion<> given = body_.given(0, 0);
    for (std::size_t k = 0; k < body_.guides.size(); ++k)
      travel += body_.guides[k].share * given[k];
    overlap_ = std::max(0.0, travel - touching);
  }

  /// `unknown`: its field, or none.
  PartnerMotion<> at(const Evaluation<dim>& at, FieldId unknown) const {
    PartnerMotion<> q = body_.given(at.t, at.within);
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      if (unknown != FieldId::none) q[k] += at.values.scalar(unknown)[k];
      if (body_.guides[k].travel) q[k] -= (1 - at.load_fraction) * overlap_ * body_.guides[k].share;
    }
    return q;
  }

private:
  CounterBody<dim> body_;
  double overlap_ = 0;  // of the body at rest, by the given motion at t = 0 [length]
};

}  // namespace gnomon
