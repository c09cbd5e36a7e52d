#pragma once

#include <string>

#include <chip/system/zynq.h>
#include <nlohmann/json.hpp>

namespace platform {

/// Whether a command of a test is an access of its own to the chip: access, memory or devices.
bool is_for_the_bus(const std::string& what);

/// Obeys one. `access` is what the processor's access is: it has its effects, and takes its time,
/// so it is for a process; the others take none.
///
///   {"do": "access", "at": 1092616192}                    reads a word, or "value": … writes one
///   {"do": "memory", "at": 268435456, "bytes": 4096}      of the DDR, or "hex": "0001…" writes
///   {"do": "devices"}                                     those of the PL, and its parameters
///
/// Throws vp::InputError for a command that lacks something, or names what there is not.
nlohmann::json obey_for_the_bus(Zynq& zynq, const std::string& what, const nlohmann::json& command);

}  // namespace platform
