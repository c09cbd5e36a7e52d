#pragma once

#include <string>

#include <zynq/zynq.h>

namespace platform {

/// Which registers the program used, and which of their bits, as a page of Markdown: a table a
/// device, then the registers that it never touched. Reads that a poll passed over count.
std::string register_coverage(Zynq& zynq);

}  // namespace platform
