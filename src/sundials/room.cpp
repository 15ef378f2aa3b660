#include "sundials/room.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sundials/version.hpp"

namespace gnomon::sundials {

std::string version() {
  std::array<char, 64> text{};
  SUNDIALSGetVersion(text.data(), static_cast<int>(text.size()));
  return text.data();
}

void check(int flag, const char* what) {
  if (flag < 0) throw Error(std::string(what) + " failed with code " + std::to_string(flag));
}

void check(const void* handle, const char* what) {
  if (!handle) throw Error(std::string(what) + " failed: no memory");
}

VectorOwner make_vector(long n, SUNContext context) {
  VectorOwner v(N_VNew_Serial(n, context));
  check(v.get(), "N_VNew_Serial");
  N_VConst(0, v.get());
  return v;
}

std::span<double> view(N_Vector v) {
  return {N_VGetArrayPointer_Serial(v), static_cast<std::size_t>(N_VGetLength_Serial(v))};
}

void require_finite(std::span<const double> values, const char* what) {
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    throw RecoverableError(std::string(what) + " is not finite");
}

// ---- matrix
namespace {

struct MatrixContent {
  const SparsePattern& pattern;
  std::vector<double> values;
};

MatrixContent& content(SUNMatrix matrix) {
  return *static_cast<MatrixContent*>(matrix->content);
}

SUNMatrix new_matrix(const SparsePattern& pattern, SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  if (!matrix) return nullptr;
  matrix->content = new MatrixContent{pattern, std::vector<double>(pattern.nonzeros())};
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->clone = [](SUNMatrix m) { return new_matrix(content(m).pattern, m->sunctx); };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix m) {
    delete &content(m);
    SUNMatFreeEmpty(m);
  };
  return matrix;
}

}  // namespace

MatrixOwner make_matrix(const SparsePattern& pattern, SUNContext context) {
  MatrixOwner matrix(new_matrix(pattern, context));
  check(matrix.get(), "SUNMatNewEmpty");
  return matrix;
}

std::span<double> values(SUNMatrix matrix) {
  return content(matrix).values;
}

}  // namespace gnomon::sundials
