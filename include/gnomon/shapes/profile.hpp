// Counter-bodies bounded by a curve through given points: cams, rails, rollers, seats.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shapes/counter_shape.hpp>
#include <gnomon/shapes/spline_curve.hpp>

namespace gnomon {

/// The body on the left of the curve, as one sees it that runs along it. Inside a closed curve that
/// runs anticlockwise. The closest point is not unique at and beyond the centre of curvature, and
/// where two parts of the curve are equally near.
CounterShape<2> profile(const SplineCurve& curve);

/// The points of a text of two numbers per line, separated by commas, semicolons or white space;
/// one line without numbers before them is a header, empty lines and those with # are left out.
/// Throws InputError with file and line.
std::vector<Vector<2>> read_points(const std::filesystem::path& file);
/// The same of the file that a key of the scene names, beside the scene; the message begins with
/// the place in the scene.
std::vector<Vector<2>> read_points(const Scene& scene, const std::string& key);
/// The same of a text; `name` stands for the file in messages.
std::vector<Vector<2>> parse_points(const std::string& text, const std::string& name);

/// The curve of counter_body.points, with the body on its left, as counter_body.side says. A file
/// is looked for beside the scene. Throws InputError.
SplineCurve read_profile(const Scene& scene);

/// The same scene, with the points themselves in the place of a file in counter_body.points, so
/// that a result needs no other file. Where there is no such file, the scene itself.
Scene with_profile_points(const Scene& scene);

}  // namespace gnomon
