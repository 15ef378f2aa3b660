// Keys that several shapes of counter-bodies share, and how they are read.
#pragma once

#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <string>

namespace gnomon {

/// The vector that a key gives. Throws InputError unless it has `dim` components, and for a
/// direction that is zero.
template <int dim>
Vector<dim> read_direction(const Scene& scene, const std::string& key);
template <int dim>
Vector<dim> read_point(const Scene& scene, const std::string& key);

/// counter_body.center, read by read_point().
Key center_key(const std::string& help);
/// counter_body.axis, read by read_direction().
Key axis_key(const std::string& help);
/// counter_body.side: whether the body is what is inside of the shape, or outside.
Key side_key();
/// Throws InputError for a side of an open curve.
bool is_outside(const Scene& scene);

/// The shape, or its complement where counter_body.side says so.
template <int dim>
CounterShape<dim> convex_or_concave(const Scene& scene, const CounterShape<dim>& shape) {
  return is_outside(scene) ? complement(shape) : shape;
}

/// The point that a key of an axisymmetric scene gives. Throws InputError unless it is on the axis
/// of symmetry, r = 0; `body` is the noun of the message.
Vector<2> read_point_of_axis(const Scene& scene, const std::string& key, const std::string& body);

/// Beginning of a message about counter_body.shape.
std::string shape_origin(const Scene& scene);

}  // namespace gnomon
