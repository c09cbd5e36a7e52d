#pragma once

#include <string>

#include <chip/block_design/shelf.h>
#include <chip/handoff/netlist.h>
#include <chip/handoff/rtl_sources.h>

/// Whether the models of the shelf can be what a hand-off asks for.
namespace platform::block_design {

/// Why the model cannot be built as the design wants it, or take what drives its pins; "" if it
/// can. `rtl` has the files that memories are loaded from.
std::string misfit(const IpRule& rule, const handoff::Module& module, const handoff::Netlist& nets,
                   const handoff::RtlFinder& rtl);

/// Whether a module is a memory whose contents are in a file.
bool loads_memory(const handoff::Module& module);

}  // namespace platform::block_design
