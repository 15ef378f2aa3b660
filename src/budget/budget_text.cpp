// An error budget for a terminal, and for scripts.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/plan.hpp>
#include <nlohmann/json.hpp>

namespace gnomon {

namespace {

using Json = nlohmann::ordered_json;

/// In the order of ErrorSource.
constexpr std::array sources = {"time", "mesh", "model", "phases", "solves"};

ErrorSource source_of(const std::string& name) {
  const auto found = std::ranges::find(sources, name);
  if (found == sources.end()) throw InputError("no source of errors is called " + name);
  return static_cast<ErrorSource>(found - sources.begin());
}

/// Two digits are more than an estimate deserves.
std::string percent(double error) {
  return std::isnan(error) ? "?" : fmt::format("{:.2g} %", 100 * error);
}

/// The name of the source, or of the key where several have it.
std::string title(const Budget& budget, const BudgetPart& part) {
  return std::ranges::count(budget.parts, part.source, &BudgetPart::source) > 1
             ? part.key
             : name_of(part.source);
}

Json number_or_null(double value) {
  return std::isnan(value) ? Json(nullptr) : Json(value);
}

}  // namespace

std::string name_of(ErrorSource source) {
  return sources[static_cast<std::size_t>(source)];
}

std::string budget_table(const Budget& budget) {
  constexpr std::size_t name_width = 18, value_width = 16;
  std::string text = fmt::format("{:{}} {:>{}}", "", name_width, "value", value_width);
  std::vector<std::size_t> widths;
  for (const BudgetPart& part : budget.parts) {
    widths.push_back(std::max<std::size_t>(9, title(budget, part).size()));
    text += fmt::format("  {:>{}}", title(budget, part), widths.back());
  }
  text += fmt::format("  {:>9}\n", "all");
  for (std::size_t i = 0; i < budget.values.size(); ++i) {
    const Scalar& value = budget.values[i];
    if (value.value == 0 && value.name.starts_with("creepage_")) continue;
    text += fmt::format("{:{}} {:>{}}", value.name, name_width,
                        fmt::format("{:.5g} {}", value.value, value.unit), value_width);
    for (std::size_t p = 0; p < budget.parts.size(); ++p)
      text += fmt::format("  {:>{}}", percent(budget.parts[p].errors[i]), widths[p]);
    const bool is_whole = std::ranges::none_of(
        budget.parts, [&](const BudgetPart& part) { return std::isnan(part.errors[i]); });
    text += fmt::format("  {:>9}\n", (is_whole || std::isnan(budget.total(i)) ? "" : "> ") +
                                         percent(budget.total(i)));
  }
  for (const BudgetPart& part : budget.parts)
    if (!part.unknown.empty())
      text += fmt::format("{} is not known: {}\n", title(budget, part), part.unknown);
  for (const std::string& warning : budget_warnings(budget)) text += warning + "\n";
  return text;
}

std::vector<std::string> budget_warnings(const Budget& budget) {
  std::vector<std::string> warnings;
  for (const BudgetPart& part : budget.parts)
    if (!part.doubt.empty()) warnings.push_back(title(budget, part) + ": " + part.doubt);
  return warnings;
}

std::string budget_text(const Budget& budget) {
  std::string text = budget_table(budget);
  for (const BudgetPart& part : budget.parts)
    if (part.unknown.empty()) text += fmt::format("{}: {}\n", title(budget, part), part.how);
  if (budget.run_seconds > 0)
    text += fmt::format("CPU time {:.3g} s, of the companions {:.3g} s\n", budget.run_seconds,
                        budget.companion_seconds);
  return text;
}

namespace {

/// More than what is known of it, where a part is not.
std::string expected_text(const PlanLine& line) {
  double known = 0;
  for (const double part : {line.mesh, line.time, line.rest}) known += std::isnan(part) ? 0 : part;
  return (std::isnan(line.error()) ? "> " : "") + percent(known);
}

}  // namespace

std::string plan_text(const Plan& plan) {
  std::string text = fmt::format("{:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8}  settings\n", "asked",
                                 "expected", "mesh", "time", "rest", "CPU [s]");
  for (const PlanLine& line : plan.lines)
    text += fmt::format("{:>8}  {:>8}  {:>8}  {:>8}  {:>8}  {:>8.2g}  {}{}\n", percent(line.within),
                        expected_text(line), percent(line.mesh), percent(line.time),
                        percent(line.rest), line.cpu_seconds, line.settings,
                        line.error() > line.within ? " (not reached)" : "");
  for (const std::string& remark : plan.remarks) text += remark + "\n";
  return text + fmt::format("pilot runs took {:.2g} s of CPU\n", plan.pilot_seconds);
}

std::string budget_json(const Budget& budget) {
  Json json;
  json["values"] = Json::array();
  for (std::size_t i = 0; i < budget.values.size(); ++i) {
    const auto& [name, unit, value] = budget.values[i];
    json["values"].push_back({{"name", name},
                              {"unit", unit},
                              {"value", value},
                              {"error", number_or_null(budget.total(i))}});
  }
  json["parts"] = Json::array();
  for (const BudgetPart& part : budget.parts) {
    Json errors = Json::object();
    for (std::size_t i = 0; i < budget.values.size(); ++i)
      errors[budget.values[i].name] = number_or_null(part.errors[i]);
    json["parts"].push_back({{"source", name_of(part.source)},
                             {"key", part.key},
                             {"how", part.how},
                             {"unknown", part.unknown},
                             {"doubt", part.doubt},
                             {"errors", errors}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Budget budget_of_json(const std::string& text) try {
  const Json json = Json::parse(text);
  Budget budget;
  for (const Json& value : json.at("values"))
    budget.values.push_back({value.at("name"), value.at("unit"), value.at("value")});
  for (const Json& given : json.at("parts")) {
    BudgetPart part{.source = source_of(given.at("source")),
                    .key = given.at("key"),
                    .how = given.at("how"),
                    .errors = {},
                    .unknown = given.at("unknown"),
                    .doubt = given.value("doubt", "")};  // files of before have none
    for (const Scalar& value : budget.values) {
      const Json& error = given.at("errors").at(value.name);
      part.errors.push_back(error.is_null() ? not_known : error.get<double>());
    }
    budget.parts.push_back(std::move(part));
  }
  return budget;
} catch (const nlohmann::json::exception&) {
  throw InputError("expected an error budget, got other JSON");
}

}  // namespace gnomon
