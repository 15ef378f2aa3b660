// Runs a scene by several integrators, step by step, and prints when half of the wear was done.

#include <cstdio>
#include <gnomon/base/error.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>

namespace {

double worn_at(const gnomon::HistoryRow& row) {
  return gnomon::value_of(row.scalars, "worn_volume").value_or(0);
}

/// Worn volumes after every step, without a result file.
std::vector<std::pair<double, double>> history(const char* scene, const std::string& integrator) {
  const gnomon::Setup setup = gnomon::set_up(scene, {"integrator.name=" + integrator});
  std::vector<std::pair<double, double>> rows;
  const gnomon::RunHooks hooks{
      .on_step = [&](const gnomon::HistoryRow& row) { rows.emplace_back(row.t, worn_at(row)); }};
  const gnomon::RunOutcome outcome =
      gnomon::run(*setup.model, gnomon::chosen_integrator(setup.scene),
                  gnomon::integrator_settings(setup.scene, *setup.model),
                  gnomon::store_policy(setup.scene), nullptr, hooks);
  if (outcome.status == gnomon::RunOutcome::Status::failed)
    throw gnomon::SolutionError(outcome.diagnosis);
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: wear_depth SCENE.toml\n");
    return 2;
  }
  try {
    for (const char* integrator : {"esdirk-3", "bdf"}) {
      const auto rows = history(argv[1], integrator);
      double half = 0;
      for (const auto& [t, volume] : rows)
        if (volume <= rows.back().second / 2) half = t;
      std::printf("%s: %zu steps, worn volume %.5g, half of it after about %.3g s\n", integrator,
                  rows.size() - 1, rows.back().second, half);
    }
  } catch (const gnomon::InputError& error) {
    std::fprintf(stderr, "wear_depth: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "wear_depth: %s\n", error.what());
    return 1;
  }
  return 0;
}
