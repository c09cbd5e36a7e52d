#pragma once

#include <string>

#include <chip/system/zynq.h>
#include <result/page/report_page.h>
#include <vp/configuration.h>

namespace platform::cli {

/// Adds the block design of a run to its page, if the design is a file: the picture that 'markervp
/// map --diagram' draws, and of each part its registers and what was counted in it. Where it cannot
/// be drawn the page says why (`problem`). `folder`: for files that are removed again.
void add_diagram(page::RunExtras& page, Zynq& zynq, const vp::Configuration& configuration,
                 const std::string& folder);

}  // namespace platform::cli
