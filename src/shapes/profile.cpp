#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/base/number_text.hpp>
#include <gnomon/shapes/profile.hpp>
#include <gnomon/shapes/shape_keys.hpp>
#include <iterator>
#include <memory>
#include <string_view>

namespace gnomon {

/// With tangent t, outward normal n on the right of it and curvature kappa, positive where the
/// curve turns left, about the body: the offset at the distance g has the curvature
/// kappa / (1 + kappa g).
CounterShape<2> profile(const SplineCurve& curve) {
  const auto shared = std::make_shared<const SplineCurve>(curve);
  const auto distance = [shared](const Vector<2>& x) {
    constexpr double focal = 1e-9;
    const SplineCurve::Nearest nearest = shared->nearest(x);
    const auto& [position, first, second] = nearest.place;
    const double speed = first.norm();
    const Vector<2> t = first / speed, n(t[1], -t[0]);
    const double gap = n.dot(x - position);
    const double curvature =
        (first[0] * second[1] - first[1] * second[0]) / (speed * speed * speed);
    const double stretch = 1 + curvature * gap;
    return SignedDistance<2>{gap, n, curvature / stretch * t * t.transpose(),
                             nearest.unique && stretch > focal};
  };
  return {distance, shared->extent()};
}

namespace {

constexpr std::string_view separators = " \t\r,;";

/// The fields of a line; what follows # is not read.
std::vector<std::string_view> fields_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t start = line.find_first_not_of(separators);
    if (start == std::string_view::npos) return fields;
    line.remove_prefix(start);
    const std::size_t length = std::min(line.find_first_of(separators), line.size());
    fields.push_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

/// Of the whole field, "nan" and "inf" included.
std::optional<double> read_number(std::string_view field) {
  return parsed_number<double>(field.substr(field.starts_with('+') ? 1 : 0));
}

/// Whether a field is meant as a number, be it out of range or followed by a unit.
bool looks_like_number(std::string_view field) {
  const std::size_t digit = field.find_first_not_of("+-.");
  return read_number(field) ||
         (digit != std::string_view::npos && field[digit] >= '0' && field[digit] <= '9');
}

std::string shown(std::string_view line) {
  constexpr std::size_t most = 40;
  std::string text;
  for (const char c : line.substr(0, most)) text += c >= ' ' && c <= '~' ? c : '?';
  return "`" + text + (line.size() > most ? "...`" : "`");
}

}  // namespace

std::vector<Vector<2>> parse_points(const std::string& text, const std::string& name) {
  std::vector<Vector<2>> points;
  std::string_view rest = text;
  if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);  // a byte order mark
  bool header_allowed = true;
  for (int number = 1; !rest.empty(); ++number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const auto fields = fields_of(line);
    if (fields.empty()) continue;
    const auto x = read_number(fields[0]), y = read_number(fields.back());
    if (fields.size() == 2 && x && y && std::isfinite(*x) && std::isfinite(*y)) {
      if (points.size() == SplineCurve::max_points)
        throw InputError(fmt::format("{}:{}: expected {} points or fewer", name, number,
                                     SplineCurve::max_points));
      points.emplace_back(*x, *y);
    } else if (!header_allowed || std::ranges::any_of(fields, looks_like_number)) {
      throw InputError(
          fmt::format("{}:{}: expected two finite numbers, got {}", name, number, shown(line)));
    }
    header_allowed = false;
  }
  if (points.empty())
    throw InputError(
        fmt::format("{}: expected two numbers per line, got no line with numbers", name));
  return points;
}

std::vector<Vector<2>> read_points(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_bytes = 10'000'000;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(fmt::format(
        "{}: expected a file of points, {}", file.string(),
        std::filesystem::exists(file, error) ? "this is something else" : "there is none"));
  if (std::filesystem::file_size(file, error) > most_bytes)
    throw InputError(
        fmt::format("{}: expected a file of {} bytes or less", file.string(), most_bytes));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  return parse_points({std::istreambuf_iterator<char>(stream), {}}, file.string());
}

std::vector<Vector<2>> read_points(const Scene& scene, const std::string& key) {
  try {
    return read_points(scene.path().parent_path() / scene.text(key));
  } catch (const InputError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

namespace {

std::vector<Vector<2>> points_of(const Scene& scene) {
  if (scene.has_text_instead("counter_body.points"))
    return read_points(scene, "counter_body.points");
  const std::vector<double>& flat = scene.reals("counter_body.points");
  if (flat.size() % 2 != 0)
    throw InputError(fmt::format(
        "{}: expected two numbers for each point, one point after the other, got {} numbers",
        scene.where("counter_body.points"), flat.size()));
  std::vector<Vector<2>> points;
  for (std::size_t k = 0; k < flat.size(); k += 2) points.emplace_back(flat[k], flat[k + 1]);
  return points;
}

/// Left of an open curve where the scene does not say.
std::string side_of(const Scene& scene) {
  return scene.has("counter_body.side") ? scene.text("counter_body.side") : "left";
}

/// Whether the body is on the right of the curve as it was given.
bool body_on_the_right(const std::string& side, const SplineCurve& curve) {
  return curve.closed() ? (curve.signed_area() < 0) != (side == "outside") : side == "right";
}

}  // namespace

SplineCurve read_profile(const Scene& scene) {
  const std::vector<Vector<2>> points = points_of(scene);
  const std::string side = side_of(scene);
  try {
    const SplineCurve curve(points, side == "inside" || side == "outside");
    return body_on_the_right(side, curve) ? curve.reversed() : curve;
  } catch (const CurveError& error) {
    throw InputError(scene.where("counter_body.points") + ": " + error.what());
  }
}

Scene with_profile_points(const Scene& scene) {
  if (!scene.has_text_instead("counter_body.points")) return scene;
  std::vector<double> flat;
  for (const Vector<2>& point : points_of(scene)) flat.insert(flat.end(), {point[0], point[1]});
  return scene.with("counter_body.points", flat);
}

}  // namespace gnomon
