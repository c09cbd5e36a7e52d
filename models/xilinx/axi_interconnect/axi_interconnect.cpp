#include <xilinx/axi_interconnect/axi_interconnect.h>

#include <vp/error.h>
#include <vp/ip.h>
#include <vp/text.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/common/axi_lite_ip.h>

namespace xilinx {

namespace {

// Bytes: Vivado's address editor offers no less; 1 KiB is in public designs.
constexpr std::uint64_t smallest_segment = 128;

}  // namespace

AxiInterconnect::AxiInterconnect(sc_core::sc_module_name name, const vp::Clock& aclk)
    : Router(name, &aclk), Ip(&aclk) {}

void AxiInterconnect::connect(AxiDma& dma) {
  const auto add = [this](MemoryPort& port) {
    share(port);
    ++memory_masters_;
  };
  if (dma.include_mm2s) add(dma.mm2s().m_axi);
  if (dma.include_s2mm) add(dma.s2mm().m_axi);
  if (dma.include_sg) add(dma.scatter_gather().m_axi);
}

void AxiInterconnect::connect(MemoryPort& master) {
  share(master);
  ++memory_masters_;
}

void AxiInterconnect::connect(MemoryPort& read, MemoryPort& write) {
  share(read);
  share(write);
  ++memory_masters_;
}

void AxiInterconnect::share(MemoryPort& port) {
  port.share(memory_path_);
  port.link.socket.bind(socket);
}

// With the protocol converter of the registers, or the width converter of the memory port.
vp::IpEstimate AxiInterconnect::own_estimate() const {
  if (memory_masters_ != 0) {
    return axi_estimate("axi_interconnect", 400 + 250 * memory_masters_,
                        500 + 300 * memory_masters_, 0);
  }
  const auto slaves = static_cast<std::uint32_t>(regions().size());
  return axi_estimate("axi_interconnect", 200 + 45 * slaves, 260 + 55 * slaves, 0);
}

tlm_utils::simple_initiator_socket<vp::MmLink>& AxiInterconnect::map(const std::string& region_name,
                                                                     std::uint64_t base,
                                                                     std::uint64_t size,
                                                                     Addresses addresses) {
  const bool power_of_two = size != 0 && (size & (size - 1)) == 0;
  if (!power_of_two || size < smallest_segment || base % size != 0) {
    throw vp::InputError(
        std::string(name()) + ": the segment of " + region_name + " at " + vp::hex(base) +
        ", size " + vp::hex(size) +
        ": the size must be a power of two of at least 128 bytes, the base a multiple of it");
  }
  return Router::map(region_name, base, size, addresses);
}

void AxiInterconnect::connect(vp::RegisterBank& registers, std::uint64_t base, std::uint64_t size) {
  auto& device = dynamic_cast<sc_core::sc_module&>(*registers.get_parent_object());
  const vp::HierarchyScope scope(device);
  const auto& chosen = *base_addresses_.emplace_back(std::make_unique<vp::Parameter<std::uint64_t>>(
      "base_address", base, vp::Unit::address, vp::Range<std::uint64_t>{0, 0xFFFF'FFFF},
      vp::Source::decision, "where software finds the registers, " + vp::hex(size) + " bytes"));
  try {
    map(device.basename(), chosen, size).bind(registers.socket);
  } catch (const vp::InputError& error) {
    throw vp::InputError(std::string(error.what()) + " (" + chosen.name() + " says where it is)");
  }
}

}  // namespace xilinx
