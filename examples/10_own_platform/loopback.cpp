// A platform of your own: the processing system of a Zynq-7000, and in its programmable logic two
// DMA engines and an IP of this folder. The PS program is part of the executable.
//
//   ps.m_axi_gp0 ──> registers ─┬─ 0x4040'0000  dma_0      m_axis_mm2s ──> inverter ──> s_axis_s2mm
//                               ├─ 0x4041'0000  dma_1      m_axis_mm2s ──> sink
//                               │                          source      ──> s_axis_s2mm
//                               └─ 0x4300'0000  inverter
//   ps.s_axi_hp0 <── memory  <── memory ports of both DMA engines
//   ps.gic       <── irq_f2p <── inverter.irq (61), dma_1.s2mm_introut (62)
//
// The test bench sends what comes to `sink` back through `source`.
#include <axi_dma_registers.h>
#include <chip/system/processing_system.h>
#include <drivers/axi_dma.h>
#include <drivers/gic.h>
#include <hal/hal.h>
#include <ps/cpu/cpu_time.h>
#include <ps/cpu/program.h>
#include <vp/axi_stream.h>
#include <vp/clock_scheduler.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/router.h>
#include <vp/unit.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/concat/concat.h>

#include <cstdint>
#include <exception>
#include <iostream>
#include <systemc>

#include "inverter.h"

namespace {

constexpr std::uint32_t dma_base[] = {0x4040'0000, 0x4041'0000};
constexpr std::uint32_t inverter_base = 0x4300'0000;
constexpr std::uint32_t window = 0x1'0000;
constexpr std::uint32_t inverter_irq = 61, dma_1_irq = 62;
constexpr std::uint32_t words = 256, bytes = 4 * words;

/// The hardware: one line for each component, then one for each wire.
struct Platform : sc_core::sc_module {
  explicit Platform(sc_core::sc_module_name name) : sc_module(name) {
    ps.m_axi_gp0.link.socket.bind(registers.socket);
    registers.map("dma_0", dma_base[0], window).bind(dma_0.s_axi_lite.socket);
    registers.map("dma_1", dma_base[1], window).bind(dma_1.s_axi_lite.socket);
    registers.map("inverter", inverter_base, window).bind(inverter.s_axi.socket);
    for (xilinx::AxiDma* dma : {&dma_0, &dma_1}) {
      dma->mm2s().m_axi.link.socket.bind(memory.socket);
      dma->s2mm().m_axi.link.socket.bind(memory.socket);
    }
    memory.map("s_axi_hp0", 0, 0x4000'0000, vp::Router::Addresses::absolute)
        .bind(ps.s_axi_hp0.socket);
    dma_0.mm2s().m_axis(to_inverter);
    inverter.s_axis(to_inverter);
    inverter.m_axis(from_inverter);
    dma_0.s2mm().s_axis(from_inverter);
    dma_1.mm2s().m_axis(to_sink);
    sink.s_axis(to_sink);
    source.m_axis(from_source);
    dma_1.s2mm().s_axis(from_source);
    interrupts.connect_interrupt(inverter.irq, inverter_irq);
    interrupts.connect_interrupt(dma_1.s2mm_introut, dma_1_irq);
    ps.gic.irq_f2p(interrupts.dout);
    ps.start_clocks();
  }

  platform::Chip chip;
  vp::ClockScheduler scheduler{"scheduler"};
  platform::ProcessingSystem ps{"ps", scheduler, chip};
  vp::Clock& aclk = ps.fclk_clk0.clk;

  vp::Router registers{"registers"};
  vp::Router memory{"memory"};
  xilinx::AxiDma dma_0{"dma_0", aclk};
  xilinx::AxiDma dma_1{"dma_1", aclk};
  Inverter inverter{"inverter", aclk};
  xilinx::Concat interrupts{"interrupts", 2};
  vp::AxiStream to_inverter{"to_inverter"}, from_inverter{"from_inverter"};
  vp::AxiStream to_sink{"to_sink"}, from_source{"from_source"};
  vp::StreamSink sink{"sink", aclk};
  vp::StreamSource source{"source", aclk};
};

/// The test bench: what the logic sends, it gets back, plus one.
class Echo : public vp::Clocked {
 public:
  Echo(sc_core::sc_module_name name, Platform& platform)
      : Clocked(name, platform.aclk), platform_(platform) {}

 private:
  void edge() override {
    for (; next_ < platform_.sink.beats.size(); ++next_) {
      const auto& beat = platform_.sink.beats[next_];
      platform_.source.send(beat.data + 1, beat.last);
    }
  }

  Platform& platform_;
  std::size_t next_ = 0;
};

// ---- The PS program. It knows addresses and interrupts, and nothing of the above.

using Channel = drivers::AxiDmaConfig::Channel;

drivers::Gic gic;
drivers::AxiDma from_memory[2], to_memory[2];
volatile unsigned packets;

void on_inverter(void*) {
  hal_write32(inverter_base + inverter::STATUS, inverter::done);
  packets = packets + 1;
}

void on_dma_1(void*) {
  to_memory[1].acknowledge();
  packets = packets + 1;
}

void wait_for_packet(unsigned number) {
  for (bool over = false; !over;) {
    hal_interrupt_enable(false);
    over = packets >= number;
    if (!over) hal_wait_for_interrupt();
    hal_interrupt_enable(true);
  }
}

std::uint32_t pattern(std::uint32_t i) {
  return 0x0102'0304u * (i + 1);
}

/// Sends a packet out and back. How many words came back other than `expected`.
template <class Expected>
unsigned round_trip(unsigned dma, Expected expected) {
  const hal_dma_buffer out = hal_dma_allocate(bytes, 32), in = hal_dma_allocate(bytes, 32);
  if (!out.data || !in.data) return words;
  auto* const sent = static_cast<std::uint32_t*>(out.data);
  for (std::uint32_t i = 0; i < words; ++i) sent[i] = pattern(i);
  hal_cache_flush(out.data, bytes);
  const unsigned before = packets;
  to_memory[dma].start(in.bus_address, bytes);
  from_memory[dma].start(out.bus_address, bytes);
  wait_for_packet(before + 1);
  while ((to_memory[dma].status() & axi_dma::dmasr::Idle) == 0) continue;
  hal_cache_invalidate(in.data, bytes);
  const auto* const came = static_cast<const std::uint32_t*>(in.data);
  unsigned wrong = 0;
  for (std::uint32_t i = 0; i < words; ++i) wrong += came[i] != expected(pattern(i)) ? 1 : 0;
  return wrong;
}

int program() {
  for (unsigned dma = 0; dma < 2; ++dma) {
    if (!from_memory[dma].initialise({dma_base[dma], Channel::memory_to_stream}) ||
        !to_memory[dma].initialise({dma_base[dma], Channel::stream_to_memory}))
      return 1;
    from_memory[dma].set_completion_interrupt(false);
  }
  to_memory[0].set_completion_interrupt(false);  // the inverter tells
  gic.initialise();
  gic.connect(inverter_irq, drivers::Trigger::level_high, &on_inverter, nullptr);
  gic.connect(dma_1_irq, drivers::Trigger::level_high, &on_dma_1, nullptr);
  hal_interrupt_enable(true);

  hal_write32(inverter_base + inverter::CONTROL, inverter::enable);
  if (round_trip(0, [](std::uint32_t word) { return ~word; }) != 0) return 2;
  if (hal_read32(inverter_base + inverter::PACKETS) != 1) return 3;
  hal_write32(inverter_base + inverter::CONTROL, 0);
  if (round_trip(0, [](std::uint32_t word) { return word; }) != 0) return 4;
  if (round_trip(1, [](std::uint32_t word) { return word + 1; }) != 0) return 5;
  return 0;
}

const hal_program description = {HAL_ABI, "loopback", program, nullptr, 0, nullptr, 0, nullptr, 0};

}  // namespace

int sc_main(int, char**) {
  const vp::ReportRouter reports;
  try {
    Platform platform("platform");
    const Echo echo("echo", platform);
    const auto loopback = ps::Program::linked(description);
    ps::Cpu& cpu = platform.ps.cpu;
    cpu.load(*loopback, ps::CostTable("none"));
    sc_core::sc_start();
    cpu.check();
    const bool passed = cpu.exit_code() == 0 && platform.sink.beats.size() == words;
    std::cout << "three packets of " << bytes << " bytes out and back in "
              << vp::format_time(cpu.end_ps()) << "; the program returned " << cpu.exit_code()
              << ", " << platform.sink.beats.size() << " words came to the sink\n"
              << (passed ? "passed" : "failed") << std::endl;
    return passed ? 0 : 1;
  } catch (const vp::InputError& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 3;
  }
}
