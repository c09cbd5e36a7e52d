#pragma once

#include <string>

#include <validation/validation.h>

namespace platform::validation {

/// validation.json: profile, fitted constants, rows, gates, verdict. Nothing in it depends on the
/// host.
std::string json_text(const Validation& validation);

/// validation.csv: a line for each row.
std::string rows_csv(const Validation& validation);

/// frames.csv: a line for each frame and system: counts, times in us, errors.
std::string frames_csv(const Validation& validation);

}  // namespace platform::validation
