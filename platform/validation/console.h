#pragma once

#include <string>

#include <validation/validation.h>

namespace platform::validation {

/// The whole report for a terminal: every row, the reasons, the gates and the verdict.
std::string console_text(const Validation& validation);

}  // namespace platform::validation
