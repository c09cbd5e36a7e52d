// The clocks of a design and whether its modules meet them, in result.json.
#include <result/result_members.h>

namespace platform::result {

using facts::Better;
using facts::ClockReport;
using facts::TimingReport;

namespace {

constexpr int mhz_places = 6;

using Clock = ClockReport::Clock;

Members<Clock> made_members() {
  const auto way = [](const char* key) {
    return facts::Figure(key, "1", "how PLL and dividers make a clock");
  };
  return Members<Clock>()
      .figure({"mhz", "MHz", "clock that the PLLs make"}, &Clock::made_mhz, mhz_places)
      .text("pll", &Clock::pll)
      .figure({"vco_mhz", "MHz", "clock of the PLL that makes it"}, &Clock::vco_mhz, mhz_places)
      .figure(way("feedback"), &Clock::feedback)
      .numbers("divisors", way("*"), [](const Clock& clock) {
        return Json{clock.divisor0, clock.divisor1};
      });
}

/// A neighbour that cannot be had is null.
Json neighbour(double mhz) {
  return mhz > 0 ? Json(rounded(mhz, mhz_places)) : Json();
}

Members<Clock> clock_of_list_members() {
  return Members<Clock>()
      .text("name", &Clock::name)
      .figure({"wish_mhz", "MHz", "clock that was asked for"}, &Clock::wish_mhz, mhz_places)
      .figure({"frequency_mhz", "MHz", "highest that it had"}, &Clock::frequency_mhz, mhz_places)
      .figure(
          {"offset_percent", "%", "by how much what is made misses the wish"},
          [](const Clock& clock) { return 100 * (clock.made_mhz / clock.wish_mhz - 1); },
          percent_places)
      .object(
          "made", made_members(),
          [](const Clock& clock) { return clock.external ? nullptr : &clock; }, true)
      .figure({"below_mhz", "MHz", "nearest clock below that can be had"},
              [](const Clock& clock) { return neighbour(clock.below_mhz); })
      .figure({"above_mhz", "MHz", "nearest clock above that can be had"},
              [](const Clock& clock) { return neighbour(clock.above_mhz); })
      .figure({"limit_mhz", "MHz", "what the device allows", Better::more}, &Clock::limit_mhz,
              mhz_places)
      .figure(
          {"legal_mhz", "MHz", "of a clock beyond its limit, the nearest that can be had"},
          [](const Clock& clock) {
            return clock.legal_mhz > 0 ? std::optional(clock.legal_mhz) : std::nullopt;
          },
          mhz_places)
      .text("limit_confidence", &Clock::limit_confidence)
      .figure({"margin_percent", "%", "by how much a clock could rise", Better::more},
              &Clock::margin_percent, percent_places)
      .figure({"within", "1", "1 if a clock is within its limit", Better::more}, &Clock::within)
      .figure({"makeable", "1", "1 if the PLLs can make it", Better::more}, &Clock::makeable)
      .figure({"used", "1", "1 if the design uses it"}, &Clock::used);
}

using Timed = TimingReport::Module;

template <class Value>
auto if_limit_is_known(Value Timed::*value) {
  return [value](const Timed& module) {
    return module.known ? std::optional(module.*value) : std::nullopt;
  };
}

Members<Timed> timed_module_members() {
  return Members<Timed>()
      .text("name", &Timed::name)
      .text("clock", &Timed::clock)
      .figure({"frequency_mhz", "MHz", "highest clock that a module had"}, &Timed::frequency_mhz,
              mhz_places)
      .figure({"fmax_mhz", "MHz", "clock up to which it works", Better::more},
              if_limit_is_known(&Timed::fmax_mhz), mhz_places)
      .figure({"fmax_high_mhz", "MHz", "clock above which it does not work", Better::more},
              if_limit_is_known(&Timed::fmax_high_mhz), mhz_places)
      .text("origin", &Timed::origin)
      .figure(
          {"reachable_mhz", "MHz", "clock below that limit that the PLLs make", Better::more},
          [](const Timed& module) {
            return module.reachable_mhz > 0 ? std::optional(module.reachable_mhz) : std::nullopt;
          },
          mhz_places)
      .figure({"met", "1", "1 if the module is fast enough", Better::more}, &Timed::met)
      .figure({"margin_percent", "%", "by how much its clock could rise", Better::more},
              if_limit_is_known(&Timed::margin_percent), percent_places)
      .text("source", &Timed::source);
}

}  // namespace

const Members<ClockReport>& clock_members() {
  static const Members<ClockReport> members =
      Members<ClockReport>()
          .text("device", &ClockReport::device)
          .text("mode", &ClockReport::mode)
          .figure({"legal", "1", "1 if the device allows and can make every clock", Better::more},
                  &ClockReport::legal)
          .list("list", clock_of_list_members(), &ClockReport::clocks);
  return members;
}

const Members<TimingReport>& timing_members() {
  static const Members<TimingReport> members =
      Members<TimingReport>()
          .figure({"met", "1", "1 if every module is fast enough for its clock", Better::more},
                  &TimingReport::met)
          .list("modules", timed_module_members(), &TimingReport::modules);
  return members;
}

}  // namespace platform::result
