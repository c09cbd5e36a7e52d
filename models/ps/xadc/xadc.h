#pragma once

#include <cstdint>
#include <deque>
#include <systemc>

#include <board/hosts.h>
#include <board/xadc.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

namespace vp {
class ClockScheduler;
}

namespace ps {

/// The processing system's interface to the XADC. A command is carried out at once: its answer
/// (that of the command before it, as on the chip) is there in the next access, which no driver
/// waits for.
class XadcInterface : public sc_core::sc_module, public board::AnalogueHost {
 public:
  XadcInterface(sc_core::sc_module_name name, vp::ClockScheduler& scheduler);
  const char* kind() const override { return "ps::XadcInterface"; }

  vp::RegisterBank registers;   ///< at 0xF800_7100
  vp::Signal<bool> irq{"irq"};  ///< interrupt 39, active high

  void set_input(unsigned channel, double value) override;
  board::Xadc& converter() { return converter_; }

 private:
  void command(std::uint32_t word);
  void answer_read();
  std::uint32_t status() const;
  void update();

  board::Xadc converter_;
  vp::Register& cfg_;
  vp::Register& int_sts_;
  vp::Register& int_mask_;
  vp::Register& mctl_;
  std::deque<std::uint32_t> answers_;
  std::uint32_t next_answer_ = 0;  ///< of the last command
};

}  // namespace ps
