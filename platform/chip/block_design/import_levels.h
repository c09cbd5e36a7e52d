#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <chip/handoff/netlist.h>

/// What nets of a hand-off carry: at which levels resets are active, and how fast clocks are.
namespace platform::block_design {

/// Whether a net that this pin drives resets at 0; none if the pin says nothing of it.
std::optional<bool> resets_low(const handoff::Netlist& nets, const handoff::Pin& driver);

/// Whether neither the name of a reset of RTL nor an attribute in its sources says at which level
/// it resets.
bool leaves_level_open(const handoff::Port& port, const std::vector<std::string>& sources);

/// Whether a pin of the chip is at 1 where nothing drives it: a reset that is active at 0.
bool idles_high(const handoff::Handoff& handoff, const handoff::Port& external);

/// The frequencies of clocks, by net, where their drivers may say nothing: what those that they
/// drive are said to have, or what a clock wizard behind them was made for.
std::map<std::string, double> clock_wishes(const handoff::Handoff& handoff);

}  // namespace platform::block_design
