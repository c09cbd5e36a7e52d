#pragma once

#include <hal/hal.h>

#include <string>

namespace ps {

/// What makes a description unusable, as the end of a sentence that begins with the program's name;
/// empty if nothing does. Reads all of its tables, so a wrong count or pointer is a fault here.
std::string problem_of(const hal_program& program);

}  // namespace ps
