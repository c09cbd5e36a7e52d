#pragma once

#include <cstdint>
#include <optional>

#include <vp/axi_stream.h>
#include <vp/clock.h>
#include <vp/register_bank.h>
#include <vp/signal.h>

/// The registers as model and software see them.
namespace inverter {

constexpr std::uint32_t CONTROL = 0x0, PACKETS = 0x4, STATUS = 0x8;
constexpr std::uint32_t enable = 1;  ///< of CONTROL: bits are inverted; otherwise words pass
constexpr std::uint32_t done = 1;    ///< of STATUS: a packet has passed since software cleared it

inline constexpr vp::RegisterInfo registers[] = {
    {"CONTROL", CONTROL, 0, vp::Access::read_write, enable, "bit 0: invert"},
    {"PACKETS", PACKETS, 0, vp::Access::read_only, 0, "packets that have passed"},
    {"STATUS", STATUS, 0, vp::Access::write_1_to_clear, done, "bit 0: a packet has passed"},
};

}  // namespace inverter

/// An IP of your own: takes words from one stream, inverts them, gives them to another, one a
/// clock; counts packets, and holds `irq` high until software has seen the last.
class Inverter : public vp::Clocked {
 public:
  Inverter(sc_core::sc_module_name name, vp::Clock& aclk)
      : Clocked(name, aclk), s_axi("s_axi", inverter::registers, {}, &aclk.scheduler()) {
    wake_on(s_axis.tvalid);
    s_axi[inverter::STATUS].after_write(
        [this](std::uint32_t) { irq = s_axi[inverter::STATUS].any(inverter::done); });
  }
  const char* kind() const override { return "Inverter"; }

  vp::RegisterBank s_axi;
  vp::AxiStreamSlave s_axis{"s_axis", *this};
  vp::AxiStreamMaster m_axis{"m_axis", *this};
  vp::Signal<bool> irq{"irq"};

 private:
  struct Beat {
    std::uint32_t data;
    std::uint8_t keep;
    bool last;
  };

  // What it drives changes after the edge, what it reads is from before: as in flip-flops.
  void edge() override {
    if (m_axis.accepted() && m_axis.tlast.get()) packet_passed();
    if (s_axis.sample()) {
      const bool inverts = s_axi[inverter::CONTROL].any(inverter::enable);
      held_ = Beat{inverts ? ~s_axis.tdata.read() : s_axis.tdata.read(), s_axis.tkeep.read(),
                   s_axis.tlast.read()};
    }
    if (m_axis.free()) pass_on();
    s_axis.tready = !held_;
    if (!held_ && !m_axis.tvalid.get() && !s_axis.tvalid.read()) sleep();
  }

  void pass_on() {
    if (!held_) return m_axis.withdraw();
    m_axis.offer(held_->data, held_->last, held_->keep);
    held_.reset();
  }

  void packet_passed() {
    s_axi[inverter::PACKETS] = s_axi[inverter::PACKETS] + 1;
    s_axi[inverter::STATUS].set_bits(inverter::done);
    irq = true;
  }

  std::optional<Beat> held_;
};
