#include <gnomon/integrator.hpp>
#include <gnomon/problem.hpp>

namespace gnomon {

std::vector<Key> key_table(const std::string& problem) {
  std::vector<Key> table = run_keys();
  for (Key& key : table) {
    if (key.name == "problem") key.choices = {problem};
    if (key.name == "integrator.name") key.choices = Integrators::names();
  }
  const std::vector<Key>& own = Problems::find(problem, "problem").keys;
  table.insert(table.end(), own.begin(), own.end());
  return table;
}

}  // namespace gnomon
