#pragma once

#include <string>
#include <vector>

#include <validation/gnuplot.h>
#include <validation/validation.h>

namespace platform::validation {

/// The page docs/validation.md. Its pictures are expected in `pictures`, relative to it.
std::string markdown_text(const Validation& validation, const std::vector<Plot>& plots,
                          const std::string& pictures);

}  // namespace platform::validation
