#include <zynq/design.h>

#include <pl/axi_image_store/estimate.h>
#include <pl/axi_threshold_bridge/estimate.h>
#include <pl/blob_detection/estimate.h>
#include <pl/clock_crossing/estimate.h>
#include <pl/control_block/estimate.h>
#include <pl/corner_detection/estimate.h>
#include <pl/feature_packaging/estimate.h>
#include <pl/global_threshold/estimate.h>
#include <pl/sensor_input/estimate.h>
#include <xilinx/axi_dma/estimate.h>
#include <xilinx/axi_gpio/estimate.h>
#include <xilinx/axi_interconnect/estimate.h>
#include <xilinx/bram/estimate.h>
#include <xilinx/proc_sys_reset/estimate.h>

namespace platform {

namespace {

constexpr std::uint32_t register_slaves = 4, memory_masters = 2;
constexpr std::uint64_t word_bytes = 4;

class Designer {
 public:
  explicit Designer(Zynq& zynq) : system_(&zynq.ps.fclk_clk0.clk), pixel_(&zynq.ps.fclk_clk1.clk) {}

  void pixel(const char* name, const char* group, vp::IpEstimate estimate) {
    add(name, group, name, pixel_, "ps.fclk_clk1", std::move(estimate));
  }
  void system(const char* name, const char* group, vp::IpEstimate estimate, const char* kind = "") {
    add(name, group, *kind == '\0' ? name : kind, system_, "ps.fclk_clk0", std::move(estimate));
  }
  std::vector<DesignIp> take() { return std::move(design_); }

 private:
  void add(const char* name, const char* group, const char* kind, const vp::Clock* clock,
           const char* clock_name, vp::IpEstimate estimate) {
    design_.push_back(
        {std::string("pl.") + name, name, group, kind, clock, clock_name, std::move(estimate)});
  }

  const vp::Clock* system_;
  const vp::Clock* pixel_;
  std::vector<DesignIp> design_;
};

/// Beats that the DMA of the binary image moved. Those of the image upload are no frame's.
vp::IpEstimate counting_beats(vp::IpEstimate estimate, const ps::Ddr& ddr) {
  estimate.active_clocks = [&ddr] { return ddr.bytes_written / word_bytes; };
  return estimate;
}

}  // namespace

std::vector<DesignIp> design_of(Zynq& zynq) {
  const ProgrammableLogic& pl = zynq.pl;
  const ps::Ddr& ddr = zynq.ps.ddr;
  const pl::Geometry geometry = pl.geometry();
  constexpr const char* features = "feature_extraction";
  constexpr const char* bridge = "data_bridge";
  constexpr const char* image = "image_memory";

  Designer d(zynq);
  d.pixel("corner_detection", features, estimate(pl.corner_detection));
  d.pixel("global_threshold", features, estimate(pl.global_threshold, geometry));
  d.pixel("blob_detection", features, estimate(pl.blob_detection, geometry));
  d.pixel("sensor_input", image, estimate(pl.sensor_input));
  d.pixel("bram", image, estimate(pl.bram));
  d.system("axi_image_store", image, estimate(pl.axi_image_store));
  d.pixel("clock_crossing", bridge, estimate(pl.clock_crossing));
  d.system("control_block", bridge, pl::control_estimate());
  d.system("feature_packaging", bridge, estimate(pl.feature_packaging));
  d.system("axi_threshold_bridge", bridge, counting_beats(estimate(pl.axi_threshold_bridge), ddr));
  // The upload of images is the only work of this one.
  vp::IpEstimate upload = estimate(pl.axi_dma_0);
  upload.active_clocks = [] { return std::uint64_t{0}; };
  d.system("axi_dma_0", image, upload, "axi_dma");
  d.system("axi_dma_1", bridge, counting_beats(estimate(pl.axi_dma_1), ddr), "axi_dma");
  d.system("axi_gpio_0", bridge, estimate(pl.axi_gpio_0), "axi_gpio");
  d.system("axi_gpio_1", bridge, estimate(pl.axi_gpio_1), "axi_gpio");
  vp::IpEstimate registers = xilinx::register_interconnect_estimate(register_slaves);
  registers.active_clocks = [&pl] {
    return xilinx::clocks_per_access *
           (xilinx::accesses(pl.axi_gpio_0.s_axi) + xilinx::accesses(pl.axi_gpio_1.s_axi) +
            xilinx::accesses(pl.axi_dma_1.s_axi_lite));
  };
  d.system("axi_interconnect", bridge, registers);
  d.system("axi_mem_interconnect", bridge,
           counting_beats(xilinx::memory_interconnect_estimate(memory_masters), ddr),
           "axi_interconnect");
  d.system("proc_sys_reset", bridge, estimate(pl.proc_sys_reset));
  return d.take();
}

report::ResourceReport resource_report(const std::vector<DesignIp>& design) {
  report::ResourceReport report;
  report.device = "xc7z020";
  report.available = {53'200, 106'400, 140, 220};
  report::ResourceReport::Amount& total = report.total;
  for (const DesignIp& ip : design) {
    const vp::IpEstimate& e = ip.estimate;
    const report::ResourceReport::Amount amount{static_cast<double>(e.lut),
                                                static_cast<double>(e.ff), e.bram36,
                                                static_cast<double>(e.dsp)};
    report.modules.push_back({ip.module, amount, e.uncertainty_percent, e.source});
    total.lut += amount.lut;
    total.ff += amount.ff;
    total.bram36 += amount.bram36;
    total.dsp += amount.dsp;
  }
  const auto& available = report.available;
  if (total.lut > available.lut) report.over.emplace_back("lut");
  if (total.ff > available.ff) report.over.emplace_back("ff");
  if (total.bram36 > available.bram36) report.over.emplace_back("bram36");
  if (total.dsp > available.dsp) report.over.emplace_back("dsp");
  return report;
}

}  // namespace platform
