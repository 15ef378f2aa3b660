#include "app/option_checks.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

namespace gnomon::app {

std::string check_file_name(const std::string& name) {
  return name.empty() ? "expected a name, got an empty text" : "";
}

std::string check_number(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  const bool valid = parsed == end && error == std::errc() && std::isfinite(number);
  return valid ? "" : fmt::format("expected a finite number, got `{}`", text);
}

void refuse_values_of_flags(CLI::App* command) {
  for (CLI::Option* option : command->get_options())
    if (option->get_items_expected_max() == 0) option->disable_flag_override();
  for (CLI::App* below : command->get_subcommands([](CLI::App*) { return true; }))
    refuse_values_of_flags(below);
}

}  // namespace gnomon::app
