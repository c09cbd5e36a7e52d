#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "wave_input.h"

namespace vp {

/// The bytes of `source`, unpacked if they begin as gzip does; several streams behind each other
/// are one. A stream without an end is reported to `note` ("was cut off …"), and what came before
/// is read. Reading throws InputError for damaged data of `file`.
std::unique_ptr<ByteSource> unpacked(std::unique_ptr<ByteSource> source,
                                     const std::filesystem::path& file,
                                     std::function<void(const std::string&)> note);

}  // namespace vp
