#pragma once

#include <cstdint>

#include <marker/result.h>
#include <report/result.h>
#include <vp/clock.h>

namespace platform {

/// Fills in what the software knows of a frame that it published at `now_ps`: times, counts,
/// markers, features. Its stamps count pairs of cycles of `cpu_clk`.
void fill_in(report::FrameReport& frame, const marker::FrameResult& result, std::uint64_t now_ps,
             const vp::Clock& cpu_clk);

/// Adds the warnings that follow from the frame's counts and the software's own.
void add_losses(report::FrameReport& frame, const marker::FrameResult& result);

}  // namespace platform
