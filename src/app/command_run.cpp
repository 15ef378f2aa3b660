// gnomon run: integrates a scene, writes its result and summary, and reports how it ended.

#include <gnomon/results/result_files.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>
#include <utility>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"

namespace gnomon::app {

int run_command(const RunOptions& given) {
  RunOptions options = given;
  Scene scene = checked_scene(options.scene, options.overrides);
  if (options.result.empty())
    options.result = options.scene.stem().string() + "-" + scene.text("integrator.name") + ".h5";
  check_outputs(options);  // before anything that takes time
  const bool earlier = is_taken(options.result);

  if (!options.quiet) warn_of_slow_blas();
  const Setup setup = [&] {
    const LiveLine line(making_the_model, options.quiet);
    return set_up(std::move(scene));
  }();
  if (!options.quiet) {
    print_remarks(remarks_on_keys(setup));
    print_remarks(setup.model->remarks);
  }
  const RunHeader header = run_header(setup);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  const RunOutcome outcome = [&] {
    const InterruptGuard guard(
        !options.quiet);  // before the result is created, so that it is always closed
    ResultWriter writer(options.result, header, setup.model->grid,
                        options.force ? Earlier::replaced : Earlier::refused);
    return integrate(setup, settings, writer, options.quiet);
  }();
  write_summary(options, summary_json(setup.scene, header, settings, outcome, setup.model->remarks),
                outcome.last.has_value());
  return report_end(outcome, options, setup.model->grid.has_value(), earlier && !outcome.last);
}

}  // namespace gnomon::app
