// Errors of the runs of a study against the references of its sweep points.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <gnomon/study/study.hpp>

#include "study/run_files.hpp"

namespace gnomon {

namespace {

using namespace study;

/// The contact surface at the measured times.
using Surfaces = std::vector<ContactSurface>;

struct Errors {
  double shape = 0, shape_max = 0, pressure = 0;
};

Errors errors_between(const Surfaces& surfaces, const Surfaces& reference) {
  Errors errors;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    errors.shape = shape_error(surfaces[i], reference[i]);
    // A NaN in shape_max stays.
    if (!(errors.shape <= errors.shape_max) && !std::isnan(errors.shape_max))
      errors.shape_max = errors.shape;
  }
  errors.pressure = pressure_error(surfaces.back(), reference.back());
  return errors;
}

double wear_of(const ContactSurface& surface) {
  double sum = 0;
  for (const double depth : surface.wear_depth) sum += depth * depth;
  return std::sqrt(sum);
}

double largest_pressure(const ContactSurface& surface) {
  double largest = 0;
  for (const double pressure : surface.pressure) largest = std::max(largest, pressure);
  return largest;
}

class Measurement {
public:
  Measurement(const Study& study, const std::filesystem::path& folder)
      : study_(study), folder_(folder) {}

  StudyTable operator()() {
    for (const SweepPoint& sweep : study_.sweep) add_reference(sweep);
    for (const StudyPoint& point : study_.points) table_.rows.push_back(row(point));
    return std::move(table_);
  }

private:
  RunFiles files(std::size_t run) const { return files_of_run(folder_, study_.runs[run].name); }

  /// Reads the record and the surfaces of a run; a result that cannot be read is a failure with its
  /// reason.
  RunRecord record_of(std::size_t run, const SweepPoint& sweep, Surfaces& surfaces) const {
    auto found = read_record(files(run), study_.runs[run]);
    if (!found) return {.status = "missing", .reason = "not done"};
    if (found->status != "finished" || !study_.compared) return *found;
    try {
      surfaces = read_surfaces(files(run), sweep.times);
    } catch (const Error& error) {
      found->status = "failed";
      found->reason = error.what();
    }
    return *found;
  }

  /// Adds two references and their difference; or one whose error is unknown; or none.
  void add_reference(const SweepPoint& sweep) {
    StudyReference& reference = table_.references.emplace_back();
    Surfaces& chosen = surfaces_.emplace_back(sweep.exact);
    Surfaces& self = self_surfaces_.emplace_back();
    if (!study_.compared) {
      reference.text = "none";
      return;
    }
    if (sweep.self_reference) record_of(*sweep.self_reference, sweep, self);
    if (sweep.has_closed_form()) {
      reference = {.text = "closed form",
                   .usable = true,
                   .error = 0.0,
                   .error_max = 0.0,
                   .pressure_error = std::nullopt,
                   .wear = wear_of(chosen.back())};
      return;
    }
    std::vector<Surfaces> found;
    std::vector<std::string> used, failed;
    for (const std::size_t run : sweep.references) {
      Surfaces surfaces;
      const RunRecord record = record_of(run, sweep, surfaces);
      const std::string& title = study_.runs[run].title;
      if (surfaces.empty()) {
        failed.push_back(fmt::format("{} failed: {}", title, record.reason));
      } else {
        found.push_back(std::move(surfaces));
        used.push_back(title);
      }
    }
    describe(reference, used, failed);
    if (found.empty()) return;
    chosen = std::move(found.front());
    reference.wear = wear_of(chosen.back());
    reference.pressure = largest_pressure(chosen.back());
    if (found.size() < 2) return;
    const Errors errors = errors_between(chosen, found.back());
    reference.error = errors.shape;
    reference.error_max = errors.shape_max;
    reference.pressure_error = errors.pressure;
  }

  static void describe(StudyReference& reference, const std::vector<std::string>& used,
                       const std::vector<std::string>& failed) {
    reference.usable = !used.empty();
    if (!used.empty()) reference.text = used.front();
    if (used.size() > 1) reference.text += " checked by " + used[1];
    if (used.size() == 1) reference.text += " unchecked";
    for (const std::string& text : failed)
      reference.text += (reference.text.empty() ? "" : "; ") + text;
  }

  StudyRow row(const StudyPoint& point) const {
    const SweepPoint& sweep = study_.sweep[point.sweep];
    Surfaces surfaces;
    StudyRow row;
    static_cast<RunRecord&>(row) = record_of(point.run, sweep, surfaces);
    row.point = point;
    row.sweep = sweep.label;
    if (row.status == "finished") add_observed(row);
    if (!surfaces.empty()) add_errors(row, surfaces);
    if (point.half) add_half(row, sweep);
    return row;
  }

  void add_half(StudyRow& row, const SweepPoint& sweep) const {
    Surfaces surfaces;
    row.half = record_of(*row.point.half, sweep, surfaces);
    const Surfaces& reference = surfaces_[row.point.sweep];
    if (!surfaces.empty() && !reference.empty())
      row.half_error = errors_between(surfaces, reference).shape;
  }

  void add_observed(StudyRow& row) const try {
    row.observed = read_observed(files(row.point.run));
  } catch (const Error& error) {
    row.status = "failed";
    row.reason = error.what();
  }

  void add_errors(StudyRow& row, const Surfaces& surfaces) const {
    const std::size_t sweep = row.point.sweep;
    const StudyReference& reference = table_.references[sweep];
    if (reference.usable) {
      const Errors errors = errors_between(surfaces, surfaces_[sweep]);
      row.shape_error = errors.shape;
      row.shape_error_max = errors.shape_max;
      const bool closed = study_.sweep[sweep].has_closed_form();  // has no pressures
      if (!closed) row.pressure_error = errors.pressure;
      const auto mark = [](double error, const std::optional<double>& own) {
        return !own || error < 10 * *own;
      };
      row.marked_shape = mark(errors.shape, reference.error);
      row.marked_max = mark(errors.shape_max, reference.error_max);
      row.marked_pressure = !closed && mark(errors.pressure, reference.pressure_error);
    }
    const Surfaces& self = self_surfaces_[sweep];
    if (!self.empty() && row.point.run != study_.sweep[sweep].self_reference) {
      // In the same measure, where the reference has another mesh.
      const Surfaces& reference_surfaces = surfaces_[sweep];
      const bool other_mesh = !reference_surfaces.empty() &&
                              reference_surfaces.back().initial != surfaces.back().initial;
      row.shape_error_self = other_mesh ? distance_error(surfaces.back(), self.back())
                                        : shape_error(surfaces.back(), self.back());
    }
  }

  const Study& study_;
  const std::filesystem::path folder_;
  StudyTable table_;
  std::vector<Surfaces> surfaces_, self_surfaces_;  // of the references, one per sweep point
};

}  // namespace

StudyTable measure(const Study& study, const std::filesystem::path& folder) {
  return Measurement(study, folder)();
}

}  // namespace gnomon
