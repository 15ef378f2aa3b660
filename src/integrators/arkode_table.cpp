#include <arkode/arkode.h>  // the next two rely on its <stdio.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>

#include <gnomon/integrators/butcher_table.hpp>

#include "sundials/room.hpp"

namespace gnomon {

using namespace sundials;

namespace {
ButcherTable copy_and_free(const std::string& name, ARKodeButcherTable owned) {
  const TableOwner table(owned);
  if (!table) throw Error("ARKODE has no Butcher table called " + name);
  const int s = table->stages;
  ButcherTable result{name, table->q, Eigen::MatrixXd(s, s), Eigen::VectorXd(s), Eigen::VectorXd(s),
                      0,    {}};
  for (int i = 0; i < s; ++i) {
    for (int j = 0; j < s; ++j) result.A(i, j) = table->A[i][j];
    result.b[i] = table->b[i];
    result.c[i] = table->c[i];
  }
  if (!table->d) return result;
  result.embedded_order = table->p;
  result.b_embedded = Eigen::Map<const Eigen::VectorXd>(table->d, s);
  return result;
}

}  // namespace

ButcherTable arkode_dirk_table(const std::string& name) {
  return copy_and_free(name, ARKodeButcherTable_LoadDIRKByName(name.c_str()));
}

ButcherTable arkode_erk_table(const std::string& name) {
  return copy_and_free(name, ARKodeButcherTable_LoadERKByName(name.c_str()));
}

}  // namespace gnomon
