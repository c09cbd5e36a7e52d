#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <axi_dma_registers.h>
#include <simulation.h>
#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/clock_scheduler.h>
#include <vp/report.h>
#include <vp/router.h>
#include <xilinx/axi_dma/axi_dma.h>
#include "bus_master.h"
#include "memory_target.h"

namespace kit {

/// Notes the bursts of a DMA's memory port.
struct BurstLog : vp::MmObserver {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> bursts;  ///< address, bytes
  bool needs_transactions() const override { return false; }
  void direct(vp::MmLink&, tlm::tlm_command, std::uint64_t address, std::uint64_t bytes) override {
    bursts.emplace_back(address, bytes);
  }
};

/// An AXI DMA at 100 MHz with memory, a stream that takes and a stream that gives, and software.
struct DmaBench : Simulation {
  static constexpr std::uint64_t period = 10'000;  // ps
  static constexpr std::uint32_t memory_base = 0x10000000;
  static constexpr std::uint32_t memory_size = 0x100000;
  static constexpr std::uint32_t broken_base = 0x20000000;   ///< answers SLVERR
  static constexpr std::uint32_t nothing_base = 0x30000000;  ///< answers DECERR

  explicit DmaBench(const xilinx::AxiDmaBuild& build = {}) : dma("dma", clock, build) {
    reports.redirect(text);
    software.socket.bind(dma.s_axi_lite.socket);
    router.map("memory", memory_base, memory_size).bind(memory.socket);
    router.map("broken", broken_base, 0x1000).bind(broken.socket);
    router.map("extra", memory_base + memory_size, 0x1000).bind(extra.socket);
    for (MemoryTarget* bad : {&broken, &extra}) {
      bad->answer = tlm::TLM_GENERIC_ERROR_RESPONSE;
      bad->allow_dmi = false;
    }
    sink.s_axis(mm2s_link);
    source.m_axis(s2mm_link);
    if (build.include_mm2s) {
      dma.mm2s().m_axi.link.socket.bind(router.socket);
      dma.mm2s().m_axis(mm2s_link);
      dma.mm2s().m_axi.link.add_observer(mm2s_bursts);
    }
    if (build.include_s2mm) {
      dma.s2mm().m_axi.link.socket.bind(router.socket);
      dma.s2mm().s_axis(s2mm_link);
      dma.s2mm().m_axi.link.add_observer(s2mm_bursts);
    }
    if (build.include_sg) {
      dma.scatter_gather().m_axi.link.socket.bind(router.socket);
      dma.scatter_gather().m_axi.link.add_observer(sg_bursts);
    }
    dma.axi_resetn(resetn);
    std::iota(memory.data(), memory.data() + memory_size, 0);
  }

  std::uint32_t read(std::uint32_t offset) { return software.read(offset); }
  void write(std::uint32_t offset, std::uint32_t word) { software.write(offset, word); }
  /// Just after edge `cycle`.
  void at(std::uint64_t cycle) { BusMaster::wait_until(cycle * period); }
  std::uint32_t read_at(std::uint64_t cycle, std::uint32_t offset) {
    at(cycle);
    return read(offset);
  }
  /// The first edge on which `condition` holds, looking at each from now on. 0 after `limit` of
  /// them.
  std::uint64_t first_edge(const std::function<bool()>& condition, std::uint64_t limit = 20'000) {
    std::uint64_t cycle = clock.cycle();
    for (std::uint64_t end = cycle + limit; cycle < end; ++cycle) {
      at(cycle);
      scheduler.synchronise();
      if (condition()) return cycle;
    }
    return 0;
  }
  bool status(std::uint32_t offset, std::uint32_t bits) { return dma.s_axi_lite[offset].any(bits); }
  void start_mm2s(std::uint32_t address, std::uint32_t bytes) {
    write(axi_dma::MM2S_DMACR, axi_dma::dmacr::RS);
    write(axi_dma::MM2S_SA, address);
    write(axi_dma::MM2S_LENGTH, bytes);
  }
  void start_s2mm(std::uint32_t address, std::uint32_t bytes) {
    write(axi_dma::S2MM_DMACR, axi_dma::dmacr::RS);
    write(axi_dma::S2MM_DA, address);
    write(axi_dma::S2MM_LENGTH, bytes);
  }
  void send_packet(unsigned beats, std::uint32_t first = 0x1000) {
    for (unsigned i = 0; i < beats; ++i) source.send(first + i, i + 1 == beats);
  }
  std::uint64_t warnings(const std::string& id) const {
    return reports.count("/markervp/axi_dma/" + id);
  }

  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clock{"clock", scheduler, 100'000'000};
  BusMaster software{"software"};
  vp::Signal<bool> resetn{"resetn", 1, true};
  xilinx::AxiDma dma;
  vp::Router router{"router"};
  MemoryTarget memory{"memory", memory_size};
  MemoryTarget broken{"broken", 0x1000};
  MemoryTarget extra{"extra", 0x1000};  ///< behind the memory; answers SLVERR
  vp::AxiStream mm2s_link{"mm2s_link"}, s2mm_link{"s2mm_link"};
  vp::StreamSink sink{"sink", clock};
  vp::StreamSource source{"source", clock};
  BurstLog mm2s_bursts, s2mm_bursts, sg_bursts;
  std::ostringstream text;
  vp::ReportRouter reports;
};

}  // namespace kit
