#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <vp/signal.h>
#include <xilinx/axi_dma/dma_channel.h>

namespace platform {

/// What a design shows on the timeline of its first frames, between software and frame: signals
/// that exist at both fidelities.
struct TimelineEngines {
  /// Works while the signal is high.
  struct Engine {
    std::string name;
    vp::SignalBase* busy;
    bool active_low = false;
    /// Software waits for it in the stage `waiting`.
    bool critical = false;
  };
  /// A channel of a DMA engine, and the line of its interrupt.
  struct Channel {
    std::string name;
    xilinx::DmaChannel* channel;
    std::string interrupt;
    vp::SignalBase* line;
  };
  /// How full a buffer is.
  struct Level {
    std::string name, unit;
    double capacity;
    vp::SignalBase* level;
  };
  /// The most that was in a buffer while a transfer ran: asked when the next one begins.
  struct Peak {
    std::string name, unit;
    double capacity;
    std::size_t channel;
    std::function<double()> most;
  };
  /// Words that are handed over one by one: `enable` rises, each is shown and acknowledged.
  struct Handshake {
    std::string name;
    vp::SignalBase *enable, *word, *acknowledge;
  };

  std::vector<Engine> engines;
  std::vector<Channel> channels;
  std::vector<Level> levels;
  std::vector<Peak> peaks;
  std::optional<Handshake> handshake;
  std::string waiting;  ///< the stage in which software waits for the logic
};

}  // namespace platform
