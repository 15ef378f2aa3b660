// gnomon check: validates a scene. What it prints is itself a scene.

#include <fmt/format.h>

#include <gnomon/model/wear_scene.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>

#include "app/commands.hpp"
#include "app/program.hpp"
#include "app/text_table.hpp"

namespace gnomon::app {

int check_command(const std::filesystem::path& scene, const std::vector<std::string>& overrides) {
  const Setup setup = set_up(scene, overrides);
  TextTable table({{"# unknowns"}, {"symbol"}, {"size", TextTable::Align::right}, {"on"}});
  long total = 0;
  for (const BlockSize& block : setup.model->blocks()) {
    table.add({"# " + block.name, block.symbol, fmt::format("{}", block.size), block.where});
    total += block.size;
  }
  table.add({"# all", "", fmt::format("{}", total), ""});
  fmt::print("{}\n{}", setup.scene.resolved(), table.text());
  if (const double memory = setup.model->memory(); memory > 0)
    fmt::print("# a run takes about {} of memory\n", memory_text(memory));
  for (const std::string& remark : setup.model->remarks()) fmt::print("# {}\n", remark);
  if (const std::string dropped = dropped_times_text(setup.scene); !dropped.empty())
    fmt::print("# {}\n", dropped);
  for (const std::string& idle : idle_keys_texts(setup.scene)) fmt::print("# {}\n", idle);
  for (const std::string& name : unused_wear_names(setup.scene))
    fmt::print("# {} is given, but wear.rate does not use it\n", name);
  return success;
}

}  // namespace gnomon::app
