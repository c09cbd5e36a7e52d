#pragma once

#include <memory>
#include <systemc>

#include <chip/system/design.h>
#include <marker/designs/marker/marker_parts.h>
#include <marker/designs/marker/marker_work.h>
#include <pl/feature_extraction/feature_extraction.h>
#include <xilinx/axi_dma/axi_dma.h>
#include <xilinx/axi_gpio/axi_gpio.h>
#include <xilinx/axi_interconnect/axi_interconnect.h>
#include <xilinx/concat/concat.h>
#include <xilinx/proc_sys_reset/proc_sys_reset.h>

namespace platform {

/// The whole programmable logic: the feature extraction and what Xilinx provides around it, wired
/// as the thesis' figure 4.2 (letters of tables 4.2 and 4.3).
class ProgrammableLogic : public pl::FeatureExtraction {
 public:
  /// `filter`: models of a filter between sensor and detectors; null: there is none.
  ProgrammableLogic(sc_core::sc_module_name name, vp::Clock& system_clk, vp::Clock& pixel_clk,
                    pl::Fidelity otherwise, const pl::Models<pl::PixelFilter>* filter = nullptr);

  xilinx::ProcSysReset proc_sys_reset;           ///< G
  xilinx::AxiInterconnect axi_interconnect;      ///< H: GP0 to the registers
  xilinx::AxiInterconnect axi_mem_interconnect;  ///< J: DMA to HP0
  xilinx::AxiGpio axi_gpio_0;                    ///< B: control packet, all outputs
  xilinx::AxiGpio axi_gpio_1;                    ///< C: feature words, all inputs
  xilinx::AxiDma axi_dma_0;                      ///< E: images to the PL, read channel only
  xilinx::AxiDma axi_dma_1;                      ///< F: binary image to DDR, write channel only
  vp::AxiStream image_stream_link{"image_stream"};
  vp::AxiStream binary_stream_link{"binary_stream"};
  xilinx::Concat concat;  ///< interrupts of both DMAs

  MarkerParts parts();
};

/// The marker detector's logic in the Zynq, in the thesis' wiring.
class MarkerDesign : public ProgrammableLogic, public MarkerWork {
 public:
  /// `filter`: models of a filter between sensor and detectors; null: there is none.
  MarkerDesign(sc_core::sc_module_name name, PlPorts& ports,
               const pl::Models<pl::PixelFilter>* filter = nullptr);

  using MarkerWork::settle;
};

/// For DesignInfo::make.
std::unique_ptr<Design> make_marker_design(const char* name, PlPorts& ports);

}  // namespace platform
