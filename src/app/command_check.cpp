// gnomon check: validates a scene. What it prints is itself a scene.

#include <fmt/format.h>

#include <gnomon/run/setup.hpp>
#include <sstream>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

namespace {

std::string text_of(const Setup& setup) {
  TextTable table("llrl", {"# unknowns", "symbol", "size", "on"});
  long total = 0;
  for (const BlockSize& block : setup.model->blocks) {
    table.add({"# " + block.name, block.symbol, fmt::format("{}", block.size), block.where});
    total += block.size;
  }
  table.add({"# all", "", fmt::format("{}", total), ""});
  std::string text = fmt::format("{}\n{}", setup.scene.resolved(), table.text());
  if (const double memory = setup.model->memory; memory > 0)
    text += fmt::format("# a run takes about {} of memory\n", memory_text(memory));
  for (const std::string& remark : setup.model->remarks) text += fmt::format("# {}\n", remark);
  for (const std::string& proposal : setup.model->proposals)
    text += fmt::format("# {}\n", proposal);
  for (const std::string& remark : remarks_on_keys(setup)) text += fmt::format("# {}\n", remark);
  return text;
}

std::string commented(const std::string& text) {
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) result += "# " + line + "\n";
  return result;
}

}  // namespace

void check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides) {
  Scene checked = checked_scene(scene, overrides);
  std::string plan;
  if (checked.has("accuracy.within")) {
    Plan made = planned(checked, /*quiet=*/false);
    plan = commented(plan_text(made));
    checked = std::move(made.scene);
  }
  const Setup setup = [&] {
    const LiveLine line(making_the_model);
    return set_up(std::move(checked));
  }();
  fmt::print("{}{}", text_of(setup), plan);
}

}  // namespace gnomon::app
