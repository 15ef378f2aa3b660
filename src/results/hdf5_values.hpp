// Reads and writes strings, numbers and arrays as HDF5 datasets and attributes.
#pragma once

#include <hdf5.h>

#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

/// The type of text: UTF-8 of at most `size` bytes, padded with zeros. Never of variable length,
/// because such text is in HDF5's global heap,
/// which has no checksum and crashes the library when damaged.
Handle text_type(std::size_t size);
/// Compressed, where that pays: in chunks, gzip after shuffle; only what is written once, as a
/// whole, for a chunk that changes would have to be replaced while readers see it. Growing: in
/// chunks, to any number of rows.
enum class Storage { plain, compressed, growing };
/// Without extents it is a scalar.
Handle create_dataset(hid_t parent, const std::string& name, hid_t type,
                      const std::vector<hsize_t>& extents, Storage storage = Storage::plain);
/// The same with its values.
Handle write_dataset(hid_t parent, const std::string& name, hid_t type,
                     const std::vector<hsize_t>& extents, const void* values,
                     Storage storage = Storage::plain);
void write_dataset(hid_t parent, const std::string& name, const std::string& text);
/// Writes a part of a dataset that has been created.
void write_part(hid_t dataset, hid_t type, const std::vector<hsize_t>& start,
                const std::vector<hsize_t>& extents, const void* values);

void write_attribute(hid_t object, const char* name, const std::string& text);
void write_attribute(hid_t object, const char* name, const std::vector<std::string>& texts);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, int value);
std::string read_text_attribute(hid_t object, const char* name);
std::vector<std::string> read_texts_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name);

/// Text that can be rewritten in place: at most a thousand bytes, longer text is truncated.
void rewrite_attribute(hid_t object, const char* name, const std::string& text);

std::string read_text(hid_t parent, const char* name);

bool exists(hid_t parent, const std::string& path);
/// Extents of a dataset. Throws Failure when it claims more bytes than the file has: sizes from a
/// damaged file must not reach an allocation.
std::vector<hsize_t> extents_of(hid_t dataset);
/// A dataset of numbers, double or int.
template <class Number>
struct Numbers {
  std::vector<hsize_t> extents;
  std::vector<Number> values;
};
template <class Number>
Numbers<Number> read_numbers(hid_t parent, const std::string& name);

/// The names of the links (group) or attributes (object), sorted.
std::vector<std::string> link_names(hid_t group);
std::vector<std::string> attribute_names(hid_t object);

}  // namespace gnomon::hdf5
