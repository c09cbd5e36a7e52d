#pragma once

#include <cstdint>

#include <chip/system/design.h>

namespace platform {

/// What a shared object with a design says of itself, as `markervp_design`.
struct DesignDescriptor {
  std::uint32_t abi;     ///< design_abi
  const char* version;   ///< of the headers that it was built with
  const char* compiler;  ///< that built it
  const DesignInfo& (*info)();
};

/// Changes with every change to what designs see, if the version stays.
inline constexpr std::uint32_t design_abi = 8;

}  // namespace platform

/// Makes the shared object a design: once, outside of namespaces. `function` returns its
/// DesignInfo.
#define MARKERVP_DESIGN(function)                                                             \
  extern "C" __attribute__((visibility("default")))                                           \
  const platform::DesignDescriptor markervp_design = {platform::design_abi, MARKERVP_VERSION, \
                                                      __VERSION__, function};
