#include "fir_design.h"

#include <vp/clock.h>

#include <algorithm>
#include <cstring>

using platform::facts::InputNeed;
using platform::facts::UnitReport;
using platform::facts::Work;

FirFilter::FirFilter(sc_core::sc_module_name name, vp::Clock& clock)
    : Clocked(name, clock),
      Ip(&clock),
      gain("gain", 1, vp::Unit::none, {1, 1000}, vp::Source::decision, "factor of the output") {}

void FirFilter::edge() {
  if (s_axis.sample()) fifo_.emplace_back(filter_.next(s_axis.tdata, gain), s_axis.tlast);
  if (m_axis.free()) {
    if (fifo_.empty()) {
      m_axis.withdraw();
    } else {
      m_axis.offer(fifo_.front().first, fifo_.front().second);
      fifo_.pop_front();
    }
  }
  s_axis.tready = fifo_.size() + 1 < depth;
}

vp::IpEstimate FirFilter::own_estimate() const {
  vp::IpEstimate e;
  e.lut = 180;
  e.ff = 230;
  e.dsp = 3;
  e.uncertainty_percent = 50;
  e.source = "assumed: four taps of 32 bits, a FIFO of four words";
  e.fmax_hz = 200'000'000;
  e.fmax_documentation = "assumed: one multiplication a clock";
  return e;
}

namespace {

xilinx::AxiDmaBuild one_channel(bool mm2s) {
  xilinx::AxiDmaBuild build;
  build.include_mm2s = mm2s;
  build.include_s2mm = !mm2s;
  return build;
}

}  // namespace

FirDesign::FirDesign(sc_core::sc_module_name name, platform::PlPorts& ports, bool takes_samples)
    : sc_module(name),
      ports_(ports),
      takes_samples_(takes_samples),
      registers_("axi_interconnect", ports.fclk_clk(0)),
      memory_("axi_mem_interconnect", ports.fclk_clk(0)),
      axi_dma_0_("axi_dma_0", ports.fclk_clk(0), one_channel(true)),
      axi_dma_1_("axi_dma_1", ports.fclk_clk(0), one_channel(false)),
      filter_("filter", ports.fclk_clk(0)),
      concat_("concat", 2) {
  ports.m_axi_gp0(registers_);
  ports.s_axi_hp0(memory_);
  ports.irq_f2p(concat_.dout);
  registers_.connect(axi_dma_0_.s_axi_lite, fir::dma_in);
  registers_.connect(axi_dma_1_.s_axi_lite, fir::dma_out);
  memory_.connect(axi_dma_0_);
  memory_.connect(axi_dma_1_);
  concat_.connect_interrupt(axi_dma_0_.mm2s_introut, 61);
  concat_.connect_interrupt(axi_dma_1_.s2mm_introut, 62);
  axi_dma_0_.axi_resetn(ports.fclk_reset0_n());
  axi_dma_1_.axi_resetn(ports.fclk_reset0_n());
  axi_dma_0_.mm2s().m_axis(samples_);
  filter_.s_axis(samples_);
  filter_.m_axis(filtered_);
  axi_dma_1_.s2mm().s_axis(filtered_);
}

Work FirDesign::work() const {
  Work work;
  work.unit = "block";
  work.job = "every word of a block is filtered as the program expects";
  work.tallies = {{"loud", "above 1000", "none above 1000"}};
  work.figures = {{"peak", "V", "largest word of a block", platform::facts::Better::less}};
  return work;
}

InputNeed FirDesign::input() const {
  if (!takes_samples_) return {};
  return {"samples", fir::block_words * sizeof(std::uint32_t)};
}

bool FirDesign::report(const platform::Publication& publication, UnitReport& block) {
  fir::Result result;
  if (publication.kind != fir::result_kind || publication.size != sizeof result) return false;
  std::memcpy(&result, publication.data, sizeof result);
  block.index = result.index;
  block.end_ps = publication.ps;
  const std::uint64_t ps =
      ports_.ps.cpu_clk.clk.duration_ps(2.0 * static_cast<double>(result.cycles));
  block.start_ps = publication.ps - std::min(publication.ps, ps);
  block.times = {{"filter", ps, block.start_ps, "block", "", "the DMA engines and the filter"},
                 {"block", ps, block.start_ps}};
  block.counts.set("words", result.words);
  block.counts.lose("lost_words", fir::block_words - result.words);
  block.figures = {{"peak", static_cast<double>(result.peak)}};
  if (result.peak > 1000) block.tallies.emplace_back("loud");
  if (result.wrong > 0) block.failures.emplace_back("with wrong words");
  return true;
}

const platform::DesignInfo& fir_design() {
  static const platform::DesignInfo fir{
      "fir",
      "a filter of four taps between two DMA engines, on files of samples",
      {"filtering"},
      true,
      platform::no_words,
      [](const char* name, platform::PlPorts& ports) -> std::unique_ptr<platform::Design> {
        return std::make_unique<FirDesign>(name, ports, true);
      }};
  return fir;
}
