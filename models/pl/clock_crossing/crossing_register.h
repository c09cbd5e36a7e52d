#pragma once

#include <cstdint>
#include <systemc>

#include <vp/signal.h>

namespace pl {

/// A word on its way from the pixel clock to the system clock: held in a register of the pixel
/// domain beside a toggle that the system side samples on each of its edges. No handshake: a word
/// that the next one overwrites before it was seen is lost, and counted.
class CrossingRegister : public sc_core::sc_module {
 public:
  explicit CrossingRegister(sc_core::sc_module_name name) : sc_module(name) {}

  vp::Signal<bool> toggle{"toggle"};
  vp::Signal<std::uint32_t> word{"word"};
  vp::Signal<std::uint32_t> second_word{
      "second_word"};  ///< a blob's end; unused by the other crossings

  /// The toggle as the system side sampled it last.
  void set_seen(const vp::Signal<bool>& seen) { seen_ = &seen; }

  /// Puts a word in, on a pixel-clock edge. False: it replaced one that was not seen.
  bool send(std::uint32_t first, std::uint32_t second = 0) {
    const bool seen = seen_->written() == toggle.written();
    word = first;
    second_word = second;
    if (seen) toggle = !toggle.get();
    return seen;
  }
  void reset() { toggle = false; }

 private:
  const vp::Signal<bool>* seen_ = nullptr;
};

}  // namespace pl
