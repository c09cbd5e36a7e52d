#pragma once

#include <string>

#include <chip/system/zynq.h>
#include <nlohmann/json.hpp>

namespace platform {

/// Whether a command of a test is for what is on the board: pin, attach, contents or analogue.
bool is_for_the_board(const std::string& what);

/// Obeys one, at the present time:
///
///   {"do": "pin", "number": 54, "level": 1}            drives a pin of the PS; returns its level
///   {"do": "pin", "number": 10, "wire_to": 14}         pin 14 follows pin 10
///   {"do": "pin", "number": 54, "released": 1}         no longer drives it
///   {"do": "attach", "bus": "ps.i2c0", "device": "eeprom", "address": 80, "size": 256, "page": 16}
///   {"do": "attach", "bus": "ps.i2c0", "device": "registers", "address": 24, "index_bytes": 1}
///   {"do": "attach", "bus": "ps.spi0", "device": "flash", "slave": 0, "size": 4194304}
///   {"do": "contents", "bus": "ps.i2c0", "address": 80, "at": 0, "count": 16}      or "bytes": […]
///   {"do": "analogue", "name": "ps.xadc", "channel": 0, "value": 51.5}
///
/// Throws vp::InputError for a command that lacks something, or names what there is not.
nlohmann::json obey_for_the_board(Zynq& zynq, const std::string& what,
                                  const nlohmann::json& command);

}  // namespace platform
