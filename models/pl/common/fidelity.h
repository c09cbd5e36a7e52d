#pragma once

namespace pl {

/// How an IP is modelled. Results and times are the same.
enum class Fidelity {
  clocked,  ///< clock by clock, all ports alive
  tlm,      ///< whole frames at once, with the clock of every packet
};

}  // namespace pl
