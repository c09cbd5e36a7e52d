#include <slcr_registers.h>

#include <ps/slcr/level_shifters.h>
#include <vp/error.h>
#include <vp/text.h>
#include <string>

namespace ps {

void LevelShifters::start() {
  started_ = true;
  if (on_) return;
  for (vp::MmLink* link : links_) link->add_observer(*this);
}

void LevelShifters::set(std::uint32_t value) {
  value_ = value;
  const bool on = (value & slcr::lvl_shftr_en::USER_LVL_SHFTR_EN) == slcr::lvl_shftr_en::all;
  if (on == on_) return;
  on_ = on;
  if (!started_) return;
  for (vp::MmLink* link : links_) {
    if (on) {
      link->remove_observer(*this);
    } else {
      link->add_observer(*this);
    }
  }
}

void LevelShifters::before(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) {
  throw vp::ProtocolError(std::string("bus hang: ") +
                          (payload.is_read() ? "read of " : "write to ") +
                          vp::hex(payload.get_address()) + " through " + link.name() +
                          ", but the level shifters between PS and PL are off (LVL_SHFTR_EN is " +
                          vp::hex(value_) + "): write 0xF to it first");
}

}  // namespace ps
