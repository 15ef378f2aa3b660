// The counter-body that a scene describes: one table of keys for all registered shapes, its motion,
// and how it is pressed.
#pragma once

#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <vector>

namespace gnomon {

/// counter_body.*: the shape, the keys of all registered shapes, motion and press, for a scene of
/// which only its mesh says whether it is in the plane or in space. What only one shape has is
/// optional here, and vectors have any length; read_counter_body says what is missing or belongs to
/// another shape. Not before all shapes are registered.
std::vector<Key> counter_body_keys();

/// Reads a scene that has these keys. Throws InputError. `motion.reference` is
/// the origin; set it to a point of the contact. A scene in 3D has no section.
/// `normals`: outward, by area, of a surface along which friction holds it; empty: of none.
template <int dim>
CounterBody<dim> read_counter_body(const Scene& scene, Section section = Section::plane,
                                   const std::vector<Vector<dim>>& normals = {});

/// A point of the axis of a rotation that the key `rotation` gives: that of the key `center`, by
/// default the middle of the shape. Throws InputError.
template <int dim>
Vector<dim> rotation_center(const Scene& scene, const std::string& rotation,
                            const std::string& center = "counter_body.motion.center");
/// The spin of a rotation with that rate; in space about the direction of the key `axis`, by
/// default the axis of the shape. Throws InputError.
template <int dim>
Tensor<dim> rotation_spin(const Scene& scene, double rate, const std::string& rotation,
                          const std::string& axis = "counter_body.motion.axis");

}  // namespace gnomon
