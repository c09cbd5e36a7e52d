#pragma once

#include <cstdint>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <marker/designs/marker/marker_design.h>
#include <simulation.h>
#include <vp/clock_scheduler.h>
#include <vp/configuration.h>
#include <vp/report.h>
#include "bus_master.h"
#include "memory_target.h"

namespace kit {

/// The whole programmable logic with a bus master that does to it, at random times, what software
/// may do and what it should not: frames, resets, thresholds, late and cut transfers, images that
/// arrive while one is played, other clocks. Notes everything that can be seen from outside.
class DisturbedLogic : private Simulation {
 public:
  struct Size {
    std::uint32_t width, height;
  };
  /// `settings`: assignments such as "pl.fidelity.sensor_input=clocked".
  DisturbedLogic(pl::Fidelity fidelity, Size size, const std::vector<std::string>& settings = {});

  ~DisturbedLogic();

  /// Runs `actions` actions drawn from `seed`. Returns what was seen, a line each: time and event.
  std::vector<std::string> run(std::uint64_t seed, unsigned actions);

 private:
  /// The fixed configuration has to be in force while the members are made.
  struct Configured {
    Configured(Size size, const std::vector<std::string>& settings);
    vp::Configuration configuration;
    vp::Configuration::Scope scope{configuration};
  };
  class Watch;

  std::uint32_t below(std::uint32_t limit);
  void pause(std::uint32_t longest_ns);
  void act();
  void control(std::uint32_t packet);
  void reset_logic();
  void load_threshold();
  void toggle_ready();
  void upload();
  void receive();
  void restart_dma();
  void change_clock();
  void look();
  void note(const std::string& event);

  Configured configured_;
  std::uint64_t random_ = 0;
  std::uint32_t packet_ = 0;
  std::vector<std::string> seen_;

  std::ostringstream ignored_;
  vp::ReportRouter reports_;
  vp::ClockScheduler scheduler_{"scheduler"};
  vp::Clock system_clk_{"system_clk", scheduler_, 100'000'000};
  vp::Clock pixel_clk_{"pixel_clk", scheduler_, 50'000'000};
  platform::ProgrammableLogic pl_;
  BusMaster software_{"software"};
  MemoryTarget memory_{"memory", 0x40000};
  vp::Signal<bool> reset_n_{"reset_n", 1, true};
  std::vector<std::unique_ptr<Watch>> watches_;
};

}  // namespace kit
