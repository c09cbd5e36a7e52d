#include <designs/marker/programmable_logic.h>

#include <marker_logic.h>
#include <vp/error.h>
#include <xilinx/common/estimate.h>
#include <initializer_list>

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
  build.burst_beats = burst_words;
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
  name_groups();
  count_work();
}

// Their order is that of reports: own IP as in the thesis' table 4.1, then table 4.2.
void ProgrammableLogic::name_groups() {
  unsigned place = 0;
  const auto group = [&place](const char* name, std::initializer_list<vp::Ip*> parts) {
    for (vp::Ip* part : parts) part->set_group(name, place++);
  };
  group("feature_extraction", {&corner_detection, &global_threshold, &blob_detection});
  group("image_memory", {&sensor_input, &bram, &axi_image_store});
  group("data_bridge",
        {&clock_crossing, &control_block, &feature_packaging, &axi_threshold_bridge});
  group("image_memory", {&axi_dma_0});
  group("data_bridge", {&axi_dma_1, &axi_gpio_0, &axi_gpio_1, &axi_interconnect,
                        &axi_mem_interconnect, &proc_sys_reset});
}

// The upload of an image is no frame's work: in the thesis' system a sensor is in its place.
void ProgrammableLogic::count_work() {
  axi_dma_0.set_active_clocks([] { return std::uint64_t{0}; });
  const auto words_out = [this] { return axi_dma_1.beats(); };
  axi_threshold_bridge.set_active_clocks(words_out);
  axi_mem_interconnect.set_active_clocks(words_out);
  axi_interconnect.set_active_clocks([this] {
    return xilinx::clocks_per_access *
           (xilinx::accesses(axi_gpio_0.s_axi) + xilinx::accesses(axi_gpio_1.s_axi) +
            xilinx::accesses(axi_dma_1.s_axi_lite));
  });
}

}  // namespace platform
