// The parts of a result file that are written once and never change.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <gnomon/results/results.hpp>
#include <string>

#include "results/crash_safe_file.hpp"
#include "results/hdf5_handles.hpp"

namespace gnomon::layout {

hdf5::Handle create_file(hdf5::CrashSafeFile& disk, const std::filesystem::path& path);

/// A group that keeps its links in its own header, with space for `links` of them: a single
/// structure of less than a page changes when a step is added.
hdf5::Handle create_group(hid_t parent, const std::string& name, std::size_t links);

void write_header(hid_t gnomon, const RunHeader& header);
void write_field(hid_t step, const GridField& field);
void write_contact(hid_t group, const std::string& name, const ContactSurface& contact);

}  // namespace gnomon::layout
