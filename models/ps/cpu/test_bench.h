#pragma once

#include <hal/hal.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ps {

/// What stands around a program in a run: gives it images and options, takes its results. The
/// platform implements it. Times are simulation times of the call in ps; the calls take none.
class TestBench {
 public:
  virtual ~TestBench() = default;

  /// When the next image comes, or it is known that there is none. The program wants it now, and
  /// sleeps until then.
  virtual std::uint64_t next_frame_ps(std::uint64_t now_ps) { return now_ps; }
  /// The next image, or null when the run is over. Valid until the next call.
  virtual const hal_frame* next_frame(std::uint64_t now_ps) = 0;
  /// What came of a frame; `data` is valid during the call only. False: no result, the program gave
  /// the frame up.
  virtual bool publish(std::uint32_t kind, const void* data, std::size_t size,
                       std::uint64_t now_ps) = 0;
  /// The value of the program's option number `option`.
  virtual double option(std::uint32_t option, const hal_option_info& info) = 0;
  /// The value that xparameters.h would give `name` ("AXI_GPIO_0_BASEADDR"), if any.
  virtual std::optional<std::uint32_t> xparameter(const char* /*name*/) { return std::nullopt; }
};

}  // namespace ps
