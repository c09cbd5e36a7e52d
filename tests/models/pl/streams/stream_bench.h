#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <axi_dma_registers.h>
#include <pl/blob_stream/blob_stream.h>
#include <pl/camera/camera.h>
#include <pl/pixel_stream/pixel_stream.h>
#include <vp/report.h>
#include <vp/router.h>
#include <xilinx/axi_dma/axi_dma.h>
#include "bus_master.h"
#include "frames.h"
#include "memory_target.h"
#include "pipeline.h"
#include "simulation.h"

namespace streams {

constexpr std::uint64_t period = 10'000;  // ps
constexpr pl::Geometry small_frame{64, 16, 32};
constexpr std::uint32_t frame_bytes = 64 * 16;
constexpr std::uint32_t memory_bytes = 0x10000;

/// A DMA with a memory of its own, and software that arms it.
class ArmedDma {
 public:
  /// `memory_words`: that a clock writes.
  ArmedDma(const std::string& name, vp::Clock& clk, std::uint32_t memory_words = 1)
      : dma((name + "_dma").c_str(), clk, build(memory_words)),
        software((name + "_software").c_str()),
        router((name + "_router").c_str()),
        memory((name + "_memory").c_str(), memory_bytes),
        link((name + "_link").c_str()) {
    software.socket.bind(dma.s_axi_lite.socket);
    router.map("memory", 0, memory_bytes).bind(memory.socket);
    dma.s2mm().m_axi.link.socket.bind(router.socket);
    dma.s2mm().s_axis(link);
  }

  void arm(std::uint32_t address, std::uint32_t bytes) {
    software.write(axi_dma::S2MM_DMACR, axi_dma::dmacr::RS | axi_dma::dmacr::IOC_IrqEn);
    software.write(axi_dma::S2MM_DA, address);
    software.write(axi_dma::S2MM_LENGTH, bytes);
  }
  void acknowledge() { software.write(axi_dma::S2MM_DMASR, axi_dma::dmasr::IOC_Irq); }
  void reset() { software.write(axi_dma::S2MM_DMACR, axi_dma::dmacr::Reset); }
  std::uint32_t received() { return software.read(axi_dma::S2MM_LENGTH); }

  xilinx::AxiDma dma;
  kit::BusMaster software;
  vp::Router router;
  kit::MemoryTarget memory;
  vp::AxiStream link;

 private:
  static xilinx::AxiDmaBuild build(std::uint32_t memory_words) {
    xilinx::AxiDmaBuild build;
    build.s2mm.memory_bytes = memory_words * xilinx::word_bytes;
    build.include_mm2s = false;
    build.mm2s_burst_beats = build.s2mm_burst_beats = 16;
    return build;
  }
};

/// The small frame, so many pixels a clock.
inline pl::Geometry in_groups(std::uint32_t pixels_per_clock) {
  pl::Geometry geometry = small_frame;
  geometry.pixels_per_clock = pixels_per_clock;
  return geometry;
}

/// Camera and pixel stream, and a DMA behind them. 100 MHz.
struct PixelBench : kit::Simulation {
  explicit PixelBench(pl::Fidelity fidelity, const std::vector<std::string>& assignments = {},
                      std::uint32_t pixels_per_clock = 1)
      : settings(assignments),
        geometry(in_groups(pixels_per_clock)),
        made_camera(make(pl::Camera::models(), fidelity)),
        made_stream(make(pl::PixelStream::models(), fidelity)) {
    reports.redirect(warnings);
    camera.ena(ena);
    camera.rst(rst);
    camera.por(por);
    camera.hold(hold);
    stream.rst(rst);
    stream.ena(camera.frame_ena);
    stream.pixel(camera.pixel);
    stream.more_pixels(camera.more_pixels);
    stream.frames(camera.frames);
    stream.m(pixels.link);
  }

  template <class Ip>
  std::unique_ptr<Ip> make(const pl::Models<Ip>& models, pl::Fidelity fidelity) {
    const auto& model = models.list().at(fidelity == pl::Fidelity::clocked ? 0 : 1);
    return model.make(models.ip().c_str(), {clk, geometry});
  }

  /// Between edge `cycle` and the next one.
  void at(std::uint64_t cycle) {
    kit::BusMaster::wait_until(cycle * period + period / 2);
    scheduler.synchronise();
  }
  /// The next edge samples a rise of `ena`. Returns its number.
  std::uint64_t trigger() {
    ena = false;
    at(clk.cycle() + 1);
    ena = true;
    return clk.cycle() + 1;
  }
  void pulse_rst() {
    rst = true;
    at(clk.cycle() + 1);
    rst = false;
  }
  void run(std::function<void()> script) {
    pixels.software.simulate([this, script = std::move(script)] {
      at(4);
      pulse_rst();
      script();
    });
  }

  harness::Settings settings;
  const pl::Geometry geometry;
  vp::ClockScheduler scheduler{"scheduler"};
  vp::Clock clk{"clk", scheduler, 100'000'000};
  vp::Signal<bool> ena{"ena"}, rst{"rst"}, por{"por"}, hold{"hold"};
  std::unique_ptr<pl::Camera> made_camera;
  std::unique_ptr<pl::PixelStream> made_stream;
  pl::Camera& camera = *made_camera;
  pl::PixelStream& stream = *made_stream;
  std::ostringstream warnings;  ///< of the DMA, about what software does wrong
  vp::ReportRouter reports;
  ArmedDma pixels{"pixels", clk, geometry.pixels_per_clock == 4 ? 2u : 1u};
};

}  // namespace streams
