#include <chip/run/camera_timing.h>

#include <cmath>

#include <vp/error.h>
#include <vp/unit.h>

namespace platform {

namespace {

using Wide = unsigned __int128;

constexpr const char* no_rate = "none";
constexpr double lowest_fps = 0.1, highest_fps = 100'000;
constexpr double micro_per_one = 1e6;
constexpr Wide micro_ps_per_s = Wide{1'000'000'000'000} * 1'000'000;

std::string fps_text(double fps) {
  return vp::Decimal(fps).text() + " fps";
}

std::string range_text() {
  return fps_text(lowest_fps) + " to " + fps_text(highest_fps);
}

}  // namespace

FrameRate::FrameRate(const char* name, std::string documentation)
    : ParameterBase(name, vp::Unit::frequency, vp::Source::decision, std::move(documentation)) {
  if (const vp::Setting* given = setting()) read(*given);
  publish(micro_fps_ ? fps_text(static_cast<double>(*micro_fps_) / micro_per_one) : no_rate,
          no_rate, range_text() + ", or " + no_rate);
}

void FrameRate::read(const vp::Setting& given) {
  if (given.text == no_rate) return;
  double fps = 0;
  try {
    fps = vp::parse_quantity(given.text, vp::Unit::frequency).to_double();
  } catch (const vp::InputError&) {
    refuse(given, std::string("is no frame rate: write 60 fps, or ") + no_rate);
  }
  if (!(lowest_fps <= fps && fps <= highest_fps)) {
    refuse(given, "is a rate that no camera has: allowed is " + range_text() + ", the nearest is " +
                      fps_text(fps > highest_fps ? highest_fps : lowest_fps));
  }
  micro_fps_ = static_cast<std::uint64_t>(std::llround(fps * micro_per_one));
}

CameraTiming::CameraTiming(sc_core::sc_module_name name)
    : sc_module(name),
      rate("rate",
           "inputs that come in a second; one that comes while the program is busy is lost (none: "
           "the next one is there as soon as it is wanted)") {}

double CameraTiming::fps() const {
  return static_cast<double>(*rate.micro_fps()) / micro_per_one;
}

std::uint64_t CameraTiming::offset_ps(std::uint64_t number) const {
  const Wide rate_micro = *rate.micro_fps();
  return static_cast<std::uint64_t>((number * micro_ps_per_s + rate_micro / 2) / rate_micro);
}

std::uint64_t CameraTiming::first_after(std::uint64_t offset) const {
  // Rounding moves an input by less than one number.
  auto number = static_cast<std::uint64_t>(offset * Wide{*rate.micro_fps()} / micro_ps_per_s);
  while (offset_ps(number) < offset) ++number;
  return number;
}

}  // namespace platform
