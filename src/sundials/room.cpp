#include "sundials/room.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

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

double scaled_norm(std::span<const double> F, const std::vector<double>& row_scale) {
  double largest = 0;
  for (std::size_t i = 0; i < F.size(); ++i)
    largest = std::max(largest, std::abs(F[i]) / row_scale[i]);
  return largest;
}

// ---- matrix
// --------------------------------------------------------------------------------------

namespace {

struct MatrixContent {
  const Structure& structure;
  std::vector<double> values;
};

MatrixContent& content(SUNMatrix matrix) {
  return *static_cast<MatrixContent*>(matrix->content);
}

SUNMatrix new_matrix(const Structure& structure, SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  if (!matrix) return nullptr;
  matrix->content = new MatrixContent{structure, std::vector<double>(structure.pattern.nonzeros())};
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->clone = [](SUNMatrix m) { return new_matrix(content(m).structure, m->sunctx); };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  matrix->ops->destroy = [](SUNMatrix m) {
    delete &content(m);
    SUNMatFreeEmpty(m);
  };
  return matrix;
}

}  // namespace

MatrixOwner make_matrix(const Structure& structure, SUNContext context) {
  MatrixOwner matrix(new_matrix(structure, context));
  check(matrix.get(), "SUNMatNewEmpty");
  return matrix;
}

std::span<double> values(SUNMatrix matrix) {
  return content(matrix).values;
}

}  // namespace gnomon::sundials
