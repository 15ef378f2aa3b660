// The known name that a mistyped one most likely meant.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/scene/scene.hpp>
#include <numeric>
#include <utility>

#include "scene/table_layout.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

/// Edit distance with transpositions of neighbours counted as one.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

/// Distance of a word from a candidate; tolerates a wrong table (if the name itself is near), a
/// missing half of the name, and additional text after it.
std::size_t distance(const std::string& word, const std::string& candidate) {
  std::size_t result = edit_distance(word, candidate);
  if (candidate.find('.') != std::string::npos) {
    const std::string name = last_part(candidate);
    const std::size_t of_names = edit_distance(last_part(word), name);
    if (of_names <= std::max<std::size_t>(1, name.size() / 3))
      result = std::min(result, of_names + 1);
  }
  if (word.starts_with(candidate + ".")) result = std::min<std::size_t>(result, 1);
  if (word.size() >= 3 && candidate.find(word) != std::string::npos)
    result = std::min<std::size_t>(result, 1);
  return result;
}

/// What others call a key (by its last part, or in full) or an integrator: first the names that
/// they use, then the candidates that may be meant, the best first.
struct UsualName {
  std::vector<std::string> usual, meant;
};

const std::vector<UsualName>& usual_names() {
  static const std::vector<UsualName> names = {
      {{"E", "youngs_modulus", "elastic_modulus"}, {"young_modulus"}},
      {{"nu", "poisson", "poissons_ratio"}, {"poisson_ratio"}},
      {{"mu", "f", "cof", "friction_coefficient"}, {"friction.coefficient"}},
      {{"k", "wear_coefficient"}, {"wear.coefficient"}},
      {{"F", "P", "normal_force"}, {"press.force", "force"}},
      {{"p"}, {"pressure"}},
      {{"v", "speed"}, {"motion.velocity", "velocity"}},
      {{"omega"}, {"rotation"}},
      {{"node", "nodes", "face", "surface", "group", "where"}, {"on"}},
      {{"R", "r"}, {"radius"}},
      {{"rho"}, {"density"}},
      {{"g", "gravity"}, {"acceleration"}},
      {{"dt", "time_step", "step_size"}, {"integrator.step"}},
      {{"tol", "tolerance", "reltol"}, {"integrator.rtol"}},
      {{"abstol"}, {"integrator.atol"}},
      {{"t_end", "tend", "end_time", "duration"}, {"time.end"}},
      {{"method", "integrator"}, {"integrator.name"}},
      {{"rk1", "euler", "explicit-euler"}, {"forward-euler"}},
      {{"implicit-euler", "euler-implicit", "be"}, {"backward-euler"}},
      {{"rk2", "heun", "midpoint"}, {"erk-2"}},
      {{"rk3"}, {"erk-3"}},
      {{"rk4", "runge-kutta", "runge-kutta-4"}, {"erk-4"}},
      {{"rk5", "rk45", "dopri5", "ode45"}, {"erk-5", "erk-4"}},
      {{"ida", "gear", "ode15s"}, {"bdf"}},
      {{"trapezoidal", "trapezoid", "crank-nicolson"}, {"theta"}},
  };
  return names;
}

bool is_called(const std::string& candidate, const std::string& name) {
  return candidate == name || candidate.ends_with("." + name);
}

/// The candidate that a usual name means, preferably in the same table; empty if there is none.
std::string usually_meant(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string table = word.substr(0, word.size() - last_part(word).size());
  for (const UsualName& entry : usual_names()) {
    if (std::find(entry.usual.begin(), entry.usual.end(), last_part(word)) == entry.usual.end())
      continue;
    std::string first;
    for (const std::string& meant : entry.meant)
      for (const std::string& candidate : candidates) {
        if (!is_called(candidate, meant)) continue;
        if (!table.empty() && candidate.starts_with(table)) return candidate;
        if (first.empty()) first = candidate;
      }
    if (!first.empty()) return first;
  }
  return {};
}

}  // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest =
      200;  // longer words are no typing mistakes; the limit bounds the cost
  if (word.size() > longest) return {};
  if (std::string meant = usually_meant(word, candidates); !meant.empty()) return meant;
  std::string nearest;
  // With a wrong table as near as a wrong letter: the fewer letters differ, the nearer.
  std::pair best(std::max<std::size_t>(2, word.size() / 3) + 1, std::size_t{0});
  if (word.size() <= 3) best.first = 2;
  for (const std::string& candidate : candidates)
    if (const std::pair d(distance(word, candidate), edit_distance(word, candidate)); d < best) {
      best = d;
      nearest = candidate;
    }
  return nearest;
}

std::string unknown_name(const std::string& name, const std::string& what,
                         const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(name, candidates);
  return fmt::format("unknown {} {}, {}", what, toml_text(name),
                     near.empty() ? "expected one of `gnomon list " + what + "s`"
                                  : "did you mean \"" + near + "\"?");
}

}  // namespace gnomon
