// Strings, numbers and arrays in and out of HDF5 datasets and attributes.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

/// The type of text: UTF-8 of variable length, which Python reads as str.
Handle text_type();
/// A dataspace of the given extents; none: a scalar.
Handle space(const std::vector<hsize_t>& extents);
/// Creates a dataset that is written once; properties may be H5P_DEFAULT.
Handle create_dataset(hid_t parent, const std::string& name, hid_t type,
                      const std::vector<hsize_t>& extents, hid_t properties = H5P_DEFAULT);

void write_attribute(hid_t object, const char* name, const std::string& text);
void write_attribute(hid_t object, const char* name, const std::vector<std::string>& texts);
void write_attribute(hid_t object, const char* name, double value);
void write_attribute(hid_t object, const char* name, int value);
std::string read_text_attribute(hid_t object, const char* name);
std::vector<std::string> read_texts_attribute(hid_t object, const char* name);
double read_number_attribute(hid_t object, const char* name);

/// Text that is rewritten in place: a fixed number of bytes, cut to fit.
void write_fixed_text(hid_t object, const char* name, const std::string& text, bool create);

void write_dataset(hid_t parent, const std::string& name, const std::vector<hsize_t>& extents,
                   const double* values);
void write_dataset(hid_t parent, const std::string& name, const std::vector<hsize_t>& extents,
                   const int* values);
void write_dataset(hid_t parent, const std::string& name, const std::string& text);
std::string read_text(hid_t parent, const char* name);

bool exists(hid_t parent, const std::string& path);
/// Extents of a dataset. Throws Failure when it claims more bytes than the file has: sizes from a
/// damaged file must not reach an allocation.
std::vector<hsize_t> extents_of(hid_t dataset);
/// A whole dataset, whose extents must have `rank` entries.
struct Doubles {
  std::vector<hsize_t> extents;
  std::vector<double> values;
};
Doubles read_doubles(hid_t parent, const std::string& name);
std::vector<int> read_ints(hid_t parent, const std::string& name);

/// Visits the names of the links (group) or attributes (object), in order of name.
std::vector<std::string> link_names(hid_t group);
std::vector<std::string> attribute_names(hid_t object);

}  // namespace gnomon::hdf5
