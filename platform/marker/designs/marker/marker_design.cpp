#include <marker/designs/marker/marker_design.h>

#include <axi_gpio_registers.h>
#include <facts/result.h>
#include <marker/input/image_need.h>
#include <marker/report/marker_frame.h>
#include <marker/result.h>
#include <marker_logic.h>
#include <vp/clock.h>
#include <vp/error.h>
#include <vp/register_bank.h>
#include <vp/report.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <xilinx/common/axi_lite_ip.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace platform {

namespace {

namespace addresses = marker_logic::addresses;

xilinx::AxiGpioBuild gpio(xilinx::GpioDirection direction) {
  xilinx::AxiGpioBuild build;
  build.gpio.direction = direction;
  return build;
}

xilinx::AxiDmaBuild one_channel(bool mm2s, std::uint32_t burst_words) {
  xilinx::AxiDmaBuild build;
  build.include_mm2s = mm2s;
  build.include_s2mm = !mm2s;
  build.mm2s_burst_beats = build.s2mm_burst_beats = burst_words;
  return build;
}

/// LENGTH must hold a burst.
void check_length(const xilinx::AxiDma& dma, std::uint32_t burst_words) {
  const std::uint64_t bytes = std::uint64_t{burst_words} * marker_logic::bytes_per_word;
  if (bytes < std::uint64_t{1} << dma.length_width) return;
  throw vp::InputError(std::string(dma.length_width.name()) + " is " +
                       std::to_string(dma.length_width) + ": a burst of " +
                       std::to_string(burst_words) + " words (pl.burst_words) has " +
                       std::to_string(bytes) + " bytes and needs " +
                       std::to_string(marker_logic::bits_for(bytes + 1, 8)));
}

}  // namespace

ProgrammableLogic::ProgrammableLogic(sc_core::sc_module_name name, vp::Clock& system_clk,
                                     vp::Clock& pixel_clk, pl::Fidelity otherwise,
                                     const pl::Models<pl::PixelFilter>* filter)
    : FeatureExtraction(name, system_clk, pixel_clk, otherwise, filter),
      proc_sys_reset("proc_sys_reset", system_clk),
      axi_interconnect("axi_interconnect", system_clk),
      axi_mem_interconnect("axi_mem_interconnect", system_clk),
      axi_gpio_0("axi_gpio_0", system_clk, gpio(xilinx::GpioDirection::all_outputs)),
      axi_gpio_1("axi_gpio_1", system_clk, gpio(xilinx::GpioDirection::all_inputs)),
      axi_dma_0("axi_dma_0", system_clk, one_channel(true, burst_words)),
      axi_dma_1("axi_dma_1", system_clk, one_channel(false, burst_words)),
      concat("concat", 2) {
  for (const xilinx::AxiDma* dma : {&axi_dma_0, &axi_dma_1}) check_length(*dma, burst_words);
  axi_interconnect.connect(axi_dma_0.s_axi_lite, addresses::dma_image);
  axi_interconnect.connect(axi_dma_1.s_axi_lite, addresses::dma_binary);
  axi_interconnect.connect(axi_gpio_0.s_axi, addresses::gpio_control);
  axi_interconnect.connect(axi_gpio_1.s_axi, addresses::gpio_features);

  axi_gpio_0.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_gpio_1.s_axi_aresetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_0.axi_resetn(proc_sys_reset.peripheral_aresetn);
  axi_dma_1.axi_resetn(proc_sys_reset.peripheral_aresetn);
  por()(proc_sys_reset.peripheral_reset);

  gpio_in()(axi_gpio_0.gpio.io_o);
  axi_gpio_1.gpio.io_i(feature_packaging.feature);
  axi_dma_0.mm2s().m_axis(image_stream_link);
  image_stream()(image_stream_link);
  binary_stream()(binary_stream_link);
  axi_dma_1.s2mm().s_axis(binary_stream_link);

  axi_mem_interconnect.connect(axi_dma_0);
  axi_mem_interconnect.connect(axi_dma_1);
  concat.connect_interrupt(axi_dma_0.mm2s_introut, addresses::dma_image_interrupt);
  concat.connect_interrupt(axi_dma_1.s2mm_introut, addresses::dma_binary_interrupt);
  arrange(parts());
}

MarkerParts ProgrammableLogic::parts() {
  return {this,
          geometry(),
          feature_packaging.feature,
          sensor_input.frame_ena,
          global_threshold.active_threshold,
          blob_detection.label_overflow,
          clock_crossing.crossing_overflow,
          feature_packaging.feature_overflow,
          axi_threshold_bridge.bridge_overflow,
          control_block.logic_clock(),
          bram.logic_clock(),
          proc_sys_reset,
          axi_interconnect,
          axi_mem_interconnect,
          axi_gpio_0,
          axi_gpio_1,
          axi_dma_0,
          axi_dma_1};
}

MarkerDesign::MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
                           const pl::Models<pl::PixelFilter>* filter)
    : ProgrammableLogic(name, ports.fclk_clk(0), ports.fclk_clk(1), ports.fidelity, filter),
      MarkerWork(parts(), ports) {
  ports.m_axi_gp0(axi_interconnect);
  ports.s_axi_hp0(axi_mem_interconnect);
  ports.irq_f2p(concat.dout);
  proc_sys_reset.ext_reset_in(ports.fclk_reset0_n());
}

std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports) {
  return std::make_unique<MarkerDesign>(name, ports);
}

}  // namespace platform
