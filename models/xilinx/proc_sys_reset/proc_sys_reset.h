#pragma once

#include <cstdint>
#include <systemc>

#include <vp/clock.h>
#include <vp/ip.h>
#include <vp/parameter.h>
#include <vp/signal.h>

namespace xilinx {

/// Processor System Reset v5.0 (PG164): stretches a reset and releases the parts of a design one
/// after the other.
///
/// A reset input that is active for `external_width` clocks (behind the synchroniser) asserts all
/// outputs. When it is inactive for as long, the outputs are released after 16 (bus, interconnect),
/// 32 (peripherals) and 48 clocks (processor).
class ProcSysReset : public vp::Clocked, public vp::Ip {
 public:
  ProcSysReset(sc_core::sc_module_name name, vp::Clock& slowest_sync_clk);
  const char* kind() const override { return "xilinx::ProcSysReset"; }

  vp::Parameter<bool> released_at_start;
  vp::Parameter<std::uint32_t> synchroniser_stages;
  vp::Parameter<std::uint32_t> external_width;
  vp::Parameter<std::uint32_t> step_clocks;

  vp::In<bool> ext_reset_in{"ext_reset_in",
                            this};  ///< active low, from FCLK_RESETn of the PS; may be left open
  vp::In<bool> aux_reset_in{"aux_reset_in", this};  ///< active high; may be left open
  vp::In<bool> dcm_locked{"dcm_locked", this};      ///< low is a reset; may be left open

  vp::Signal<bool> bus_struct_reset;
  vp::Signal<bool> interconnect_aresetn;
  vp::Signal<bool> peripheral_reset;
  vp::Signal<bool> peripheral_aresetn;
  vp::Signal<bool> mb_reset;

 private:
  void edge() override;
  void end_of_elaboration() override;
  vp::IpEstimate own_estimate() const override;
  bool requested() const;
  void drive(bool bus, bool peripheral, bool processor);

  bool filtered_ = false;       ///< the reset behind synchroniser and filter
  std::uint32_t differs_ = 0;   ///< clocks for which the input differed from it
  std::uint32_t sequence_ = 0;  ///< clocks since the filtered reset fell
};

}  // namespace xilinx
