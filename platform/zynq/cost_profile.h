#pragma once

#include <ps/cpu/cost_table.h>

namespace platform {

/// What the units of work of the marker programs cost on a Cortex-A9 at 667 MHz: the profile
/// `assumed`. Each entry stands with its reason in the source; nothing is measured on the chip.
ps::CostTable assumed_costs();

}  // namespace platform
