#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <device/clock_plan.h>
#include <vp/decimal.h>
#include <vp/error.h>
#include <vp/unit.h>

namespace platform::cli {

namespace {

using device::ClockKind;
using device::ClockPlan;
using device::ClockPlanner;
using device::MadeClock;
using Json = nlohmann::ordered_json;

constexpr double hz_per_mhz = 1e6;
constexpr std::size_t most_fclk = 4;

ClockKind kind_of(const std::string& name) {
  if (name == "cpu") return ClockKind::cpu_621;
  if (name == "cpu-421") return ClockKind::cpu_421;
  return name == "ddr" ? ClockKind::ddr : ClockKind::fclk;
}

double frequency(const std::string& text, const std::string& what) {
  double hz = 0;
  try {
    hz = vp::parse_quantity(text, vp::Unit::frequency).to_double();
  } catch (const vp::InputError& error) {
    throw vp::InputError(what + " '" + text + "' " + error.what());
  }
  if (hz < 1) throw vp::InputError(what + " '" + text + "': give at least 1 Hz");
  return hz;
}

std::string mhz(double hz) {
  return fmt::format("{:.6f} MHz", hz / hz_per_mhz);
}

double percent(double hz, double wish_hz) {
  return 100 * (hz / wish_hz - 1);
}

std::string pll_text(const MadeClock& clock) {
  return fmt::format("{} PLL {:.3f} MHz x{}", to_string(clock.pll), clock.vco_hz / hz_per_mhz,
                     clock.feedback);
}

std::string divisor_text(const MadeClock& clock) {
  return clock.divisor1 == 1 ? fmt::format("/ {}", clock.divisor0)
                             : fmt::format("/ {} / {}", clock.divisor0, clock.divisor1);
}

/// A wish and what can be had of it.
struct Answer {
  double wish_hz;
  MadeClock made;
  ClockPlanner::Neighbours neighbours;
  std::vector<device::NearClock> near;
};

/// FCLK wishes are those of one chip; of the others each is asked for alone.
class Question {
 public:
  explicit Question(const ClocksOptions& options)
      : options_(options),
        kind_(kind_of(options.kind)),
        crystal_hz_(options.crystal ? frequency(*options.crystal, "the crystal")
                                    : device::zedboard_crystal_hz),
        planner_(device::find_device(options.device), crystal_hz_) {
    wishes_.ethernet = !options.no_ethernet;
    std::vector<double> wishes;
    for (const std::string& text : options.wishes) wishes.push_back(frequency(text, "the wish"));
    if (kind_ == ClockKind::fclk) {
      if (wishes.size() > most_fclk) {
        throw vp::InputError(
            fmt::format("{} wishes: a chip has {} clocks to the PL", wishes.size(), most_fclk));
      }
      wishes_.fclk_hz = wishes;
    }
    plan_ = planner_.plan(wishes_);
    for (std::size_t i = 0; i < wishes.size(); ++i) {
      const double wish_hz = wishes[i];
      answers_.push_back(
          {wish_hz, kind_ == ClockKind::fclk ? plan_.fclk[i] : planner_.own_pll(wish_hz, kind_),
           planner_.neighbours(wish_hz, kind_, plan_),
           planner_.near(wish_hz, kind_, plan_, wishes_.ethernet, options.count)});
    }
  }

  void print(std::ostream& out) const {
    out << fmt::format("{}, crystal {}", planner_.device().name(), mhz(crystal_hz_));
    if (kind_ == ClockKind::fclk) {
      out << fmt::format(", {}: I/O PLL {} (x{})", wishes_.ethernet ? "Ethernet" : "no Ethernet",
                         mhz(crystal_hz_ * plan_.io_feedback), plan_.io_feedback);
    }
    out << "\n";
    for (const Answer& answer : answers_) print(answer, out);
  }

  Json json() const {
    Json json;
    json["device"] = planner_.device().name();
    json["crystal_mhz"] = crystal_hz_ / hz_per_mhz;
    json["kind"] = options_.kind;
    json["limit_mhz"] = limit().value;
    if (kind_ == ClockKind::fclk) {
      json["ethernet"] = wishes_.ethernet;
      json["io_feedback"] = plan_.io_feedback;
    }
    json["clocks"] = Json::array();
    for (const Answer& answer : answers_) {
      Json entry;
      entry["wish_mhz"] = answer.wish_hz / hz_per_mhz;
      entry["made"] = as_json(answer.made, answer.wish_hz);
      const auto& [below, above] = answer.neighbours;
      entry["below"] = below ? as_json(*below, answer.wish_hz) : Json();
      entry["above"] = above ? as_json(*above, answer.wish_hz) : Json();
      for (const device::NearClock& near : answer.near) {
        Json made = as_json(near.clock, answer.wish_hz);
        made["how"] = to_string(near.effort);
        entry["near"].push_back(made);
      }
      json["clocks"].push_back(entry);
    }
    return json;
  }

 private:
  const device::Figure& limit() const { return limit_of(planner_.device(), kind_); }

  static Json as_json(const MadeClock& clock, double wish_hz) {
    Json json;
    json["mhz"] = clock.hz / hz_per_mhz;
    json["offset_percent"] = percent(clock.hz, wish_hz);
    json["pll"] = to_string(clock.pll);
    json["vco_mhz"] = clock.vco_hz / hz_per_mhz;
    json["feedback"] = clock.feedback;
    json["divisors"] = {clock.divisor0, clock.divisor1};
    return json;
  }

  static std::string neighbour(const std::optional<MadeClock>& clock, double wish_hz) {
    if (!clock) return "none";
    return fmt::format("{} ({:+.3f} %)", mhz(clock->hz), percent(clock->hz, wish_hz));
  }

  void print(const Answer& answer, std::ostream& out) const {
    const double wish_hz = answer.wish_hz;
    out << fmt::format("\n{} {}: the vendor's tool makes {} ({:+.3f} %), {} {}\n",
                       kind_ == ClockKind::fclk  ? "FCLK"
                       : kind_ == ClockKind::ddr ? "DDR"
                                                 : "CPU",
                       mhz(wish_hz), mhz(answer.made.hz), percent(answer.made.hz, wish_hz),
                       pll_text(answer.made), divisor_text(answer.made));
    if (answer.made.hz > limit().value * hz_per_mhz * (1 + device::crystal_tolerance)) {
      out << fmt::format("  ABOVE the {:.10g} MHz of the speed grade ({})\n", limit().value,
                         to_string(limit().confidence));
    }
    out << fmt::format("  below {}, above {}\n\n", neighbour(answer.neighbours.below, wish_hz),
                       neighbour(answer.neighbours.above, wish_hz));
    out << fmt::format("{:>14} {:>11}  {:<25} {:<10}  {}\n", "MHz", "offset, %", "PLL", "dividers",
                       "how");
    for (const device::NearClock& near : answer.near) {
      out << fmt::format("{:>14.6f} {:>+11.4f}  {:<25} {:<10}  {}\n", near.clock.hz / hz_per_mhz,
                         percent(near.clock.hz, wish_hz), pll_text(near.clock),
                         divisor_text(near.clock), to_string(near.effort));
    }
  }

  const ClocksOptions& options_;
  ClockKind kind_;
  double crystal_hz_;
  ClockPlanner planner_;
  device::ClockWishes wishes_;
  ClockPlan plan_;
  std::vector<Answer> answers_;
};

}  // namespace

int list_clocks(const ClocksOptions& options, std::ostream& out) {
  const Question question(options);
  if (options.json) {
    out << question.json().dump(2) << "\n";
  } else {
    question.print(out);
  }
  return done;
}

}  // namespace platform::cli
