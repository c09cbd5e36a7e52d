#include <trace/window.h>

#include <vp/error.h>
#include <vp/unit.h>

#include <algorithm>
#include <limits>
#include <string>

namespace platform::trace {

void WindowReader::read() {
  vp::WaveReader& reader = file_.reader();
  if (window_.from_ps > 0) {
    if (const auto entry = reader.entry(window_.from_ps)) reader.enter(*entry);
  }
  reader.read(*this);
  const auto fail = [&](const std::string& problem) {
    throw vp::InputError("trace '" + file_.name() + "' " + problem);
  };
  if (!first_) fail("has no values");
  if (!begun_ && now_.first < window_.from_ps) {
    fail("ends at " + vp::format_time(now_.first) + ", before the window begins");
  }
  if (!begun_ && first_->first >= window_.to_ps) {
    fail("has nothing before " + vp::format_time(window_.to_ps) + ", the end of the window");
  }
  begin_once();
}

std::uint64_t WindowReader::steps(Moment moment) const {
  if (!counts_femtoseconds()) return moment.first;
  const auto wide = static_cast<unsigned __int128>(moment.first) * fs_per_ps + moment.second;
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  return wide > most ? most : static_cast<std::uint64_t>(wide);
}

bool WindowReader::at(std::uint64_t ps) {
  const Moment now(ps, file_.reader().below_ps());
  if (!first_) first_ = now;
  if (ps >= window_.to_ps) {
    now_ = {window_.to_ps, 0};
    return false;
  }
  if (now > start()) begin_once();
  now_ = now;
  if (begun_) reach(now);
  return true;
}

void WindowReader::begin_once() {
  if (!begun_) begin(start());
  begun_ = true;
}

}  // namespace platform::trace
