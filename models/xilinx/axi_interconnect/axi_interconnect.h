#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/register_bank.h>
#include <vp/router.h>
#include <xilinx/axi_dma/memory_port.h>

namespace xilinx {

class AxiDma;

/// AXI Interconnect v2.1 (PG059): the router with the address rules of its crossbar. A segment is a
/// power of two of at least 128 bytes and starts at a multiple of its size.
class AxiInterconnect : public vp::Router, public vp::Ip {
 public:
  AxiInterconnect(sc_core::sc_module_name name, const vp::Clock& aclk);
  const char* kind() const override { return "xilinx::AxiInterconnect"; }

  /// Throws vp::InputError if the segment breaks the rules above or overlaps another.
  tlm_utils::simple_initiator_socket<vp::MmLink>& map(
      const std::string& region_name, std::uint64_t base, std::uint64_t size,
      Addresses addresses = Addresses::relative) override;
  /// Maps the registers of a device, by its name. Where they are is a property of the device,
  /// `base_address`, with `base` as its default. Throws vp::InputError as map() does.
  void connect(vp::RegisterBank& registers, std::uint64_t base, std::uint64_t size = 0x1'0000);
  /// Lets the channels of a DMA engine reach the memory behind it, which they share with other
  /// engines. The estimate is that of 32-bit masters at a port of 64 bit (HP0) then; otherwise that
  /// of one AXI3 master (GP0) before AXI4-Lite slaves.
  void connect(AxiDma& dma);
  /// The same for another master of the PL.
  void connect(MemoryPort& master);
  /// The same for one master, which has a port for each direction.
  void connect(MemoryPort& read, MemoryPort& write);

 private:
  vp::IpEstimate own_estimate() const override;

  std::vector<std::unique_ptr<vp::Parameter<std::uint64_t>>> base_addresses_;

  void share(MemoryPort& port);

  std::uint32_t memory_masters_ = 0;
  MemoryPath memory_path_;
};

}  // namespace xilinx
