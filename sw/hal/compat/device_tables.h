#pragma once

// What the drivers know of AXI GPIO, AXI timer and AXI DMA: the values of xparameters.h under the
// driver's names, whatever the instances are called. A design may have more devices than the header
// that this library was built with; their values come from the platform.

#include <hal/hal.h>
#include <xparameters.h>

#include <cstdint>

namespace markervp_compat {

/// How many devices of a driver are looked up: as many as one AXI interconnect has masters (PG059).
constexpr unsigned most_devices = 16;

/// How many there are of `instances`.
inline unsigned devices(std::uint32_t instances) {
  return instances < most_devices ? instances : most_devices;
}

/// The number in `text`, the expansion of a macro. An undefined macro expands to its own name: that
/// gives `otherwise`. Suffixes do not count.
constexpr std::uint32_t number_or(const char* text, std::uint32_t otherwise) {
  if (*text < '0' || *text > '9') return otherwise;
  const bool hexadecimal = text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  std::uint32_t value = 0;
  for (text += hexadecimal ? 2 : 0; *text != '\0'; ++text) {
    const char digit = *text >= 'a' ? static_cast<char>(*text - 'a' + 'A') : *text;
    if (digit >= '0' && digit <= '9') {
      value = value * (hexadecimal ? 16 : 10) + static_cast<std::uint32_t>(digit - '0');
    } else if (hexadecimal && digit >= 'A' && digit <= 'F') {
      value = value * 16 + static_cast<std::uint32_t>(digit - 'A' + 10);
    } else {
      break;
    }
  }
  return value;
}

/// What an interrupt has in the vendor's tables that is not wired.
constexpr std::uint32_t no_interrupt = 0xFFFF;

}  // namespace markervp_compat

#define MARKERVP_TEXT(value) #value
#define MARKERVP_EXPANDED(value) MARKERVP_TEXT(value)

/// HAL_XPAR of a name that xparameters.h need not define.
#define MARKERVP_XPAR(name, otherwise) \
  hal_xpar(#name, markervp_compat::number_or(MARKERVP_EXPANDED(XPAR_##name), otherwise))

/// A table with an entry for each device that is looked up.
#define MARKERVP_EACH_DEVICE(entry)                                                           \
  {                                                                                           \
    entry(0), entry(1), entry(2), entry(3), entry(4), entry(5), entry(6), entry(7), entry(8), \
        entry(9), entry(10), entry(11), entry(12), entry(13), entry(14), entry(15)            \
  }
