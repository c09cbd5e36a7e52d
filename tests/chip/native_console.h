#pragma once

#include <string>
#include <utility>
#include <vector>

/// What a program prints on the virtual platform.
std::vector<std::string> native_console(
    const std::string& program_file,
    const std::vector<std::pair<std::string, std::string>>& settings = {});
