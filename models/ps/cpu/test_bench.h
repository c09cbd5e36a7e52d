#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <hal/hal.h>

namespace ps {

/// The environment of a program in a run: gives it inputs and options, takes its results. The
/// platform implements it. Times are simulation times of the call in ps; the calls take none.
class TestBench {
 public:
  virtual ~TestBench() = default;

  /// When the next input comes, or when it is known that no more come. The program asks for it now
  /// and sleeps until then.
  virtual std::uint64_t next_frame_ps(std::uint64_t now_ps) { return now_ps; }
  /// The next input, or null when the run is over. Valid until the next call.
  virtual const hal_frame* next_frame(std::uint64_t now_ps) = 0;
  /// Takes the result of a frame; `data` is valid during the call only. False: no result, the
  /// program gave up the frame.
  virtual bool publish(std::uint32_t kind, const void* data, std::size_t size,
                       std::uint64_t now_ps) = 0;
  /// The value of the program's option number `option`.
  virtual double option(std::uint32_t option, const hal_option_info& info) = 0;
  /// What is in the file that this option names. Valid until the run ends; empty: it names none.
  virtual std::string_view option_data(std::uint32_t /*option*/) { return {}; }
  /// The value that xparameters.h would give `name` ("AXI_GPIO_0_BASEADDR"), if any.
  virtual std::optional<std::uint32_t> xparameter(const char* /*name*/) { return std::nullopt; }
};

}  // namespace ps
