#include "results/growing_table.hpp"

namespace gnomon::hdf5 {

namespace {
constexpr hsize_t kChunkRows = 256;
}

GrowingTable GrowingTable::create(hid_t parent, const std::string& name, Handle row_type) {
  const hsize_t none = 0;
  const hsize_t unlimited = H5S_UNLIMITED;
  const Handle space = own(H5Screate_simple(1, &none, &unlimited), H5Sclose, "describe a table");
  const Handle properties = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a table");
  check(H5Pset_chunk(properties.id(), 1, &kChunkRows), "describe a table");
  check(H5Pset_obj_track_times(properties.id(), false), "describe a table");
  GrowingTable table;
  table.dataset_ = own(H5Dcreate2(parent, name.c_str(), row_type.id(), space.id(), H5P_DEFAULT,
                                  properties.id(), H5P_DEFAULT),
                       H5Dclose, "create a table");
  table.type_ = std::move(row_type);
  return table;
}

void GrowingTable::append(const void* row) {
  const hsize_t size = rows_ + 1;
  check(H5Dset_extent(dataset_.id(), &size), "append to a table");
  const hsize_t one = 1;
  const Handle memory = own(H5Screate_simple(1, &one, nullptr), H5Sclose, "append to a table");
  const Handle file = own(H5Dget_space(dataset_.id()), H5Sclose, "append to a table");
  check(H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, &rows_, nullptr, &one, nullptr),
        "append to a table");
  check(H5Dwrite(dataset_.id(), type_.id(), memory.id(), file.id(), H5P_DEFAULT, row),
        "append to a table");
  rows_ = size;
}

}  // namespace gnomon::hdf5
