// gnomon list: the available methods, laws, materials, problems and files.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <map>
#include <utility>

#include "app/commands.hpp"
#include "app/text_table.hpp"
#include "study/declaration.hpp"
#include "study/text_file.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

std::string list_integrators() {
  TextTable table("lllllll",
                  {"name", "family", "order", "error estimate", "stability", "settles", "driver"});
  for (const Integrator& entry : Integrators::all())
    table.add({entry.name, entry.family, entry.order, entry.error_estimate, entry.stability,
               entry.settles ? "yes" : "no", entry.driver});
  return table.text();
}

/// Names, with one line about each, below what the table has.
template <class Entry>
std::string list_below(TextTable table) {
  for (const Entry& entry : Registry<Entry>::all()) table.add({entry.name, entry.help});
  return table.text();
}

template <class Entry>
std::string list_entries() {
  return list_below<Entry>(TextTable("ll"));
}

std::string list_materials() {
  TextTable table("ll");
  table.add({"linear", "Hooke's law with small strains"});  // which has no law of its own
  return list_below<MaterialLaw>(std::move(table));
}

std::string list_shapes() {
  TextTable table("lll");
  for (const CounterShapeKind& kind : Registry<CounterShapeKind>::all()) {
    const char* where = !kind.in_space ? "plane" : kind.in_plane ? "plane, space" : "space";
    table.add({kind.name, where, kind.help});
  }
  return table.text();
}

/// Studies lie in folders of these names; every other TOML file is a scene.
bool is_study(const fs::path& file) {
  const fs::path folder = file.parent_path().filename();
  return folder == "studies" || folder == "extremes";
}

std::string list_files(bool studies) {
  const fs::path root = installed("share/gnomon/problems");
  std::error_code error;
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(root, error);
       entry != fs::recursive_directory_iterator(); entry.increment(error))
    if (!error && entry->path().extension() == ".toml" && is_study(entry->path()) == studies)
      files.push_back(entry->path());
  if (error) throw InputError(fmt::format("cannot read the scenes in {}", root.string()));
  std::sort(files.begin(), files.end());
  TextTable table("ll");
  // Relative to the current folder if that is shorter: users pass these names to `gnomon run`.
  for (const fs::path& file : files) {
    const std::string relative = fs::proximate(file, error).string();
    const bool shorter = !error && relative.size() < file.string().size();
    table.add({shorter ? relative : file.string(), study::first_comment(study::read_text(file))});
  }
  return table.text();
}

/// The subjects, and how each is listed.
const std::map<std::string, std::string (*)()> lists = {
    {"integrators", list_integrators},
    {"laws", list_entries<WearLawKind>},
    {"materials", list_materials},
    {"problems", list_entries<Problem>},
    {"scenes", [] { return list_files(false); }},
    {"shapes", list_shapes},
    {"solvers", list_entries<LinearSolverKind>},
    {"studies", [] { return list_files(true); }}};

}  // namespace

std::vector<std::string> list_subjects() {
  std::vector<std::string> subjects;
  for (const auto& [subject, list] : lists) subjects.push_back(subject);
  return subjects;
}

void list_command(const std::string& what) {
  const std::vector<std::string> subjects = list_subjects();
  if (what.empty()) {
    fmt::print("gnomon list SUBJECT, with SUBJECT one of\n  {}\n", fmt::join(subjects, "\n  "));
  } else if (const auto list = lists.find(what); list != lists.end()) {
    fmt::print("{}", list->second());
  } else {
    const std::string near = nearest_name(what, subjects);
    throw InputError(fmt::format("cannot list `{}`, {}", what,
                                 near.empty()
                                     ? fmt::format("expected one of: {}", fmt::join(subjects, ", "))
                                     : "did you mean `" + near + "`?"));
  }
}

}  // namespace gnomon::app
