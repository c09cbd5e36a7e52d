#pragma once

#include <vp/mm_link.h>
#include <cstdint>
#include <vector>

namespace ps {

/// The level shifters between PS and PL, as a guard on the links that cross them: it watches only
/// while an access would hang, so that it costs nothing otherwise.
class LevelShifters : public vp::MmObserver {
 public:
  /// Accesses through `link` need the shifters: before the simulation starts.
  void guard(vp::MmLink& link) { links_.push_back(&link); }
  /// The links are bound: begins to watch.
  void start();
  /// Value of LVL_SHFTR_EN.
  void set(std::uint32_t value);
  bool on() const { return on_; }

 private:
  /// Throws vp::ProtocolError: on the chip nothing answers, and the bus hangs.
  void before(vp::MmLink& link, tlm::tlm_generic_payload& payload, sc_core::sc_time&) override;

  std::vector<vp::MmLink*> links_;
  std::uint32_t value_ = 0;
  bool on_ = true;  ///< nobody watches
  bool started_ = false;
};

}  // namespace ps
