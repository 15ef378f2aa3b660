// Spreads a declaration out: the product of the swept values, and the runs of each.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <gnomon/base/error.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/study/study.hpp>
#include <map>
#include <set>

#include "study/declaration.hpp"
#include "study/run_scenes.hpp"

namespace gnomon {

namespace {

using namespace study;
using Kind = StudySetting::Kind;

/// What a name of a file can safely hold.
std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.';
    name += plain ? c : '_';
  }
  return name;
}

std::string last_part(const std::string& label) {
  return label.substr(label.rfind('.', label.find('=')) + 1);
}

/// For each combination of swept values: the times at which errors are measured, the references
/// (runs, or the closed form), and one run for each method and each of its steps or tolerances.
/// Runs whose scenes are equal are one.
class Expansion {
public:
  Expansion(const Declaration& declaration, Impossible impossible)
      : declaration_(declaration),
        kept_(impossible == Impossible::kept),
        scenes_(declaration.scene) {
    study_.file = declaration.file;
    study_.name = study_.file.stem().string();
    study_.title = declaration.title;
    study_.scene = declaration.scene;
    study_.text = declaration.text;
    study_.compared = declaration.compared;
    for (const Sweep& sweep : declaration.sweeps) study_.units[sweep.key] = sweep.unit;
    if (const auto& self = declaration.self_reference)
      study_.self_reference = title(declaration.methods[self->method], self->setting);
  }

  Study operator()() {
    check_count();
    std::vector<std::size_t> choice(declaration_.sweeps.size(), 0);
    do add_sweep_point(choice);
    while (advance(choice));
    return std::move(study_);
  }

private:
  /// Some values each of a few keys are more runs than anyone can wait for, or hold in memory.
  void check_count() const {
    constexpr double most = 10'000;
    double points = 0;
    for (const Method& method : declaration_.methods) points += double(method.ladder.size());
    for (const Sweep& sweep : declaration_.sweeps) points *= double(sweep.values.size());
    if (points > most)
      throw InputError(fmt::format("{}: expected at most {} runs, sweeps and methods make {}",
                                   declaration_.file, most, points));
  }

  /// Errors that only the whole scene shows are said to be of this study, sweep point and run.
  template <class Function>
  auto guarded(const std::string& what, const Function& function) const {
    try {
      return function();
    } catch (const InputError& error) {
      const std::string& label = study_.sweep.back().label;
      throw InputError(fmt::format("{}: {}{}{}: {}", declaration_.file, label,
                                   label.empty() || what.empty() ? "" : ", ", what, error.what()));
    }
  }

  /// The next combination, the last sweep fastest; false after the last one.
  bool advance(std::vector<std::size_t>& choice) const {
    for (std::size_t i = choice.size(); i-- > 0;) {
      if (++choice[i] < declaration_.sweeps[i].values.size()) return true;
      choice[i] = 0;
    }
    return false;
  }

  void add_sweep_point(const std::vector<std::size_t>& choice) {
    SweepPoint point;
    std::vector<std::string> labels, parts;
    overrides_.clear();
    override_with(declaration_.common);
    for (std::size_t i = 0; i < choice.size(); ++i) {
      const Sweep& sweep = declaration_.sweeps[i];
      override_with({sweep.values[choice[i]]});
      point.values.push_back({sweep.key, sweep.labels[choice[i]]});
      labels.push_back(sweep.key + "=" + sweep.labels[choice[i]]);
      parts.push_back(last_part(labels.back()));
    }
    point.label = fmt::format("{}", fmt::join(labels, "; "));
    prefix_ = fmt::format("{}", fmt::join(parts, "__"));
    study_.sweep.push_back(std::move(point));
    add_ways_to_measure();
    for (std::size_t i = 0; i < declaration_.methods.size(); ++i) add_points(i);
  }

  /// False where a scene cannot be, if such scenes are kept.
  template <class Function>
  bool possible(const Function& function) const try {
    function();
    return true;
  } catch (const InputError&) {
    if (!kept_) throw;
    return false;
  }

  /// An impossible sweep point has nothing to measure.
  void add_ways_to_measure() {
    double end = 0;
    if (!possible(
            [&] { end = guarded("", [&] { return scenes_.with(overrides_).real("time.end"); }); }))
      return;
    add_times(end);
    if (possible([&] { add_references(); })) return;
    SweepPoint& point = study_.sweep.back();
    point.times.clear();
    point.exact.clear();
    point.references.clear();
  }

  void override_with(const std::vector<SceneSetting>& settings) {
    for (const SceneSetting& setting : settings) overrides_[setting.key] = setting.value;
  }

  void add_times(double end) {
    auto& times = study_.sweep.back().times;
    times = declaration_.times;
    if (times.empty() && !kept_ &&
        study_.compared)  // verdicts look at the end, and want no step cut short before
      for (int i = 1; i < 5; ++i) times.push_back(end * i / 5);
    for (const double time : times)
      if (time > end)
        throw InputError(fmt::format("{}: expected times up to time.end = {:g} s, got {:g}",
                                     declaration_.times_origin, end, time));
    std::sort(times.begin(), times.end());
    times.push_back(end);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    require_apart(times, declaration_.times_origin);
  }

  /// Runs two references, unless the problem has a closed form and no [[reference]] is given, or
  /// nothing is compared. Makes the model, which checks what only it can check.
  void add_references() {
    SweepPoint& point = study_.sweep.back();
    const Method& first = declaration_.methods.front();
    const Scene scene = scene_of(first, first.ladder.front());
    guarded(first.name, [&] {
      const auto model = make_model(scene);
      if (study_.compared && !declaration_.chosen_references)
        point.exact = closed_form(*model, point.times);
    });
    if (point.has_closed_form()) return;
    for (const Method& method : declaration_.references)
      point.references.push_back(run_of(method, method.ladder.front()));
  }

  void add_points(std::size_t index) {
    const Method& method = declaration_.methods[index];
    const auto& self = declaration_.self_reference;
    bool has_self = false;
    for (const StudySetting& setting : method.ladder) {
      add_point(method, setting);
      if (self && self->method == index && self->setting.kind == setting.kind &&
          self->setting.value == setting.value)
        has_self = true;
    }
    if (!self || self->method != index) return;
    if (!has_self) add_point(method, self->setting);
    study_.sweep.back().self_reference = run_of(method, self->setting);
  }

  void add_point(const Method& method, const StudySetting& setting) {
    StudyPoint point{study_.sweep.size() - 1, run_of(method, setting), method.name,
                     method.integrator, setting};
    if (kept_ && setting.kind == Kind::step && study_.runs[point.run].overrides.empty())
      point.half = run_of(method, {Kind::step, setting.value / 2});
    study_.points.push_back(std::move(point));
  }

  SceneValues overrides_of(const Method& method, const StudySetting& setting) const {
    return values_of_run(overrides_, method, setting, study_.sweep.back().times);
  }

  Scene scene_of(const Method& method, const StudySetting& setting) const {
    return guarded(title(method, setting), [&] {
      return scenes_.of_run(overrides_of(method, setting), setting.kind, study_.compared);
    });
  }

  /// The scene of a run; an impossible one is the study's own scene, and what makes it impossible.
  std::pair<Scene, std::vector<std::string>> scene_and_overrides(const Method& method,
                                                                 const StudySetting& setting) const
      try {
    return {scene_of(method, setting), {}};
  } catch (const InputError&) {
    if (!kept_) throw;
    return {scenes_.complete({}), override_texts(overrides_of(method, setting))};
  }

  /// The run of this scene, a new one unless there is one already.
  std::size_t run_of(const Method& method, const StudySetting& setting) {
    auto [scene, further] = scene_and_overrides(method, setting);
    std::string resolved = scene.resolved();
    const std::string text = fmt::format("{}{}", resolved, fmt::join(further, "\n"));
    const auto [place, is_new] = runs_.try_emplace(text, study_.runs.size());
    if (is_new) {
      const std::string stem =
          file_name(fmt::format("{}{}{}__{}-{}", prefix_, prefix_.empty() ? "" : "__", method.name,
                                kind_name(setting.kind), number_text(setting.value)));
      std::string name = stem;  // names that differ in what files cannot be called get numbers
      for (int i = 2; names_.contains(name); ++i) name = fmt::format("{}__{}", stem, i);
      constexpr std::size_t longest = 200;  // bytes; file systems take 255, with suffixes
      if (name.size() > longest)
        throw InputError(
            fmt::format("{}: expected names that make files of {} bytes or less, got {}",
                        method.origin, longest, name.size()));
      names_.insert(name);
      study_.runs.push_back(
          {name, title(method, setting), std::move(resolved), std::move(further)});
    }
    return place->second;
  }

  static std::string title(const Method& method, const StudySetting& setting) {
    return fmt::format("{} {} {}", method.name, kind_name(setting.kind),
                       number_text(setting.value));
  }

  const Declaration& declaration_;
  const bool kept_;
  Study study_;
  const RunScenes scenes_;
  SceneValues overrides_;                    // of the sweep point
  std::string prefix_;                       // of the names of its runs
  std::map<std::string, std::size_t> runs_;  // resolved scene, index
  std::set<std::string> names_;
};

}  // namespace

std::vector<ContactSurface> study::closed_form(const Model& model,
                                               const std::vector<double>& times) {
  std::vector<ContactSurface> surfaces;
  if (!model.exact || !model.exact(times.back())) return surfaces;
  for (const double t : times) {
    const auto surface = model.contact(*model.exact(t));
    if (!surface) throw InputError("the problem has no contact surface, expected one to compare");
    surfaces.push_back(*surface);
  }
  return surfaces;
}

Study load_study(const std::filesystem::path& file, Impossible impossible) {
  const Declaration declaration = read_declaration(file, impossible);
  return Expansion(declaration, impossible)();
}

}  // namespace gnomon
