#include "model/rolling_fields.hpp"

#include <algorithm>

namespace gnomon {

namespace {

/// The spin of a moment: each contact node slides along its own direction, by its arm times the
/// one unknown.
template <int dim>
Field spin_field(const Assembly<dim>& body, const Scales& scales, int block) {
  const Rolling<dim>& rolling = *body.interface.rolling;
  const auto count = static_cast<Eigen::Index>(body.contact_nodes.size());
  Field spin("spin_creepage",
             std::vector<int>(body.contact_nodes.size(), static_cast<int>(body.mesh.nodes.size())),
             dim);
  spin.block.setConstant(block);
  spin.carrier.assign(body.contact_nodes.size(), 0);
  spin.direction = Field::Values::Zero(count, dim);
  for (Eigen::Index c = 0; c < count; ++c)
    spin.direction.row(c) =
        rolling.turned(body.contact_nodes[static_cast<std::size_t>(c)].initial_position)
            .first.transpose();
  spin.row_scale.setConstant(scales.force * rolling.arm);
  spin.unknown_scale.setConstant(rolling.creepage_scale / rolling.arm);
  return spin;
}

}  // namespace

template <int dim>
std::pair<FieldId, FieldId> add_creepage(const Assembly<dim>& body, const Scales& scales,
                                         FieldSet& set) {
  const Rolling<dim>& rolling = *body.interface.rolling;
  const int block = set.add({"creepage", "xi", "bodies", Role::rigid});
  Field creepage("creepage", {static_cast<int>(body.mesh.nodes.size())}, dim);
  for (int i = 0; i < dim; ++i)
    if (rolling.force[i]) creepage.block(0, i) = block;
  creepage.row_scale.setConstant(scales.force);
  creepage.unknown_scale.setConstant(rolling.creepage_scale);
  const FieldId along = set.add(std::move(creepage));
  return {along, rolling.moment ? set.add(spin_field(body, scales, block)) : FieldId::none};
}

template <int dim>
FieldId add_mean_power(const Assembly<dim>& body, const Scales& scales, FieldSet& set) {
  const auto reads = [](const Surface<dim>& surface) { return surface.wear.reads_mean(); };
  if (std::ranges::none_of(body.interface.surfaces, reads)) return FieldId::none;
  double friction = body.interface.friction;
  for (const MortarPair<dim>& pair : body.pairs) friction = std::max(friction, pair.friction);
  const int block = set.add({"mean_friction_power", "q_mean", "contacts", Role::rigid});
  const auto at_no_node = static_cast<int>(body.mesh.nodes.size());
  Field mean("mean_friction_power",
             std::vector<int>(std::max<std::size_t>(1, body.pairs.size()), at_no_node), 1);
  mean.block.setConstant(block);
  mean.row_scale.setConstant(friction * body.nominal_speed() * scales.force);
  mean.unknown_scale.setConstant(friction * body.nominal_speed() * scales.stress);
  return set.add(std::move(mean));
}

template std::pair<FieldId, FieldId> add_creepage(const Assembly<2>&, const Scales&, FieldSet&);
template std::pair<FieldId, FieldId> add_creepage(const Assembly<3>&, const Scales&, FieldSet&);
template FieldId add_mean_power(const Assembly<2>&, const Scales&, FieldSet&);
template FieldId add_mean_power(const Assembly<3>&, const Scales&, FieldSet&);

}  // namespace gnomon
