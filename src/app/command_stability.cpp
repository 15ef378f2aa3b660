// gnomon stability: the spectrum of the reduced Jacobian along a run, the critical steps of
// explicit methods that follow from it, and the measured onsets of instability.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/fields/block.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/stability/stability.hpp>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "app/commands.hpp"
#include "app/run_end.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

constexpr int modes_shown = 6;

std::vector<double> chosen_times(const StabilityOptions& options, double end) {
  if (options.times.empty()) return {0, end / 5, end};
  std::vector<double> times = options.times;
  for (double time : times)
    if (time < 0 || time > end)
      throw InputError(fmt::format("--time: expected 0 to time.end = {:g} s, got {}", end, time));
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// The named explicit methods, or all if none is named.
std::vector<Integrator> chosen_methods(const std::vector<std::string>& names) {
  const auto bounded = [](const Integrator& integrator) { return integrator.is_explicit(); };
  std::vector<Integrator> methods;
  for (const std::string& name : std::set<std::string>(names.begin(), names.end())) {
    methods.push_back(Integrators::find(name, "integrator"));
    if (!bounded(methods.back()))
      throw InputError(fmt::format("--integrator: expected an explicit method, got {}", name));
  }
  if (names.empty()) std::ranges::copy_if(Integrators::all(), std::back_inserter(methods), bounded);
  return methods;
}

/// Makes the output folder before anything is computed.
void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error) &&
      !std::filesystem::create_directories(folder, error))
    throw InputError(fmt::format("cannot make the folder {}", folder.string()));
}

std::string eigenvalue_text(std::complex<double> value) {
  if (value.imag() == 0) return fmt::format("{:.4g}", value.real());
  return fmt::format("{:.4g} {} {:.4g}i", value.real(), value.imag() < 0 ? '-' : '+',
                     std::abs(value.imag()));
}

/// The printed and written tables, filled state by state.
class Report {
public:
  Report(const Model& model, std::vector<Integrator> methods, const StabilityOptions& options)
      : model_(model), methods_(std::move(methods)), options_(options) {}

  void add(const State& state) {
    if (std::ranges::all_of(state.ydot, [](double rate) { return rate == 0; }))
      throw InputError(fmt::format("nothing wears at t = {:g} s: there is no spectrum", state.t));
    const std::vector<Mode> modes = modes_at(state);
    for (const Mode& mode : modes)
      spectrum_ += fmt::format("{:.10g},{:.10g},{:.10g}\n", state.t, mode.eigenvalue.real(),
                               mode.eigenvalue.imag());
    for (const Integrator& integrator : methods_) add(state, modes, integrator);
  }

  std::string text() const { return table_.text(); }
  void write(const std::filesystem::path& folder) const {
    write_file(folder / "spectrum.csv", spectrum_, Earlier::replaced);
    write_file(folder / "critical_steps.csv", critical_steps_, Earlier::replaced);
  }

private:
  /// The reduced Jacobian, with its factors, is gone before the onset makes its own.
  std::vector<Mode> modes_at(const State& state) const {
    const ReducedJacobian G(model_.system(), state);
    return options_.all ? all_modes(G.dense()) : leading_modes(G, modes_shown);
  }

  void add(const State& state, const std::vector<Mode>& modes, const Integrator& integrator) {
    const CriticalStep critical = critical_step(*integrator.table({}), modes);
    const std::optional<double> onset = observed_onset(state, modes, integrator, critical);
    const double in_contact = value_of(model_.observe(state), "contact_nodes").value_or(0);
    table_.add({fmt::format("{:g}", state.t), fmt::format("{:g}", in_contact),
                modes.empty() ? "-" : eigenvalue_text(modes.front().eigenvalue), integrator.name,
                fmt::format("{:.4g}", critical.step), onset ? fmt::format("{:.4g}", *onset) : "-"});
    critical_steps_ += fmt::format("{:.10g},{},{:.10g},{}\n", state.t, integrator.name,
                                   critical.step, onset ? fmt::format("{:.10g}", *onset) : "");
  }

  /// None if it is not wanted, if there is no mode to perturb, or if no onset was found.
  std::optional<double> observed_onset(const State& state, const std::vector<Mode>& modes,
                                       const Integrator& integrator,
                                       const CriticalStep& critical) const {
    if (options_.no_onset || critical.mode < 0 || critical.step == 0) return std::nullopt;
    try {
      return empirical_onset(model_, integrator, state, modes[critical.mode].direction,
                             critical.step);
    } catch (const SolutionError&) {
      return std::nullopt;
    }
  }

  const Model& model_;
  std::vector<Integrator> methods_;
  const StabilityOptions& options_;
  TextTable table_{"rrrlrr",
                   {"time [s]", "contact nodes", "largest eigenvalue [1/s]", "method",
                    "critical step [s]", "onset [s]"}};
  std::string spectrum_ = "time,real,imag\n";
  std::string critical_steps_ = "time,method,critical_step,empirical\n";
};

/// Whether something follows within a cycle: explicit methods solve for it, others integrate it.
bool remembers(const Model& model) {
  const auto& blocks = model.system().structure().blocks;
  return blocks && std::ranges::any_of(
                       *blocks, [](const Block& block) { return block.role == Role::memory; });
}

/// The scene as a method integrates it.
Setup set_up_for(const StabilityOptions& options, const char* method) {
  const std::string name = "integrator.name=";
  std::vector<std::string> overrides = options.overrides;
  std::erase_if(overrides, [&](const std::string& given) { return given.starts_with(name); });
  overrides.push_back(name + method);
  return set_up(options.scene, overrides);
}

}  // namespace

void stability_command(const StabilityOptions& options) {
  Setup setup = set_up(options.scene, options.overrides);
  std::optional<Setup> explicitly;
  if (remembers(*setup.model)) {
    setup = set_up_for(options, "esdirk-3");
    explicitly = set_up_for(options, "forward-euler");
  }
  if (!(options.rtol > 0 && options.rtol < 1))
    throw InputError(
        fmt::format("--rtol: expected a number between 0 and 1, got {}", options.rtol));
  const std::vector<double> times = chosen_times(options, setup.scene.real("time.end"));
  std::vector<Integrator> methods = chosen_methods(options.methods);
  make_folder(options.folder);
  warn_of_slow_blas();
  Counters counters;
  Report report(explicitly ? *explicitly->model : *setup.model, std::move(methods), options);
  for (const State& state : accurate_states(*setup.model, times, counters, options.rtol))
    report.add(state);
  fmt::print(
      "{}\ncritical step: of the linearized equations, by the method's stability region\n"
      "onset: the step above which a small perturbation grows over {} real steps, to 1 %\n",
      report.text(), onset_steps);
  if (!options.folder.empty()) report.write(options.folder);
}

}  // namespace gnomon::app
