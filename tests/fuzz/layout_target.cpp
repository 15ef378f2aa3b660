#include <hdf5.h>

#include <array>
#include <vector>

#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

namespace {

/// Takes choices from bytes; 0 if there are no more bytes.
class Choices {
public:
  explicit Choices(std::string_view bytes) : rest_(bytes) {}

  bool any() const { return !rest_.empty(); }
  unsigned byte() {
    if (rest_.empty()) return 0;
    const auto value = static_cast<unsigned char>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  template <class List>
  auto& of(const List& list) {
    return list[byte() % std::size(list)];
  }

private:
  std::string_view rest_;
};

constexpr std::array<const char*, 16> objects = {"gnomon/history",
                                                 "gnomon/stored",
                                                 "gnomon/blocks",
                                                 "gnomon/scene",
                                                 "gnomon/versions",
                                                 "gnomon/checkpoints",
                                                 "gnomon/contact",
                                                 "gnomon/contact/0000/000000",
                                                 "mesh",
                                                 "mesh/points",
                                                 "mesh/cells",
                                                 "steps/0000",
                                                 "steps/0000/000000",
                                                 "steps/0000/000000/displacement",
                                                 "steps/0000/000000/further",
                                                 "gnomon"};
constexpr std::array<const char*, 10> attributes = {
    "format", "format_version", "status", "wall_seconds", "problem", "units",
    "dim",    "unit",           "on",     "further"};

hid_t text(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  return type;
}

hid_t compound(std::initializer_list<std::pair<const char*, hid_t>> members) {
  const hid_t type = H5Tcreate(H5T_COMPOUND, 8 * members.size());
  std::size_t offset = 0;
  for (const auto& [name, member] : members) {
    H5Tinsert(type, name, offset, member);
    H5Tclose(member);  // a predefined one stays
    offset += 8;
  }
  return type;
}

/// A type to store.
hid_t type_of(Choices& choices) {
  constexpr hsize_t pair[] = {2};
  switch (choices.byte() % 14) {
    case 0:
      return H5T_NATIVE_INT8;
    case 1:
      return H5T_NATIVE_INT64;
    case 2:
      return H5T_IEEE_F64LE;
    case 3:
      return H5T_IEEE_F32BE;
    case 4:
      return text(1);
    case 5:
      return text(24);
    case 6:
      return text(std::size_t{1} << (choices.byte() % 33));
    case 7:
      return text(H5T_VARIABLE);
    case 8:
      return H5Tvlen_create(H5T_NATIVE_DOUBLE);
    case 9:
      return H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, pair);
    case 10:
      return H5Tcreate(H5T_OPAQUE, 1 + choices.byte());
    case 11:
      return compound({{"t", H5T_NATIVE_DOUBLE}, {"path", H5T_NATIVE_INT64}});
    case 12:
      return compound({{"name", H5T_NATIVE_DOUBLE}, {"size", text(8)}, {"t", text(8)}});
    default:
      return compound({});
  }
}

hid_t space_of(Choices& choices) {
  constexpr hsize_t sizes[] = {0, 1, 2, 3, 8, 300, hsize_t{1} << 31, hsize_t{1} << 40};
  const int rank = static_cast<int>(choices.byte() % 4);
  hsize_t extents[3] = {};
  for (int i = 0; i < rank; ++i) extents[i] = choices.of(sizes);
  return rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, extents, nullptr);
}

/// An attribute takes space in the file even if it is not written.
bool is_storable(hid_t type, hid_t space) {
  constexpr double most = 1 << 18;  // bytes
  return double(H5Tget_size(type)) * double(H5Sget_simple_extent_npoints(space)) <= most;
}

/// Bytes for a whole small value; none for a large one, which is then not written.
std::vector<unsigned char> values_of(hid_t type, hid_t space, Choices& choices) {
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  const std::size_t size = H5Tget_size(type);
  constexpr std::size_t most = 1 << 14;
  const bool points = H5Tdetect_class(type, H5T_VLEN) > 0 || H5Tis_variable_str(type) > 0;
  if (points || count > most || size > most || count * size > most) return {};
  std::vector<unsigned char> values(count * size);
  for (unsigned char& value : values) value = static_cast<unsigned char>(choices.byte());
  return values;
}

void put_dataset(hid_t file, const char* name, Choices& choices) {
  const hid_t type = type_of(choices), space = space_of(choices);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  if (choices.byte() % 2 == 0) {  // in chunks, which may be missing
    hsize_t chunk[3] = {1, 1, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank > 0) H5Pset_chunk(properties, rank, chunk);
  }
  const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  const auto values = values_of(type, space, choices);
  if (!values.empty()) H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(dataset);
  H5Pclose(properties);
  H5Sclose(space);
  H5Tclose(type);
}

void put_attribute(hid_t object, const char* name, Choices& choices) {
  const hid_t type = type_of(choices), space = space_of(choices);
  if (is_storable(type, space)) {
    const hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const auto values = values_of(type, space, choices);
    if (!values.empty()) H5Awrite(attribute, type, values.data());
    H5Aclose(attribute);
  }
  H5Sclose(space);
  H5Tclose(type);
}

/// Makes one change; if HDF5 refuses it, nothing changes.
void change(hid_t file, Choices& choices) {
  const char* const name = choices.of(objects);
  switch (choices.byte() % 5) {
    case 0:
      H5Ldelete(file, name, H5P_DEFAULT);
      break;
    case 1:
      H5Ldelete(file, name, H5P_DEFAULT);
      put_dataset(file, name, choices);
      break;
    case 2:
      H5Ldelete(file, name, H5P_DEFAULT);
      H5Gclose(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      break;
    case 3:
      H5Ldelete(file, name, H5P_DEFAULT);
      H5Lcreate_soft((std::string("/") + choices.of(objects)).c_str(), file, name, H5P_DEFAULT,
                     H5P_DEFAULT);
      break;
    default: {
      const hid_t object = H5Oopen(file, name, H5P_DEFAULT);
      const char* const attribute = choices.of(attributes);
      H5Adelete(object, attribute);
      if (choices.byte() % 4 != 0) put_attribute(object, attribute, choices);
      H5Oclose(object);
    }
  }
}

}  // namespace

void layout(std::string_view bytes) {
  [[maybe_unused]] static const herr_t no_clean_up = H5dont_atexit();  // as hdf5_handles.cpp does
  static const Folder folder("layout");
  static const std::string sound = read_file("corpus/result/pin");
  const auto file = folder.put("r", sound);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, access);
  Choices choices(bytes);
  while (choices.any()) change(opened, choices);
  H5Fclose(opened);
  H5Pclose(access);
  read_result(file);
}

}  // namespace gnomon::fuzz
