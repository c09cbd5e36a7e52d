#pragma once

namespace chip {

/// An option that the build sets to another value than its default.
struct OptionOverride {
  const char* program;
  const char* option;
  double value;
};

/// Written by CMake from MARKERVP_CHIP_OPTIONS; ends with a nullptr.
extern const OptionOverride option_overrides[];

}  // namespace chip
