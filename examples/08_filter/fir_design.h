#pragma once

#include <chip/system/design.h>
#include <vp/axi_stream.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/concat/concat.h>

#include <cstdint>
#include <deque>
#include <utility>

#include "fir.h"

/// A filter between two streams: one word a clock.
class FirFilter : public vp::Clocked, public vp::Ip {
 public:
  FirFilter(sc_core::sc_module_name name, vp::Clock& clock);

  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster m_axis{"m_axis", *this};
  vp::Parameter<std::uint32_t> gain;

 private:
  void edge() override;
  vp::IpEstimate own_estimate() const override;

  static constexpr std::size_t depth = 4;
  fir::Filter filter_;
  std::deque<std::pair<std::uint32_t, bool>> fifo_;
};

/// A design without any picture: samples go through a filter by two DMA engines. Its blocks come
/// from a file of samples, or from its program.
class FirDesign : public sc_core::sc_module, public platform::Design {
 public:
  FirDesign(sc_core::sc_module_name name, platform::PlPorts& ports, bool takes_samples);

  platform::facts::Work work() const override;
  platform::facts::InputNeed input() const override;
  bool report(const platform::Publication& publication,
              platform::facts::UnitReport& block) override;

 private:
  platform::PlPorts& ports_;
  const bool takes_samples_;
  xilinx::AxiInterconnect registers_, memory_;
  xilinx::AxiDma axi_dma_0_, axi_dma_1_;
  FirFilter filter_;
  xilinx::Concat concat_;
  vp::AxiStream samples_{"samples"}, filtered_{"filtered"};
};

/// "fir": blocks from a file of samples.
const platform::DesignInfo& fir_design();
