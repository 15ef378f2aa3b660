#include <fmt/format.h>

#include <gnomon/study/study.hpp>

#include "study/keyed_table.hpp"

namespace gnomon::study {

namespace {

constexpr Range positive{.min = 0, .min_open = true};

Key integrator_key() {
  return {.name = "integrator",
          .kind = KeyKind::text,
          .help = "time integration method (gnomon list integrators)"};
}

Key name_key() {
  return {.name = "name",
          .kind = KeyKind::text,
          .absent_meaning = "that of its integrator",
          .help = "its name in tables and figures"};
}

}  // namespace

std::vector<Key> top_keys() {
  return {
      {.name = "scene", .kind = KeyKind::text, .help = "scene file, relative to the study file"},
      {.name = "times",
       .kind = KeyKind::reals,
       .unit = "s",
       .absent_meaning = "five equal parts of time.end; none with reference = \"none\"",
       .range = positive,
       .help = "times at which errors are measured, besides time.end; steps end there exactly"},
      {.name = "reference",
       .kind = KeyKind::text,
       .absent_meaning = "a closed form, or two runs: those of two [[reference]] tables",
       .choices = {"none"},
       .help = "\"none\": no errors are measured, as for a parameter sweep; methods may be absent"},
      {.name = "self_reference.method",
       .kind = KeyKind::text,
       .absent_meaning = "no errors against a run of the study itself",
       .help = "the method whose run is a second reference, as in the paper"},
      {.name = "self_reference.step",
       .unit = "s",
       .absent_meaning = "self_reference.tolerance is given",
       .range = positive,
       .help = "fixed step of this run"},
      {.name = "self_reference.tolerance",
       .absent_meaning = "self_reference.step is given",
       .range = relative_tolerance,
       .help = "relative tolerance of this run"},
  };
}

std::vector<Key> sweep_keys() {
  return {{.name = "key",
           .kind = KeyKind::text,
           .help = "the scene key that is varied; `values` holds its values"}};
}

std::vector<Key> method_keys() {
  return {name_key(),
          integrator_key(),
          {.name = "steps",
           .kind = KeyKind::reals,
           .unit = "s",
           .absent_meaning = "`tolerances` are given",
           .range = positive,
           .or_single = positive,
           .help = "fixed steps (integrator.step), one run each; `step` is the same"},
          {.name = "tolerances",
           .kind = KeyKind::reals,
           .absent_meaning = "`steps` are given",
           .range = relative_tolerance,
           .or_single = relative_tolerance,
           .help = "relative tolerances (integrator.rtol), one run each; `tolerance` is the same"}};
}

std::vector<Key> reference_keys() {
  return {name_key(),
          integrator_key(),
          {.name = "tolerances",
           .kind = KeyKind::reals,
           .range = relative_tolerance,
           .length = 1,
           .or_single = relative_tolerance,
           .help = "relative tolerance (integrator.rtol); `tolerance` is the same"}};
}

}  // namespace gnomon::study

namespace gnomon {

std::string describe_study_keys() {
  const auto part = [](const std::string& title, const std::vector<Key>& keys) {
    return fmt::format("\n{}\n\n{}", title, describe_keys(keys));
  };
  return part("KEYS OF A STUDY", study::top_keys()) +
         part("KEYS OF EACH [[sweep]] (all combinations are run)", study::sweep_keys()) +
         "values: array of values of that key\n" +
         part("KEYS OF EACH [[method]] (none with reference = \"none\": the scene's integrator)",
              study::method_keys()) +
         part("KEYS OF EACH [[reference]] (two, of different families)", study::reference_keys());
}

}  // namespace gnomon
