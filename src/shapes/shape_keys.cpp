#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

template <int dim>
Vector<dim> read_point(const Scene& scene, const std::string& key) {
  const std::vector<double>& numbers = scene.reals(key);
  if (numbers.size() != dim)
    throw InputError(fmt::format("{}: expected {} numbers {}, got {}", scene.where(key), dim,
                                 dim == 2 ? "in the plane" : "in space", numbers.size()));
  return Eigen::Map<const Vector<dim>>(numbers.data());
}

template <int dim>
Vector<dim> read_direction(const Scene& scene, const std::string& key) {
  const Vector<dim> direction = read_point<dim>(scene, key);
  if (!(direction.norm() > 0))
    throw InputError(scene.where(key) + ": expected a direction, got a vector of length zero");
  return direction;
}

Key center_key(const std::string& help) {
  return reals_key("counter_body.center", "mm", required(), {}, help);
}

Key axis_key(const std::string& help) {
  return reals_key("counter_body.axis", "", required(), {}, help + ", of any length");
}

Key side_key() {
  return text_key("counter_body.side", absent("inside; of a profile left"),
                  "where the counter-body is: inside of the shape, or outside: socket, bore, seat; "
                  "of a profile inside or outside of a closed curve, or left or right of an open "
                  "one, along its points",
                  {"inside", "outside", "left", "right"});
}

bool is_outside(const Scene& scene) {
  const std::string key = "counter_body.side";
  if (!scene.has(key)) return false;
  const std::string& side = scene.text(key);
  if (side != "inside" && side != "outside")
    throw InputError(
        fmt::format("{}: expected \"inside\" or \"outside\", got \"{}\", which is beside an "
                    "open curve, of a profile",
                    scene.where(key), side));
  return side == "outside";
}

Vector<2> read_point_of_axis(const Scene& scene, const std::string& key, const std::string& body) {
  const Vector<2> point = read_point<2>(scene, key);
  if (point[0] != 0)
    throw InputError(fmt::format(
        "{}: expected a point of the axis of symmetry, [0, z], on which {} of an axisymmetric "
        "scene stands, got r = {:g}",
        scene.where(key), body, point[0]));
  return point;
}

std::string shape_origin(const Scene& scene) {
  return scene.knows("counter_body.shape") ? scene.where("counter_body.shape")
                                           : scene.path().string() + ": counter_body.shape";
}

template Vector<2> read_point<2>(const Scene&, const std::string&);
template Vector<3> read_point<3>(const Scene&, const std::string&);
template Vector<2> read_direction<2>(const Scene&, const std::string&);
template Vector<3> read_direction<3>(const Scene&, const std::string&);

}  // namespace gnomon
