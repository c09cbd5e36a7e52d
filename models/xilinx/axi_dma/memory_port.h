#pragma once

#include <cstdint>
#include <systemc>
#include <tlm>
#include <vector>

#include <vp/clock_scheduler.h>
#include <vp/mm_link.h>
#include <xilinx/axi_dma/write_orders.h>

namespace xilinx {

/// Bytes of a word: streams and memory maps are 32 bits wide, if a build says no more.
constexpr unsigned word_bytes = 4;

/// A memory path that several masters share: read and write data channel, each busy until a clock
/// cycle. Contention is arithmetic: a burst starts when it wants to or when the channel is free,
/// whichever is later.
struct MemoryPath {
  std::uint64_t read_free = 0;
  std::uint64_t write_free = 0;
};

/// The memory master of a DMA channel: bursts from inside clock edges, where b_transport is not
/// allowed.
///
/// Memory that gives direct access is read and written at once. Other targets are accessed by a
/// thread of the port with b_transport, which begins at the time of the edge and takes the target's
/// time; done() tells when.
class MemoryPort : public sc_core::sc_module {
 public:
  MemoryPort(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "xilinx::MemoryPort"; }

  vp::MmLink link{"link"};
  /// What it is to write, if its core says so.
  WriteOrders orders;

  /// Uses `path` together with other ports. Before the first burst.
  void share(MemoryPath& path) { path_ = &path; }
  MemoryPath& path() { return *path_; }

  /// One burst. `fixed`: all beats, of `beat_bytes`, go to the same address (keyhole). `data` stays
  /// valid until done().
  void read(std::uint64_t address, unsigned char* data, unsigned bytes, bool fixed,
            unsigned beat_bytes = word_bytes);
  void write(std::uint64_t address, unsigned char* data, unsigned bytes, bool fixed,
             unsigned beat_bytes = word_bytes);
  /// One burst of any kind. Bytes from `width` on go to the first addresses again. `enables`: a
  /// byte for each of `data`, or null; it stays valid, too.
  void transfer(tlm::tlm_command command, std::uint64_t address, unsigned char* data,
                unsigned bytes, unsigned width, unsigned char* enables);

  /// One burst, read at once if the memory gives direct access to all of it. False: not read.
  bool read_directly(std::uint64_t address, void* data, unsigned bytes);

  /// Reads without time or trace; false: no such memory.
  bool peek(std::uint64_t address, void* data, unsigned bytes);

  /// The last burst is over.
  bool done() const { return done_; }
  /// Its answer: TLM_OK_RESPONSE or an error.
  tlm::tlm_response_status response() const { return payload_.get_response_status(); }

 private:
  bool access_directly();
  unsigned char* direct_pointer(tlm::tlm_command command, std::uint64_t address, unsigned bytes);
  const tlm::tlm_dmi* window(tlm::tlm_command command, std::uint64_t address, unsigned bytes) const;
  void run();

  vp::ClockScheduler& scheduler_;
  MemoryPath own_path_;
  MemoryPath* path_ = &own_path_;
  tlm::tlm_generic_payload payload_;
  std::vector<tlm::tlm_dmi> windows_;
  sc_core::sc_event start_;
  bool done_ = true;
};

}  // namespace xilinx
