#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <input/image_file.h>
#include <sweep/manifest.h>

namespace platform::sweep {

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string content_hash(std::string_view bytes);

/// The same of a file's content. Throws vp::InputError if it cannot be read.
std::string file_hash(const std::string& path);

/// Digits of a hash that name a point: 128 bits.
inline constexpr std::size_t key_digits = 32;

/// This program: version and revision; of sources that no revision names, the executable's hash.
Json program_identity(const std::string& version, const std::string& revision);

/// Hashes of the tables that are installed beside the program: costs of the software, power.
Json table_contents();

/// Hashes of the PS program's file, and of the files that the configuration names, with the files
/// that those name in turn.
Json file_contents(const std::string& program_file,
                   const std::map<std::string, std::string>& configuration);

/// Name and hash of each input, groups and folders resolved: of a file its bytes, of a scene its
/// definition. Throws vp::InputError for one that does not exist or does not fit.
Json input_contents(const std::vector<std::string>& inputs, const InputChoice& choice,
                    input::ImageSize size);

}  // namespace platform::sweep
