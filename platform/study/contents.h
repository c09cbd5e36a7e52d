#pragma once

#include <map>
#include <string>

#include <study/point.h>

/// Hashes of what decides a result beside the settings: the program, its tables, the user's files.
namespace platform::study {

/// This program: version and revision; of sources that no revision names, the executable's hash.
Json program_identity(const std::string& version, const std::string& revision);

/// Hashes of the tables that are installed beside the program: costs of the software, power.
Json table_contents();

/// Hashes of the PS program's file, and of the files that the configuration names, with the files
/// that those name in turn.
Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration);

}  // namespace platform::study
