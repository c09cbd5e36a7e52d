#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <vp/hierarchy.h>
#include <vp/mm_link.h>
#include <vp/signal.h>
#include <vp/text_signal.h>
#include <zynq/device_names.h>
#include <zynq/zynq.h>

namespace platform {

/// Makes what passes the buses readable in a trace, below the link it passes:
///
///   ps.cpu.m_axi.access                     "write axi_dma_1.S2MM_LENGTH 0x00000080", then ""
///   pl.axi_dma_1.….burst                    "write 0x00100080 128 bytes", until the next
///   pl.axi_dma_1.….burst_address, burst_bytes, bursts
///
/// An access stands from when it leaves the processor to when its answer is there. Polls make every
/// read, no time changes by that.
class BusTrace {
 public:
  /// Before the simulation starts.
  explicit BusTrace(Zynq& zynq);
  ~BusTrace();
  BusTrace(const BusTrace&) = delete;
  BusTrace& operator=(const BusTrace&) = delete;

 private:
  class Accesses;
  class Bursts;

  DeviceNames names_;
  std::vector<std::unique_ptr<vp::MmObserver>> observers_;
};

}  // namespace platform
