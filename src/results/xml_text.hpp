// Text in XML, and files that begin with a known text.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// Every XDMF file of gnomon begins so.
inline constexpr const char* xdmf_head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Xdmf Version=\"3.0\">\n"
    "  <Domain>\n";
inline constexpr const char* xdmf_end = "  </Domain>\n</Xdmf>\n";

/// With the characters replaced that have a meaning in XML.
std::string escaped(const std::string& text);

bool begins_with(const std::filesystem::path& file, const std::string& text);

}  // namespace gnomon
