// gnomon help TOPIC and gnomon --version.

#include <fmt/format.h>

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/study/study.hpp>

#include "app/commands.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

constexpr const char* scene_topic =
    R"(A scene is a TOML file that holds every parameter of one run. `gnomon list scenes` shows those
that come with gnomon, `gnomon check SCENE.toml` prints one in full, defaults included, and `--set
KEY=VALUE` replaces a key for one run (a text needs no quotes there). The printed text is itself a
scene; a line `# KEY = ...` names an optional key without a value and says what its absence means.
)";

constexpr const char* studies_topic =
    R"(A study is a TOML file that describes many runs of one scene: several methods, each with a list of
steps or tolerances, for all combinations of swept scene keys. `gnomon list studies` shows the
studies that come with gnomon.

    scene = "../small_deformation.toml"
    [set]                           # scene keys of all runs; also [method.set], [reference.set]
    mesh.elements = [20, 20]
    [[sweep]]
    key = "body.young_modulus"
    values = [20, 640]
    [[method]]
    integrator = "backward-euler"
    steps = [5, 50]
    [[method]]
    integrator = "bdf"
    tolerances = [1e-3, 1e-5]

Errors are measured against a closed form if the problem has one. Otherwise two runs with tight
tolerances, of different families, are the reference; their difference estimates its error, and
errors below ten times this difference are marked. Several runs are done at the same time
(--jobs); for times that can be compared, use --jobs 1 on an idle machine. The folder of the
results holds study.csv, study.json, study.h5, runs/ and the page index.html; if the packages that
draw it are missing, gnomon plot draws it later. --resume continues a study that was interrupted or
killed. A run that fails stays in the table with its reason; the exit code is 3 only if all runs
fail.

For a parameter sweep, `reference = "none"` leaves errors out, and methods may be absent: the table
has the worn volume, the largest pressure and all else that the runs observe.

    gnomon study plan STUDY.toml -o DIR    the folder, with numbered runs
    gnomon study run DIR 3-7               some of them, on any machine that has the folder
    gnomon study collect DIR               the tables
    gnomon study STUDY.toml --executor slurm --slurm-option=--time=60    all of it, by Slurm
)";

constexpr const char* integrators_topic =
    R"(Without integrator.step a method chooses its steps so that the estimated error of the worn surface
stays below integrator.rtol and .atol in every step. With it the steps are fixed; a step whose
equations cannot be solved is halved and counted as rejected. Where a contact node switches within
a step, the order of every method falls to two; integrator.events = "locate" ends steps there, and
the method keeps its order. Explicit methods are unstable above a critical step that is
proportional to mesh size / Young's modulus; `gnomon stability SCENE.toml` computes it.
)";

constexpr const char* units_topic =
    R"(A scene uses one consistent set of units. gnomon names the units of the paper:

    length       mm
    force        N      (N/mm in 2D: per unit of thickness)
    stress       MPa = N/mm^2
    time         s
    wear volume  mm^3   (mm^2 in 2D)

Any other consistent set works as well; the printed names of units are then wrong.
)";

constexpr const char* output_topic =
    R"(gnomon run writes one HDF5 file, and an XDMF file of the same name beside it for ParaView:

    the mesh once, in the initial configuration, and per stored step displacement, shape, nodal
    pressure, equivalent stress and element quality; in the group /gnomon the contact surface, the
    scalars, sizes, orders and counters of every step, the resolved scene and versions.

Existing files are not overwritten. --force replaces the files of an earlier run with these names,
once the start is solved; if the start fails, they are not changed.

In ParaView open the .xdmf file; Warp By Vector with `shape` shows the worn body, with
`displacement` added the deformed one. Which steps are stored is set by output.every, output.times,
output.interval; the start and the end are always stored.

The file is readable during the run, and after Ctrl-C, a failure or a crash it holds everything up
to the last step. Ctrl-C and SIGTERM end a run at its last step, with a checkpoint there. A run that
was resumed agrees with one that was not interrupted within the tolerance of Newton's method; bdf
begins at order one. Without a checkpoint `gnomon resume` begins at the start. When a run is resumed,
--set may change the end, tolerances and steps of the integrator, output.* and solver.*. The result
is replaced when the new one has reached the same time.

    gnomon resume RESULT.h5        continues from its last checkpoint; --end T
    gnomon info RESULT.h5          shows its contents
    gnomon contact RESULT.h5       the contact surface as CSV
    gnomon compare RESULT.h5...    several runs side by side
    gnomon plot RESULT.h5...       figures: shape, pressure, history, stress, worn volume
    gnomon run --summary FILE      the end of a run as JSON
)";

constexpr const char* exit_codes_topic =
    R"(0  done
1  every other failure, including a run ended by Ctrl-C or SIGTERM
2  bad input (scene, command line, result file): one line on stderr for each mistake, nothing written
3  the solution failed: a diagnosis on stderr, the last good state in the result
)";

std::string scene_help(const std::optional<std::string>& problem) {
  if (problem) return describe_keys(key_table(*problem));
  std::string text =
      fmt::format("{}\nKEYS OF EVERY SCENE\n\n{}", scene_topic, describe_keys(run_keys()));
  for (const Integrator& entry : Integrators::all())
    if (!entry.keys.empty())
      text += fmt::format("\nFURTHER KEYS OF {}\n\n{}", entry.name, describe_keys(entry.keys));
  for (const Problem& entry : Problems::all())
    text += fmt::format("\nKEYS OF {}: {}\n\n{}", entry.name, entry.help,
                        describe_keys(own_keys(entry)));
  return text;
}

std::string integrators_help() {
  std::string text;
  for (const Integrator& entry : Integrators::all())
    text += fmt::format("{}: {}\n    {}; order {}; stability {}; error {}; driven by {}\n",
                        entry.name, entry.help, entry.family, entry.order, entry.stability,
                        entry.error_estimate, entry.driver) +
            describe_keys(entry.keys);
  return text + "\n" + integrators_topic;
}

}  // namespace

const std::vector<std::string>& help_topics() {
  static const std::vector<std::string> topics = {"scene", "studies", "integrators",
                                                  "units", "output",  "exit-codes"};
  return topics;
}

std::string topic_text(const std::string& topic, const std::optional<std::string>& problem) {
  if (topic == "scene") return scene_help(problem);
  if (topic == "studies") return studies_topic + describe_study_keys();
  if (topic == "integrators") return integrators_help();
  if (topic == "units") return units_topic;
  if (topic == "output") return output_topic;
  return exit_codes_topic;
}

void version_command() {
  const auto versions = library_versions();
  fmt::print("gnomon {}\n", versions.at("gnomon"));
  for (const auto& [name, version] : versions)
    if (name != "gnomon") fmt::print("  {} {}\n", name, version);
}

}  // namespace gnomon::app
