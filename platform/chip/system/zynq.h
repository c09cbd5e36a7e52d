#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <utility>

#include <chip/system/design.h>
#include <chip/system/processing_system.h>
#include <vp/clock_scheduler.h>
#include <vp/parameter.h>
#include <vp/rule_reports.h>

namespace platform {

/// A Zynq-7000 with a design in its programmable logic: everything that is simulated.
struct Zynq {
  /// `otherwise` and `usual_cores`: the fidelity, and how many cores the processor has, if the
  /// configuration says nothing else. Throws vp::InputError for a design that cannot be built.
  explicit Zynq(const DesignInfo& design, pl::Fidelity otherwise = pl::Fidelity::tlm,
                std::uint32_t usual_cores = 1);

  vp::Parameter<pl::Fidelity> fidelity;
  Chip chip;
  vp::ProtocolChecks checks{"checks"};
  vp::ClockScheduler scheduler{"scheduler"};
  ProcessingSystem ps;
  PlPorts ports{ps, scheduler, fidelity};

  /// The module of the design.
  sc_core::sc_module& pl() { return design_->module(); }
  const sc_core::sc_module& pl() const { return design_->module(); }
  Design& design() { return *design_; }

  /// Brings all memories and counters up to now, for observers from outside.
  void settle() {
    scheduler.synchronise();
    design_->settle();
  }

  /// The word that the processor would find at an address, without any effect; none: nothing
  /// answers there.
  std::optional<std::uint32_t> peek(std::uint32_t address);
  /// Puts a word there, without the effects of a write. False: nothing answers there.
  bool poke(std::uint32_t address, std::uint32_t word);
  /// Called for each word that poke() writes. May be null.
  void on_poke(std::function<void(std::uint32_t address)> listener) {
    poke_listener_ = std::move(listener);
  }

  /// What the processor finds at an address; of several the nearest to the device. "" for nothing.
  std::string device_at(std::uint32_t address) const;

 private:
  /// The same for messages: a block of the chip without a model is named, too.
  ps::Answerer answerer_at(std::uint32_t address) const;
  std::string request_text(const ps::Gic& gic, const ps::Gic::Request& request);
  bool look(tlm::tlm_command command, std::uint32_t address, std::uint32_t& word);

  std::unique_ptr<Design> design_;
  std::function<void(std::uint32_t)> poke_listener_;
};

}  // namespace platform
