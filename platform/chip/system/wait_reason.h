#pragma once

#include <string>

#include <chip/system/zynq.h>
#include <ps/cpu/cpu.h>
#include <ps/gic/gic.h>

namespace platform {

/// Why a program waits in vain, as the end of a message: "; interrupt 61 (axi_dma_0.mm2s_introut)
/// has been high since 12 us, and … : call …". Of the register that it polls, what its AXI DMA
/// does. Empty if the platform sees no reason. `gic` is that of the core which waits.
std::string reason_of_wait(Zynq& zynq, const ps::Gic& gic, const ps::Surroundings::Wait& wait);

}  // namespace platform
