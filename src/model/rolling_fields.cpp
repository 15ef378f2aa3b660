#include "model/rolling_fields.hpp"

namespace gnomon {

template <int dim>
FieldId add_creepage(const Assembly<dim>& body, const Scales& scales, FieldSet& set) {
  const Rolling<dim>& rolling = *body.interface.rolling;
  const int block = set.add({"creepage", "xi", "bodies", Role::rigid});
  Field creepage("creepage", {static_cast<int>(body.mesh.nodes.size())}, dim);
  for (int i = 0; i < dim; ++i)
    if (rolling.force[i]) creepage.block(0, i) = block;
  creepage.row_scale.setConstant(scales.force);
  creepage.unknown_scale.setConstant(rolling.creepage_scale);
  return set.add(std::move(creepage));
}

template FieldId add_creepage(const Assembly<2>&, const Scales&, FieldSet&);
template FieldId add_creepage(const Assembly<3>&, const Scales&, FieldSet&);

}  // namespace gnomon
