#include <xilinx/axi_interconnect/axi_interconnect.h>

#include <vp/error.h>
#include <vp/hex.h>

namespace xilinx {

namespace {

constexpr std::uint64_t smallest_segment =
    4096;  // bytes: an AXI burst never crosses such a boundary

}  // namespace

AxiInterconnect::AxiInterconnect(sc_core::sc_module_name name, const vp::Clock& aclk)
    : Router(name, &aclk) {}

tlm_utils::simple_initiator_socket<vp::MmLink>& AxiInterconnect::map(const std::string& region_name,
                                                                     std::uint64_t base,
                                                                     std::uint64_t size,
                                                                     Addresses addresses) {
  const bool power_of_two = size != 0 && (size & (size - 1)) == 0;
  if (!power_of_two || size < smallest_segment || base % size != 0) {
    throw vp::InputError(
        std::string(name()) + ": the segment of " + region_name + " at " + vp::hex(base) +
        ", size " + vp::hex(size) +
        ": the size must be a power of two of at least 4 KiB, the base a multiple of it");
  }
  return Router::map(region_name, base, size, addresses);
}

}  // namespace xilinx
