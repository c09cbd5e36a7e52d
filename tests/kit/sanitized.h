#pragma once

/// What sanitizers change besides finding faults: memory of their own, time, descriptors that they
/// need to judge an object.
namespace kit {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

}  // namespace kit
