#include <ps_xadc_registers.h>

#include <ps/xadc/xadc.h>

#include <vp/report.h>

namespace ps {

namespace {

vp::RegisterBankOptions xadc_options() {
  vp::RegisterBankOptions options;
  options.holes = vp::RegisterBankOptions::Holes::acknowledge;
  options.address_bits = 8;
  return options;
}

}  // namespace

XadcInterface::XadcInterface(sc_core::sc_module_name name, vp::ClockScheduler& scheduler)
    : sc_module(name),
      registers("registers", ps_xadc::registers, xadc_options(), &scheduler),
      cfg_(registers[ps_xadc::CFG]),
      int_sts_(registers[ps_xadc::INT_STS]),
      int_mask_(registers[ps_xadc::INT_MASK]),
      mctl_(registers[ps_xadc::MCTL]) {
  registers[ps_xadc::MSTS].computed_by([this] { return status(); });
  registers[ps_xadc::CMDFIFO].after_write([this](std::uint32_t word) { command(word); });
  vp::Register& answers = registers[ps_xadc::RDFIFO];
  answers.computed_by([this] { return answers_.empty() ? 0u : answers_.front(); });
  answers.after_read([this](std::uint32_t) { answer_read(); });
  for (vp::Register* r : {&cfg_, &int_sts_, &int_mask_}) {
    r->after_write([this](std::uint32_t) { update(); });
  }
  mctl_.after_write([this](std::uint32_t) {
    if (!mctl_.any(ps_xadc::mctl_RESET)) return update();
    converter_.reset();
    answers_.clear();
    next_answer_ = 0;
    update();
  });
}

void XadcInterface::set_input(unsigned channel, double value) {
  converter_.set(channel, value);
  update();
}

void XadcInterface::command(std::uint32_t word) {
  if (mctl_.any(ps_xadc::mctl_RESET)) {
    vp::warn(*this, "/markervp/xadc/in_reset",
             "CMDFIFO written while MCTL.RESET is 1: ignored; write 0 to MCTL first");
    return;
  }
  if (answers_.size() < ps_xadc::fifo_depth) answers_.push_back(next_answer_);
  const std::uint32_t what = word >> ps_xadc::command::CMD_shift & 0xF;
  const unsigned address = word >> ps_xadc::command::ADDR_shift & (board::Xadc::register_count - 1);
  if (what == ps_xadc::command::write) converter_.write(address, static_cast<std::uint16_t>(word));
  next_answer_ = what == ps_xadc::command::read ? converter_.read(address) : 0;
  update();
}

void XadcInterface::answer_read() {
  if (!answers_.empty()) answers_.pop_front();
  update();
}

std::uint32_t XadcInterface::status() const {
  std::uint32_t bits = ps_xadc::msts::CFIFOE | converter_.alarms();
  if (answers_.empty()) bits |= ps_xadc::msts::DFIFOE;
  if (answers_.size() == ps_xadc::fifo_depth) bits |= ps_xadc::msts::DFIFOF;
  return bits | static_cast<std::uint32_t>(answers_.size()) << ps_xadc::msts::DFIFO_LVL_shift;
}

// Commands never wait, so their FIFO is below its level all the time.
void XadcInterface::update() {
  const std::uint32_t level = (cfg_ & ps_xadc::cfg::DFIFOTH) >> ps_xadc::cfg::DFIFOTH_shift;
  std::uint32_t events = ps_xadc::event::CFIFO_LTH | converter_.alarms();
  if (answers_.size() > level) events |= ps_xadc::event::DFIFO_GTH;
  int_sts_.set_bits(events);
  irq = (int_sts_ & ~int_mask_ & ps_xadc::event::all) != 0;
}

}  // namespace ps
