#pragma once

#include <hal/hal.h>
#include <vp/register_description.h>

#include <boost/test/unit_test.hpp>
#include <cstdint>

namespace bench {

/// What a program sees of a register that nothing happened to.
inline std::uint32_t seen_after_reset(const vp::RegisterInfo& info) {
  return info.access == vp::Access::write_only ? 0 : info.reset;
}

/// Writes each bit alone, then all, then none, to a register without side effects: exactly the
/// writable bits change. Leaves the reset value.
inline void check_stored_bits(std::uint32_t base, const vp::RegisterInfo& info) {
  const std::uint32_t address = base + info.offset;
  const std::uint32_t fixed = info.reset & ~info.writable;
  BOOST_TEST_CONTEXT(info.name) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      hal_write32(address, 1u << bit);
      BOOST_TEST(hal_read32(address) == (fixed | (1u << bit & info.writable)), "bit " << bit);
    }
    hal_write32(address, 0xFFFF'FFFF);
    BOOST_TEST(hal_read32(address) == (fixed | info.writable));
    hal_write32(address, 0);
    BOOST_TEST(hal_read32(address) == fixed);
    hal_write32(address, info.reset);
    BOOST_TEST(hal_read32(address) == info.reset);
  }
}

}  // namespace bench
