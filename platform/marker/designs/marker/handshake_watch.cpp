#include <marker/designs/marker/handshake_watch.h>

#include <axi_gpio_registers.h>
#include <marker_logic.h>
#include <vp/error.h>
#include <vp/report.h>
#include <vp/unit.h>

#include <string>
#include <utility>

namespace platform {

namespace {

namespace packet = marker_logic::control;

constexpr std::uint32_t control = 1, feature = 2, frame = 3;  // what changed

}  // namespace

HandshakeWatch::HandshakeWatch(const MarkerParts& parts, const ps::Cpu& cpu,
                               const vp::ClockScheduler& scheduler)
    : cpu_(cpu),
      scheduler_(scheduler),
      feature_(parts.feature),
      feature_register_(parts.features.s_axi[axi_gpio::GPIO_DATA]) {
  parts.control.gpio.io_o.attach(*this, control);
  feature_.attach(*this, feature);
  parts.frame_ena.attach(*this, frame);
  // Reads that a poll passes over are in the register's count only.
  feature_register_.after_read([this](std::uint32_t word) { register_read(word); });
}

HandshakeWatch::~HandshakeWatch() {
  feature_register_.after_read(nullptr);
}

void HandshakeWatch::on_change(vp::SignalBase& signal, std::uint32_t id) {
  if (id == control) {
    control_written(static_cast<std::uint32_t>(signal.bits()));
  } else if (id == feature) {
    word_shown(static_cast<std::uint32_t>(signal.bits()));
  } else if (signal.bits() != 0) {
    look_at_polls();
  }
}

// Without `ena` the hardware does not look at `ready`.
void HandshakeWatch::control_written(std::uint32_t word) {
  const bool toggled = ((word ^ packet_) & packet::ready) != 0;
  packet_ = word;
  if ((word & packet::rst) != 0) unacknowledged_ = false;
  if (!toggled || (word & packet::rst) != 0 || (word & packet::ena) == 0) return;
  if (std::exchange(unacknowledged_, false)) return;
  if (stray_toggles_++ != 0) return;
  vp::warn(cpu_, "/markervp/cpu/stray_ready",
           "`ready` was toggled although no feature word waits to be acknowledged: the "
           "toggle is lost or, if a word comes at that moment, takes it away unread; toggle it "
           "once after each "
           "new word in the feature register" +
               cpu_.where());
}

void HandshakeWatch::word_shown(std::uint32_t word) {
  look_at_polls();
  unacknowledged_ = word != 0;  // 0: reset
}

void HandshakeWatch::register_read(std::uint32_t word) {
  if (word != marker_logic::WordFormat::end_of_frame || reads_at_end_ || feature_.bits() != word) {
    return;
  }
  reads_at_end_ = feature_register_.use().reads;
  end_read_ps_ = scheduler_.now_ps();
}

// The end word goes, or a frame is over: the register need not have been read in between.
void HandshakeWatch::look_at_polls() {
  if (!reads_at_end_) return;
  const std::uint64_t more = feature_register_.use().reads - *std::exchange(reads_at_end_, {});
  if (more == 0) return;
  vp::warn(cpu_, "/markervp/cpu/polls_after_end",
           "the feature register was read " + std::to_string(more) +
               " times more after the end word, which the program saw at " +
               vp::format_time(end_read_ps_) +
               ": nothing follows it; start the next frame with `rst`, then `ena`");
}

std::uint64_t HandshakeWatch::finish_frame() {
  look_at_polls();
  return std::exchange(stray_toggles_, 0);
}

}  // namespace platform
