#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <gnomon/base/counter_names.hpp>
#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/run/summary.hpp>
#include <nlohmann/json.hpp>
#include <optional>

namespace gnomon {

namespace {

using Json = nlohmann::ordered_json;

/// Of a cycle.
void add_phase_errors(Json& json, const RunOutcome& outcome) {
  json["phase_errors"] = Json::array();
  for (const PhaseError& at : outcome.phase_errors)
    json["phase_errors"].push_back({{"t", at.t}, {"phases", at.phases}, {"error", at.error}});
}

void add_balance(Json& json, const Examination& examination) {
  for (const char* name : {"forces", "torques", "reactions"}) json[name] = Json::object();
  for (const ResultantForce& each : examination.forces) {
    json["forces"][each.name] = each.force;
    json["torques"][each.name] = each.torque;
  }
  for (const ResultantForce& each : examination.pairs)
    json["pairs"][each.name] = {{"force", each.force}, {"torque", each.torque}};
  for (const ResultantForce& each : examination.reactions)
    json["reactions"][each.name] = {{"force", each.force}, {"torque", each.torque}};
}

void add_scalars(Json& json, const RunOutcome& outcome) {
  // Included even if they are absent, so that scripts find the keys in every summary.
  for (const char* name : {"contact_nodes", "contact_force", "max_pressure", "worn_volume",
                           "wear_flux", "wear_integral", "wear_difference", "element_quality",
                           "element_volume", "contact_half_width", "wear_depth", "contact_area"})
    json[name] = nullptr;
  if (!outcome.last) return;
  for (const Scalar& scalar : outcome.last->scalars) json[scalar.name] = scalar.value;
  if (const auto difference = wear_difference(outcome.last->scalars))
    json["wear_difference"] = *difference;
}

/// None unless the file contains a summary.
std::optional<Json> read_summary(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Json json = Json::parse(stream, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return std::nullopt;
  for (const char* key : {"problem", "integrator", "status", "t_end", "unknowns", "versions"})
    if (!json.contains(key)) return std::nullopt;
  return json;
}

}  // namespace

std::string RunOutcome::text() const {
  switch (status) {
    case Status::finished:
      return ended_by.starts_with("time.until: ") ? "finished: " + ended_by.substr(12) : "finished";
    case Status::interrupted:
      return "interrupted";
    case Status::failed:
      return "failed: " + diagnosis;
  }
  return {};
}

bool is_summary(const std::filesystem::path& file) {
  return read_summary(file).has_value();
}

bool is_summary_without_start(const std::filesystem::path& file) {
  const auto json = read_summary(file);
  return json && json->contains("t") && json->at("t").is_null();
}

std::string summary_json(const Scene& scene, const RunHeader& header,
                         const IntegratorSettings& settings, const RunOutcome& outcome,
                         const std::vector<std::string>& remarks) {
  Json json;
  json["scene"] = scene.path().string();
  json["problem"] = header.problem;
  json["integrator"] = header.integrator;
  json["step"] = settings.step;
  json["rtol"] = settings.rtol;
  json["atol"] = settings.atol;
  const std::string status = outcome.text();
  json["status"] = status.substr(0, status.find(':'));
  json["diagnosis"] = outcome.diagnosis;
  json["ended_by"] = outcome.ended_by;
  json["t"] = outcome.last ? Json(outcome.last->t) : Json(nullptr);
  json["t_end"] = settings.end;
  for (const NamedCounter& counter : named_counters)
    json[counter.name] = outcome.counters.*counter.value;
  json["remarks"] = remarks;
  json["warnings"] = outcome.warnings;
  json["chattering_nodes"] = outcome.chattering_nodes;
  add_phase_errors(json, outcome);
  json["budget"] = outcome.budget.empty() ? Json(nullptr) : Json::parse(outcome.budget);
  add_balance(json, outcome.examination);
  json["wall_seconds"] = outcome.wall_seconds;
  add_scalars(json, outcome);
  Json unknowns = Json::object();
  for (const BlockSize& block : header.blocks) unknowns[block.name] = block.size;
  json["unknowns"] = unknowns;
  json["versions"] = header.versions;
  // Paths are bytes, JSON is UTF-8: invalid characters are replaced.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string phase_error_text(const std::vector<PhaseError>& errors) {
  if (errors.empty()) return {};
  std::string text = fmt::format("error of the mean over {}:", phases_text(errors.front().phases));
  for (const PhaseError& at : errors)
    text += fmt::format("{} {:.1e} at t = {:g} s", &at == errors.data() ? "" : ",", at.error, at.t);
  return text;
}

std::string ledger_text(const Observation& observed) {
  const std::optional<double> difference = wear_difference(observed);
  if (!difference) return {};
  const auto& [name, unit, worn] = *find_scalar(observed, "worn_volume");
  const double integral = *value_of(observed, "wear_integral");
  std::string text =
      fmt::format("worn volume {:#.6g} {}, wear integral {:#.6g} {}, difference {:.1e} {}", worn,
                  unit, integral, unit, *difference, unit);
  if (const double percent = 100 * *difference / integral; worn != 0 && std::isfinite(percent))
    text += fmt::format(" ({:.2g} %)", percent);
  return text;
}

}  // namespace gnomon
