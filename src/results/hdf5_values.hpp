// Reads and writes strings, numbers and arrays as HDF5 datasets and attributes.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

/// The type of text: UTF-8 of at most `size` bytes, padded with zeros. Never of variable length,
/// because such text is in HDF5's global heap,
/// which has no checksum and crashes the library when damaged.
Handle text_type(std::size_t size);
/// A dataspace of the given extents; none: a scalar.
Handle space(const std::vector<hsize_t>& extents);
/// Compressed, where that pays: in chunks, gzip after shuffle; only what is written once, as a
/// whole, for a chunk that changes would have to be replaced while readers see it.
enum class Storage { plain, compressed };
Handle create_dataset(hid_t parent, const std::string& name, hid_t type,
                      const std::vector<hsize_t>& extents, Storage storage = Storage::plain);

void write_attribute(hid_t object, const char* name, const std::string& text);
void write_attribute(hid_t object, const char* name, const std::vector<std::string>& texts);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, int value);
std::string read_text_attribute(hid_t object, const char* name);
std::vector<std::string> read_texts_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name);

/// Text that can be rewritten in place: at most a thousand bytes, longer text is truncated.
void rewrite_attribute(hid_t object, const char* name, const std::string& text);

void write_dataset(hid_t parent, const std::string& name, const std::vector<hsize_t>& extents,
                   const double* values, Storage storage = Storage::plain);
void write_dataset(hid_t parent, const std::string& name, const std::vector<hsize_t>& extents,
                   const int* values, Storage storage = Storage::plain);
void write_dataset(hid_t parent, const std::string& name, const std::string& text);
std::string read_text(hid_t parent, const char* name);

bool exists(hid_t parent, const std::string& path);
/// Extents of a dataset. Throws Failure when it claims more bytes than the file has: sizes from a
/// damaged file must not reach an allocation.
std::vector<hsize_t> extents_of(hid_t dataset);
struct Doubles {
  std::vector<hsize_t> extents;
  std::vector<double> values;
};
Doubles read_doubles(hid_t parent, const std::string& name);
std::vector<int> read_ints(hid_t parent, const std::string& name);

/// The names of the links (group) or attributes (object), sorted.
std::vector<std::string> link_names(hid_t group);
std::vector<std::string> attribute_names(hid_t object);

}  // namespace gnomon::hdf5
