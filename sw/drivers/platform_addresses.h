#pragma once

#include <marker_logic.h>

/// Where the devices of the marker system are: what Vivado would export for it.
namespace drivers::addresses {

using namespace marker_logic::addresses;

}  // namespace drivers::addresses
