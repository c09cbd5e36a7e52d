#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <fpga/synthesis/rtl_design.h>

/// Files that RTL reads into memories.
namespace platform::synthesis {

/// Files that sources of `$readmemh`, `$readmemb` or textio name, by the name that the source has:
/// beside the source, else below the folders of the sources and of --include one whose path ends
/// so, or one of that last name, as markervp_add_rtl() finds them. Throws vp::InputError for a name
/// that two files have which differ.
std::map<std::string, std::filesystem::path> data_files_of(const Design& design);

}  // namespace platform::synthesis
