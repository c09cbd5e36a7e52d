#pragma once

#include <pl/feature_extraction/feature_extraction.h>
#include <vp/clock.h>
#include <vp/signal.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>

namespace platform {

/// What a marker design consists of, whether it was built in C++ or from a hand-off: letters of the
/// thesis' tables 4.2 and 4.3.
struct MarkerParts {
  pl::FeatureExtraction* models;  ///< null: RTL is in their place
  pl::Geometry geometry;
  vp::SignalBase& feature;
  vp::SignalBase &frame_ena, &active_threshold;
  /// What was lost, each since the last reset.
  vp::SignalBase &label_overflow, &crossing_overflow, &feature_overflow, &bridge_overflow;
  const vp::Clock &system_clk, &pixel_clk;
  xilinx::ProcSysReset& proc_sys_reset;           ///< G
  xilinx::AxiInterconnect& axi_interconnect;      ///< H: GP0 to the registers
  xilinx::AxiInterconnect& axi_mem_interconnect;  ///< J: DMA to HP0
  xilinx::AxiGpio& control;                       ///< B: control packet, all outputs
  xilinx::AxiGpio& features;                      ///< C: feature words, all inputs
  xilinx::AxiDma& image_dma;                      ///< E: images to the PL, read channel only
  xilinx::AxiDma& binary_dma;                     ///< F: binary image to DDR, write channel only
};

/// Names the groups of the parts in reports, and says which clocks they work in.
void arrange(const MarkerParts& parts);

}  // namespace platform
