#include "results/hdf5_values.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace gnomon::hdf5 {

namespace {

constexpr std::size_t kRewritableText = 1024;
constexpr hsize_t kMostCompression = 1100;  // of deflate: 1032 bytes of one

// A dataspace of the given extents; none: a scalar.
Handle space(const std::vector<hsize_t>& extents, const hsize_t* most = nullptr) {
  const hid_t id = extents.empty()
                       ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), most);
  return own(id, H5Sclose, "describe a dataset");
}

Handle open_attribute(hid_t object, const char* name) {
  return own(H5Aopen(object, name, H5P_DEFAULT), H5Aclose, "read an attribute");
}

// Creates the attribute, or changes the one that is there.
void write(hid_t object, const char* name, hid_t type, const std::vector<hsize_t>& extents,
           const void* values) {
  const bool there = check(H5Aexists(object, name), "write an attribute") > 0;
  const Handle shape = space(extents);
  const Handle attribute =
      own(there ? H5Aopen(object, name, H5P_DEFAULT)
                : H5Acreate2(object, name, type, shape.id(), H5P_DEFAULT, H5P_DEFAULT),
          H5Aclose, "write an attribute");
  check(H5Awrite(attribute.id(), type, values), "write an attribute");
}

// Texts of `size` bytes each, one after the other, as HDF5 stores them.
std::vector<char> padded(const std::vector<std::string>& texts, std::size_t size) {
  std::vector<char> bytes(texts.size() * size, '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::copy_n(texts[i].begin(), std::min(texts[i].size(), size), &bytes[i * size]);
  }
  return bytes;
}

// Reads `count` texts through `read`, which fills memory of the given type.
template <class Read>
std::vector<std::string> take_texts(hid_t stored, std::size_t count, Read read) {
  if (H5Tget_class(stored) != H5T_STRING || H5Tis_variable_str(stored) != 0) {
    throw Failure("cannot read text: it is not text of fixed length");
  }
  const std::size_t size = H5Tget_size(stored);
  std::vector<char> bytes(count * size);
  read(stored, bytes.data());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) {
    const char* text = bytes.data() + i * size;
    texts.emplace_back(text, strnlen(text, size));
  }
  return texts;
}

void write_texts(hid_t object, const char* name, const std::vector<std::string>& texts,
                 std::size_t size, const std::vector<hsize_t>& extents) {
  const Handle type = text_type(size);
  write(object, name, type.id(), extents, padded(texts, size).data());
}

std::size_t count_of(const std::vector<hsize_t>& extents) {
  hsize_t count = 1;
  for (const hsize_t extent : extents) count *= extent;
  return count;
}

// Appends the name of a link or an attribute to a list; no exception may leave this function.
template <class Info>
herr_t add_name(hid_t, const char* name, const Info*, void* names) {
  try {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  } catch (...) {
    return -1;
  }
}

}  // namespace

Handle text_type(std::size_t size) {
  Handle type = own(H5Tcopy(H5T_C_S1), H5Tclose, "describe text");
  check(H5Tset_size(type.id(), std::max<std::size_t>(1, size)), "describe text");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "describe text");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), "describe text");
  return type;
}

namespace {

/// Chunks of equal size, of about a megabyte: as much as HDF5 keeps in memory of a dataset.
void compress(const Handle& properties, hid_t type, const std::vector<hsize_t>& extents) {
  constexpr hsize_t least = 8192, largest = 1 << 20;  // bytes; the index of chunks has 2600 itself
  constexpr unsigned level = 1;  // higher ones take twice the time for 3 % less
  const hsize_t bytes = count_of(extents) * H5Tget_size(type);
  if (extents.empty() || bytes < least || H5Zfilter_avail(H5Z_FILTER_DEFLATE) <= 0) return;
  const hsize_t chunks = (bytes + largest - 1) / largest;
  std::vector<hsize_t> chunk = extents;
  chunk.front() = (extents.front() + chunks - 1) / chunks;
  check(H5Pset_chunk(properties.id(), static_cast<int>(chunk.size()), chunk.data()),
        "create a dataset");
  check(H5Pset_shuffle(properties.id()), "create a dataset");
  check(H5Pset_deflate(properties.id(), level), "create a dataset");
}

}  // namespace

Handle create_dataset(hid_t parent, const std::string& name, hid_t type,
                      const std::vector<hsize_t>& extents, Storage storage) {
  constexpr hsize_t unlimited = H5S_UNLIMITED, chunk_rows = 256;
  const bool grows = storage == Storage::growing;
  const Handle shape = space(extents, grows ? &unlimited : nullptr);
  const Handle create = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create a dataset");
  // Without time stamps, equal runs give equal bytes.
  check(H5Pset_obj_track_times(create.id(), false), "create a dataset");
  if (grows) check(H5Pset_chunk(create.id(), 1, &chunk_rows), "create a dataset");
  if (storage == Storage::compressed) compress(create, type, extents);
  return own(
      H5Dcreate2(parent, name.c_str(), type, shape.id(), H5P_DEFAULT, create.id(), H5P_DEFAULT),
      H5Dclose, "create a dataset");
}

Handle write_dataset(hid_t parent, const std::string& name, hid_t type,
                     const std::vector<hsize_t>& extents, const void* values, Storage storage) {
  Handle dataset = create_dataset(parent, name, type, extents, storage);
  if (count_of(extents) > 0)
    check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "write a dataset");
  return dataset;
}

void write_dataset(hid_t parent, const std::string& name, const std::string& text) {
  write_dataset(parent, name, text_type(text.size()).id(), {}, text.c_str());
}

void write_part(hid_t dataset, hid_t type, const std::vector<hsize_t>& start,
                const std::vector<hsize_t>& extents, const void* values) {
  const Handle memory = space(extents);
  const Handle file = own(H5Dget_space(dataset), H5Sclose, "write to a table");
  check(H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, start.data(), nullptr, extents.data(),
                            nullptr),
        "write to a table");
  check(H5Dwrite(dataset, type, memory.id(), file.id(), H5P_DEFAULT, values), "write to a table");
}

void write_attribute(hid_t object, const char* name, const std::string& text) {
  write_texts(object, name, {text}, std::max<std::size_t>(1, text.size()), {});
}

void write_attribute(hid_t object, const char* name, const std::vector<std::string>& texts) {
  std::size_t size = 1;
  for (const std::string& text : texts) size = std::max(size, text.size());
  write_texts(object, name, texts, size, {texts.size()});
}

void write_attribute(hid_t object, const char* name, double value) {
  write(object, name, H5T_NATIVE_DOUBLE, {}, &value);
}

void write_attribute(hid_t object, const char* name, int value) {
  write(object, name, H5T_NATIVE_INT, {}, &value);
}

void rewrite_attribute(hid_t object, const char* name, const std::string& text) {
  write_texts(object, name, {text}, kRewritableText, {});
}

std::vector<std::string> read_texts_attribute(hid_t object, const char* name) {
  const Handle attribute = open_attribute(object, name);
  const Handle stored = own(H5Aget_type(attribute.id()), H5Tclose, "read an attribute");
  const Handle shape = own(H5Aget_space(attribute.id()), H5Sclose, "read an attribute");
  const hssize_t count = check(H5Sget_simple_extent_npoints(shape.id()), "read an attribute");
  constexpr std::size_t most = 65536;  // bytes, and therefore texts
  if (static_cast<std::size_t>(count) > most ||
      static_cast<std::size_t>(count) * H5Tget_size(stored.id()) > most)
    throw Failure("cannot read an attribute: it is too large");
  return take_texts(stored.id(), static_cast<std::size_t>(count), [&](hid_t type, void* memory) {
    check(H5Aread(attribute.id(), type, memory), "read an attribute");
  });
}

std::string read_text_attribute(hid_t object, const char* name) {
  const auto texts = read_texts_attribute(object, name);
  return texts.empty() ? "" : texts.front();
}

double read_number_attribute(hid_t object, const char* name) {
  const Handle attribute = open_attribute(object, name);
  const Handle shape = own(H5Aget_space(attribute.id()), H5Sclose, "read an attribute");
  if (H5Sget_simple_extent_npoints(shape.id()) != 1) {
    throw Failure("cannot read an attribute: it is not one number");
  }
  double value = 0;
  check(H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value), "read an attribute");
  return value;
}

std::string read_text(hid_t parent, const char* name) {
  const Handle dataset = open_dataset(parent, name, "read text");
  const Handle stored = own(H5Dget_type(dataset.id()), H5Tclose, "read text");
  if (count_of(extents_of(dataset.id())) != 1) throw Failure("cannot read text: it is a list");
  constexpr std::size_t most = std::size_t{1} << 26;  // bytes; its type may claim any size
  if (H5Tget_size(stored.id()) > most) throw Failure("cannot read text: it is too large");
  return take_texts(stored.id(), 1,
                    [&](hid_t type, void* memory) {
                      check(H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, memory),
                            "read text");
                    })
      .front();
}

bool exists(hid_t parent, const std::string& path) {
  for (std::size_t slash = path.find('/');; slash = path.find('/', slash + 1)) {
    const std::string part = path.substr(0, slash);
    if (check(H5Lexists(parent, part.c_str(), H5P_DEFAULT), "look up a name") == 0) return false;
    if (slash == std::string::npos) return true;
  }
}

namespace {

/// Values that a compressed dataset can hold at most; of others, those that are stored.
hsize_t most_values(hid_t dataset, hsize_t value_size) {
  const Handle file = own(H5Iget_file_id(dataset), H5Fclose, "read a dataset");
  hsize_t file_size = 0;
  check(H5Fget_filesize(file.id(), &file_size), "read a dataset");
  const hsize_t stored = std::min(H5Dget_storage_size(dataset), file_size);
  const Handle properties = own(H5Dget_create_plist(dataset), H5Pclose, "read a dataset");
  if (H5Pget_layout(properties.id()) != H5D_CHUNKED || H5Pget_nfilters(properties.id()) <= 0)
    return stored / value_size;
  std::array<hsize_t, H5S_MAX_RANK> chunk{};
  const int rank =
      check(H5Pget_chunk(properties.id(), H5S_MAX_RANK, chunk.data()), "read a dataset");
  hsize_t values = 0;
  const Handle shape = own(H5Dget_space(dataset), H5Sclose, "read a dataset");
  check(H5Dget_num_chunks(dataset, shape.id(), &values), "read a dataset");
  const hsize_t most = stored * kMostCompression / value_size;
  for (int i = 0; i < rank; ++i) {
    if (chunk[i] == 0 || values > most / chunk[i]) return most;
    values *= chunk[i];
  }
  return values;
}

}  // namespace

std::vector<hsize_t> extents_of(hid_t dataset) {
  const Handle shape = own(H5Dget_space(dataset), H5Sclose, "read a dataset");
  const int rank = check(H5Sget_simple_extent_ndims(shape.id()), "read a dataset");
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(shape.id(), extents.data(), nullptr), "read a dataset");
  const Handle type = own(H5Dget_type(dataset), H5Tclose, "read a dataset");
  hsize_t left = most_values(dataset, std::max<std::size_t>(1, H5Tget_size(type.id())));
  if (count_of(extents) == 0) return extents;
  for (const hsize_t extent : extents) {
    left /= extent;
    if (left == 0) throw Failure("cannot read a dataset: it claims more values than the file has");
  }
  return extents;
}

template <class Number>
Numbers<Number> read_numbers(hid_t parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name, "read a dataset");
  Numbers<Number> result{extents_of(dataset.id()), {}};
  result.values.resize(count_of(result.extents));
  const hid_t type = std::is_same_v<Number, int> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
  check(H5Dread(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()),
        "read a dataset");
  return result;
}

template Numbers<double> read_numbers(hid_t, const std::string&);
template Numbers<int> read_numbers(hid_t, const std::string&);

std::vector<std::string> link_names(hid_t group) {
  std::vector<std::string> names;
  check(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name<H5L_info_t>, &names),
        "list a group");
  return names;
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  check(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add_name<H5A_info_t>, &names),
        "list attributes");
  return names;
}

}  // namespace gnomon::hdf5
